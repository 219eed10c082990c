// ToneAlgo::export_lut.
#include "tonetool/lut.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>

#include "imagebuf/lut/lut_error.h"
#include "imagebuf/lut/lut_write.h"
#include "imagebuf/pixels/guard.h"
#include "tonetool/write.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

constexpr int kLeastSize = 2, kMostEntries = 65536, kMostNodes = 129;

bool check_size(int size, bool cube, std::string& error) {
    const int most = cube ? kMostNodes : kMostEntries;
    if (size == 0 || (size >= kLeastSize && size <= most))
        return true;
    error = format("size is {}: must be {} to {} {}", size, kLeastSize, most,
                   cube ? "nodes along an edge of the cube" : "entries");
    return false;
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
    return contained(error, [&](std::string& why) {
        const QuietOcio quiet;
        const std::string extension =
            OIIO::Strutil::lower(OIIO::Filesystem::extension(filename, false));
        LutSource source;
        LutShaper shaper;
        if (!source.open(options, why) || !shaper.make(options, why) ||
            !check_format(extension, source, why) ||
            !check_size(options.size, is_cube(extension, source, shaper), why))
            return false;
        const LutSteps steps = holds_scene_light(extension)
                                   ? scene_steps(source, shaper, options.size, extension == "ctf")
                                   : shaped_steps(source, shaper, options.size);
        const LutRemarks remarks = remarks_of(extension, source, shaper);
        LutSummary found;
        found.format = extension;
        found.structure = steps.structure;
        found.input = remarks.taken();
        measure_lut(source, shaper, steps, found);
        if (!write_bytes(lut_text(extension, steps, remarks), filename, why))
            return false;
        if (summary)
            *summary = found;
        return true;
    });
}

} // namespace tonetool
