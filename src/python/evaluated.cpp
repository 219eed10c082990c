// SPDX-License-Identifier: BSD-3-Clause
#include "python/evaluated.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/float_rows.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "python/types.h"
#include "tonetool/color_tags.h"
#include "tonetool/parts.h"

namespace tonetool::python {

namespace {

using OIIO::Strutil::fmt::format;

bool is_path(const py::object& object) {
    return py::isinstance<py::str>(object) || py::hasattr(object, "__fspath__");
}

OIIO::TypeDesc stored_type(const OIIO::ImageBuf& image) {
    return oiio::is_unread_file(image) ? image.nativespec().format : image.spec().format;
}

// The smallest and largest finite value of the picture's channels, as they are stored.
std::pair<float, float> range_of(const OIIO::ImageBuf& image, const ColorChoice& choice) {
    float low = 0, high = 0;
    for_each_row(image, image.roi(), [&](int /*y*/, const float* row) {
        const float* const end = row + size_t(image.roi().width()) * size_t(image.nchannels());
        for (; row < end; row += image.nchannels())
            for (const int c : {choice.r, choice.g, choice.b})
                if (std::isfinite(row[c])) {
                    low = std::min(low, row[c]);
                    high = std::max(high, row[c]);
                }
    });
    return {low, high};
}

} // namespace

EvaluatedImage::EvaluatedImage(const py::object& object, const std::string& where,
                               Encoding encoding) {
    if (is_path(object))
        open(to_text(object, where), where);
    else
        m_given = std::make_unique<InputImage>(object, where);
    const bool integer = !stored_type(buf()).is_floating_point();
    const bool array = m_given && m_given->is_array();
    if (encoding == Encoding::Scene) {
        if (integer)
            throw py::value_error(where + " holds integers (" + stored_type(buf()).c_str() +
                                  "): \"HDR\" takes scene light, which is floats; \"LDR\" takes "
                                  "pictures for a screen");
        return;
    }
    if (!integer)
        check_range(where);
    if (encoding == Encoding::Linear && (integer || array))
        tag("Linear");
    else if (encoding == Encoding::Srgb && array)
        tag("sRGB");
}

void EvaluatedImage::open(const std::string& path, const std::string& where) {
    const oiio::HeaderCache cache = oiio::make_header_cache();
    m_cache = cache;
    OIIO::ImageBuf first = oiio::unread_file(path, 0, cache);
    if (!first.initialized() || first.has_error())
        throw Refused(where + ": " + with_path(path, first.geterror()));
    std::vector<OIIO::ImageSpec> headers = {first.spec()};
    for (int part = 1; part < first.nsubimages(); ++part)
        headers.push_back(oiio::unread_file(path, part, cache).spec());
    PartChoice choice;
    std::string error;
    if (!ToneAlgo::find_part(headers, {}, choice, error))
        throw Refused(where + ": " + with_path(path, error));
    m_own = choice.part == 0 ? first : oiio::unread_file(path, choice.part, cache);
}

void EvaluatedImage::check_range(const std::string& where) {
    if (buf().deep())
        return; // refused by what compares it
    check_read(buf(), where);
    ColorChoice choice;
    std::string error;
    // What has no colour is refused by what compares it, too.
    if (!ToneAlgo::find_color(buf().spec(), {}, choice, error))
        return;
    std::pair<float, float> range;
    {
        const py::gil_scoped_release others_may_run;
        range = range_of(buf(), choice);
    }
    constexpr float rounding = 1e-5F;
    if (range.first >= -rounding && range.second <= 1 + rounding)
        return;
    const std::string what = format("{} holds values from {:.6g} to {:.6g}, \"LDR\" takes 0 to 1",
                                    where, range.first, range.second);
    if (m_given && m_given->is_array())
        throw py::value_error(what + ": scene light is \"HDR\"; numpy.clip(array, 0, 1) cuts it "
                                     "off");
    m_warning = what + ": the others are clamped";
}

void EvaluatedImage::tag(const char* space) {
    const OIIO::ImageBuf& image = buf();
    OIIO::ImageSpec spec = image.spec();
    retag(spec, space);
    if (image.localpixels() && !image.deep()) {
        m_own = oiio::view_with_spec(image, spec);
    } else {
        if (!m_own.initialized())
            m_own = image;
        m_own.specmod().extra_attribs = spec.extra_attribs;
    }
}

void warn(const std::string& text) {
    if (PyErr_WarnEx(PyExc_UserWarning, valid_utf8(text).c_str(), 1) != 0)
        throw py::error_already_set();
}

} // namespace tonetool::python
