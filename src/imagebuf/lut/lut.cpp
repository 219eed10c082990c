// SPDX-License-Identifier: BSD-3-Clause
// ToneAlgo::export_lut.
#include "tonetool/lut.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>

#include "imagebuf/lut/lut_acv.h"
#include "imagebuf/lut/lut_error.h"
#include "imagebuf/lut/lut_write.h"
#include "imagebuf/options/tone_options.h"
#include "imagebuf/pixels/guard.h"
#include "metrics/refusal.h"
#include "tonetool/write.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

constexpr int kMostNodes = 129;

void check_size(int size, bool cube) {
    if (cube && size > kMostNodes)
        throw Refusal(format("size is {}: must be 2 to {} nodes along an edge of the cube", size,
                             kMostNodes));
}

bool is_cube(const std::string& format, const LutSource& source, const LutShaper& shaper) {
    using Structure = LutSource::Structure;
    const Structure structure = source.structure();
    if (structure == Structure::Channel || format == "spi1d")
        return false;
    if (structure == Structure::Matrices)
        return !holds_scene_light(format);
    return structure == Structure::Other || format != "ctf" || !shaper.is_log2();
}

LutRemarks remarks_of(const std::string& format, const LutSource& source, const LutShaper& shaper) {
    const std::string title = "tonetool " TONETOOL_VERSION ": " + source.name();
    const std::string formula = holds_scene_light(format) ? "" : shaper.formula();
    return {title, source.input(), source.output(), formula, ""};
}

constexpr char kGreysOnly[] = "luminance curve: exact for greys only";

// The text of a look-up table.
std::string make_lut(const LutOptions& options, const LutSource& source, LutSummary& summary) {
    const std::string& format = summary.format;
    LutShaper shaper;
    shaper.make(options);
    check_format(format, source);
    const bool cube = is_cube(format, source, shaper);
    check_size(options.size, cube);
    if (options.white != 0)
        throw Refusal("white is of .acv, or a parameter of the curve");
    const LutSteps steps = holds_scene_light(format)
                               ? scene_steps(source, shaper, options.size, format == "ctf")
                               : shaped_steps(source, shaper, options.size, cube);
    LutRemarks remarks = remarks_of(format, source, shaper);
    if (!summary.remarks.empty())
        remarks.note = summary.remarks.front();
    summary.structure = steps.structure;
    summary.input = remarks.taken();
    measure_lut(source, shaper, steps, summary);
    return lut_text(format, steps, remarks);
}

} // namespace

bool ToneAlgo::export_lut(const std::string& filename, const LutOptions& options,
                          LutSummary* summary, std::string& error) {
    return contained(error, [&] {
        const QuietOcio quiet;
        const std::string extension =
            OIIO::Strutil::lower(OIIO::Filesystem::extension(filename, false));
        LutOptions used = options;
        if (options.view)
            used.encode = LutOptions().encode; // of curves
        check_options(used);
        LutSource source;
        source.open(options);
        LutSummary found;
        found.format = extension;
        if ((extension == "spi1d" || extension == "acv") && source.curve().use.on_luminance)
            found.remarks.emplace_back(kGreysOnly);
        const std::string bytes = extension == "acv" ? make_acv(options, source, found)
                                                     : make_lut(options, source, found);
        if (std::string why; !write_bytes(bytes, filename, why))
            throw Refusal(why);
        if (summary)
            *summary = found;
    });
}

} // namespace tonetool
