// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/curve_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/half.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/color/curve_text.h"
#include "imagebuf/color/view_config.h"
#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using tonemap::MeasuredRows;

enum class Kind { Spi1d, Cube, Csv, Responses, Model, Ocio };

bool ocio_reads(const std::string& extension) {
    for (int i = 0; i < ocio::FileTransform::GetNumFormats(); ++i)
        if (extension == ocio::FileTransform::GetFormatExtensionByIndex(i))
            return true;
    return false;
}

// By the extension; what that does not tell, by the content.
Kind kind_of(const std::string& file) {
    const std::string extension = lower(OIIO::Filesystem::extension(file, false));
    if (extension == "spi1d")
        return Kind::Spi1d;
    if (extension == "cube")
        return Kind::Cube;
    if (extension == "csv")
        return Kind::Csv;
    if (ocio_reads(extension))
        return Kind::Ocio;
    const CurveText text(file);
    if (holds_responses(text))
        return Kind::Responses;
    if (holds_model(text))
        return Kind::Model;
    text.fail("is no curve that is known (valid: .spi1d, .cube of one dimension, .csv, .clf and "
              "others that OpenColorIO reads, camera responses as text with \"I =\" and \"B =\", "
              "or a model of them with \"E =\", \"f0 =\" and \"h(1)=\")");
}

[[noreturn]] void fail_ocio(const std::string& file, const std::string& why) {
    throw Refusal(format("curve \"{}\": {}", file, why));
}

ocio::Lut1DTransformRcPtr open_ocio(const std::string& file) {
    if (!OIIO::Filesystem::is_regular(file))
        fail_ocio(file, OIIO::Filesystem::exists(file) ? "is not a file" : "there is no such file");
    const QuietOcio quiet;
    ocio::GroupTransformRcPtr group;
    try {
        const auto source = ocio::FileTransform::Create();
        source->setSrc(file.c_str());
        group = ocio::Config::CreateRaw()->getProcessor(source)->createGroupTransform();
    } catch (const ocio::Exception& refusal) {
        fail_ocio(file, "OpenColorIO does not read it: " + one_line(refusal.what()));
    }
    auto table = group->getNumTransforms() == 1
                     ? OCIO_DYNAMIC_POINTER_CAST<ocio::Lut1DTransform>(group->getTransform(0))
                     : nullptr;
    if (!table || table->getDirection() != ocio::TRANSFORM_DIR_FORWARD)
        fail_ocio(file, group->getNumTransforms() == 1
                            ? "holds no table of one dimension"
                            : format("holds {} step(s): must be one table of one dimension",
                                     group->getNumTransforms()));
    return table;
}

// A table of all halves has those of 0 to 65504 in its first 0x7c00 entries.
MeasuredRows read_ocio(const std::string& file) {
    const auto table = open_ocio(file);
    const bool halves = table->getInputHalfDomain();
    const auto length = size_t(table->getLength());
    const size_t count = halves ? 0x7c00 : length;
    if (length < kLeastCurveRows || length > kMostCurveRows || count > length)
        fail_ocio(file, format("has {} row(s): must be {} to {}", length, kLeastCurveRows,
                               kMostCurveRows));
    MeasuredRows out;
    out.y.resize(3);
    for (size_t i = 0; i < count; ++i) {
        half x;
        x.setBits(static_cast<unsigned short>(i));
        out.x.push_back(halves ? double(float(x)) : double(i) / double(length - 1));
        float y[3];
        table->getValue((unsigned long)(i), y[0], y[1], y[2]);
        for (size_t c = 0; c < 3; ++c) {
            if (!(std::abs(y[c]) <= 1e9f))
                fail_ocio(file, format("row {} holds {} (valid: -1e9 to 1e9)", i + 1, y[c]));
            out.y[c].push_back(double(y[c]));
        }
    }
    return out;
}

void check_extras(const CurveOptions& options, Kind kind) {
    if (kind != Kind::Responses && !options.curve_name.empty())
        throw Refusal(format("curvename={} is of text with camera responses: \"{}\" is none",
                             options.curve_name, options.name));
    if (kind != Kind::Model && !options.coeffs.empty())
        throw Refusal(format("coeffs= of a file are of a model of camera responses (E =, f0 =, "
                             "h(1)=): \"{}\" is none",
                             options.name));
}

MeasuredRows read_kind(const CurveOptions& options, Kind kind) {
    if (kind == Kind::Ocio)
        return read_ocio(options.name);
    const CurveText text(options.name);
    switch (kind) {
    case Kind::Spi1d:
        return read_spi1d(text);
    case Kind::Cube:
        return read_cube(text);
    case Kind::Responses:
        return read_responses(text, options.curve_name);
    case Kind::Model:
        return read_model(text, options.coeffs);
    default:
        return read_csv(text, options.table_input != "linear");
    }
}

} // namespace

bool is_curve_file(const std::string& name) {
    return name.find_first_of("./") != std::string::npos;
}

MeasuredRows read_curve_file(const CurveOptions& options) {
    const Kind kind = kind_of(options.name);
    check_extras(options, kind);
    return read_kind(options, kind);
}

} // namespace tonetool
