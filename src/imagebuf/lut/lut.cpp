// SPDX-License-Identifier: BSD-3-Clause
// ToneAlgo::export_lut.
#include "tonetool/lut.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>

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
    if (structure == Structure::Channel)
        return false;
    if (structure == Structure::Matrices)
        return !holds_scene_light(format);
    return structure == Structure::Other || format != "ctf" || !shaper.is_log2();
}

LutRemarks remarks_of(const std::string& format, const LutSource& source, const LutShaper& shaper) {
    const std::string title = "tonetool " TONETOOL_VERSION ": " + source.name();
    const std::string formula = holds_scene_light(format) ? "" : shaper.formula();
    return {title, source.input(), source.output(), formula};
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
        LutShaper shaper;
        source.open(options);
        shaper.make(options);
        check_format(extension, source);
        check_size(options.size, is_cube(extension, source, shaper));
        const LutSteps steps = holds_scene_light(extension)
                                   ? scene_steps(source, shaper, options.size, extension == "ctf")
                                   : shaped_steps(source, shaper, options.size);
        const LutRemarks remarks = remarks_of(extension, source, shaper);
        LutSummary found;
        found.format = extension;
        found.structure = steps.structure;
        found.input = remarks.taken();
        measure_lut(source, shaper, steps, found);
        if (std::string why; !write_bytes(lut_text(extension, steps, remarks), filename, why))
            throw Refusal(why);
        if (summary)
            *summary = found;
    });
}

} // namespace tonetool
