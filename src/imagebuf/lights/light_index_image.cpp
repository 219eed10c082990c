// SPDX-License-Identifier: BSD-3-Clause
// ToneAlgo::light_index.
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/lights/light_index.h"
#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/guard.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;

constexpr const char* kName = "lightindex";

ImageSpec index_spec(const ImageSpec& source, ROI region, const LightScan& scan) {
    ImageSpec spec = source;
    spec.x = region.xbegin;
    spec.y = region.ybegin;
    spec.width = region.width();
    spec.height = region.height();
    spec.nchannels = 1;
    spec.channelnames = {kName};
    spec.channelformats.clear();
    spec.alpha_channel = spec.z_channel = -1;
    spec.set_format(OIIO::TypeFloat);
    for (const char* color : {"chromaticities", "oiio:ColorSpace"})
        spec.erase_attribute(color);
    std::vector<std::string> names;
    for (const ScannedGroup& group : scan.groups())
        names.push_back(group.group.name);
    spec.attribute("lightindex:names", OIIO::Strutil::join(names, ","));
    return spec;
}

LightIndexSummary summary_of(const LightScan& scan, const LightTable* table,
                             const ColorChoice& choice) {
    LightIndexSummary out;
    out.layer = choice.layer;
    out.space = choice.space;
    const auto lights = table ? lights_of(*table, scan.groups())
                              : std::vector<const Light*>(scan.groups().size(), nullptr);
    for (size_t g = 0; g < lights.size(); ++g) {
        const ScannedGroup& from = scan.groups()[g];
        out.groups.push_back({from.group.name, from.group.layer, from.pixels, from.maximum,
                              lights[g] ? lights[g]->luminance : std::nullopt});
        if (table && !lights[g])
            out.warnings.push_back("light group \"" + from.group.name + "\" is not in \"" +
                                   table->file() + "\" (" + table->list() + ")");
    }
    out.unlit = scan.unlit();
    out.sum = scan.sum();
    out.difference = scan.difference();
    for (const std::string& warning : scan.warnings())
        out.warnings.push_back(warning);
    if (std::all_of(out.groups.begin(), out.groups.end(),
                    [](const LightGroupSummary& group) { return group.pixels == 0; }))
        out.warnings.push_back("all light groups are black");
    return out;
}

void make_index(ImageBuf& dst, const ImageBuf& src, const LightOptions& options,
                const PixelOptions& pixels, LightIndexSummary* summary, ROI roi, int nthreads) {
    check_readable(src, "source");
    const ROI region = part_of(src, roi);
    const ColorChoice choice = chosen_color(deciding_spec(src), pixels);
    LightTable table;
    const LightTable* lights = options.table.empty() ? nullptr : &table;
    if (lights)
        table.read(options.table, options.unit);
    LightScan scan = open_scan(src, pixels, options, lights, region, nthreads);
    if (scan.groups().empty())
        throw Refusal("no light groups among the layers (groups= names them); layers: " +
                      OIIO::Strutil::join(ToneAlgo::color_layers(src.spec()), ", "));
    ImageBuf out = allocated_image(index_spec(src.spec(), region, scan));
    auto* to = static_cast<float*>(out.localpixels());
    const auto width = size_t(region.width());
    const auto write = [&](int y, const int* indices) {
        std::copy_n(indices, width, to + size_t(y - region.ybegin) * width);
    };
    scan.run(write);
    if (summary)
        *summary = summary_of(scan, lights, choice);
    dst = std::move(out);
}

} // namespace

bool ToneAlgo::light_index(ImageBuf& dst, const ImageBuf& src, const LightOptions& lights,
                           const PixelOptions& options, LightIndexSummary* summary, ROI roi,
                           int nthreads) {
    return guarded(dst, "light_index",
                   [&] { make_index(dst, src, lights, options, summary, roi, nthreads); });
}

ImageBuf ToneAlgo::light_index(const ImageBuf& src, const LightOptions& lights,
                               const PixelOptions& options, LightIndexSummary* summary, ROI roi,
                               int nthreads) {
    ImageBuf dst;
    light_index(dst, src, lights, options, summary, roi, nthreads);
    return dst;
}

} // namespace tonetool
