// SPDX-License-Identifier: BSD-3-Clause
// The public functions of include/tonetool/tmqi.h.
#include "tonetool/tmqi.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <utility>

#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/compare/annotate.h"
#include "imagebuf/compare/pair.h"
#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/bands.h"
#include "imagebuf/pixels/deliver.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/parallel.h"
#include "kernels/tone_curve.h"
#include "metrics/refusal.h"
#include "metrics/tmqi.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

// Luminance 0 to 255 of the values that an sRGB display is sent.
void encoded_luminance_row(const float* r, const float* g, const float* b, float* out,
                           int64_t count) {
    const auto encoded = [](float v) { return linear_to_srgb(std::min(double(v), 1.0)); };
    constexpr double white = 255;
    for (int64_t i = 0; i < count; ++i)
        out[i] = float(white * (kernels::kLuminance[0] * encoded(r[i]) +
                                kernels::kLuminance[1] * encoded(g[i]) +
                                kernels::kLuminance[2] * encoded(b[i])));
}

struct JudgedSide {
    const ImageBuf& image;
    const PixelOptions& pixels;
    const char* who;
    LuminanceRow luminances;
    PagedArray<float> plane;
    FlipSide found;

    void read(const ROI& region, uint64_t memory, int nthreads) {
        ColorReader reader;
        of_side(side_name(who, image),
                [&] { reader.open(image, pixels, region, false, nthreads); });
        if (memory > 0)
            reader.save_memory();
        ColorPlanes planes = reader.planes();
        const std::string name = std::string("the ") + who + " image";
        check_covered(planes, name);
        plane = of_side(side_name(who, image),
                        [&] { return read_luminance(reader, planes, nthreads, luminances); });
        found = side_of(planes);
        check_finite(planes, name);
    }
};

void check_region(const ROI& region, uint64_t memory, int nthreads) {
    if (std::min(region.width(), region.height()) < metrics::kTmqiWindow)
        throw Refusal(format("{}x{} pixels are compared: needs {} or more in each direction",
                             region.width(), region.height(), metrics::kTmqiWindow));
    // Two planes of luminance and the map, and at half the size two planes of doubles and, while
    // they are made, the two above them. Reading takes less than what comes after it.
    constexpr uint64_t pixel = 17;
    const auto threads = uint64_t(oiio::threads_of(nthreads));
    const uint64_t least = kSetAside +
                           uint64_t(region.width()) * uint64_t(region.height()) * pixel +
                           threads * metrics::tmqi_work_bytes(region.width(), region.height());
    if (memory > 0 && least > memory)
        throw Refusal("memory is " + size_text(memory) + ": needs at least " + size_text(least));
}

ImageBuf make_map(const ROI& region, const ROI& full) {
    OIIO::ImageSpec spec(region.width(), region.height(), 1, OIIO::TypeFloat);
    spec.x = region.xbegin;
    spec.y = region.ybegin;
    ImageBuf map = allocated_image(spec);
    map.set_roi_full(full);
    return map;
}

void score(ImageBuf& dst, const ImageBuf& hdr, const ImageBuf& ldr, const TmqiOptions& options,
           TmqiSummary& summary, int nthreads) {
    const SizePolicy size = options.crop ? SizePolicy::Crop : SizePolicy::Match;
    check_readable(hdr, "HDR");
    check_readable(ldr, "display");
    check_orientation(hdr, ldr);
    const ROI region = summary.region = compared_region(hdr, ldr, size);
    check_region(region, options.memory, nthreads);
    JudgedSide light{hdr, options.hdr, "HDR", metrics::luminance_row, {}, {}};
    JudgedSide shown{ldr, options.ldr, "display", encoded_luminance_row, {}, {}};
    light.read(region, options.memory, nthreads);
    shown.read(region, options.memory, nthreads);
    const auto parallel = make_parallel(nthreads);
    const metrics::TmqiPair pair{light.plane.data(), shown.plane.data(), region.width(),
                                 region.height()};
    const auto range = metrics::light_range(pair.hdr, pair.width, pair.height, parallel);
    if (!(range.low < range.high))
        throw Refusal(format(
            "the HDR image's luminance is {} everywhere: there is no range to show", range.low));
    ImageBuf map = make_map(region, hdr.roi_full());
    summary.score = metrics::tmqi(pair, range, static_cast<float*>(map.localpixels()), parallel);
    summary.hdr = light.found;
    summary.ldr = shown.found;
    warn_of_holes(summary.hdr, "the HDR image", summary.warnings);
    warn_of_holes(summary.ldr, "the display image", summary.warnings);
    annotate(map.specmod(), summary);
    deliver(dst, std::move(map), "TMQI:");
}

struct TmqiQuantity {
    const char* name;
    double TmqiScore::*value;
};

constexpr TmqiQuantity kTmqiQuantities[] = {
    {"Q", &TmqiScore::q}, {"S", &TmqiScore::s}, {"N", &TmqiScore::n}};

} // namespace

namespace ToneAlgo {

bool tmqi(ImageBuf& dst, const ImageBuf& hdr, const ImageBuf& ldr, const TmqiOptions& options,
          TmqiSummary* summary, int nthreads) {
    TmqiSummary found;
    if (!guarded(dst, "tmqi", [&] { score(dst, hdr, ldr, options, found, nthreads); }))
        return false;
    if (summary)
        *summary = std::move(found);
    return true;
}

ImageBuf tmqi(const ImageBuf& hdr, const ImageBuf& ldr, const TmqiOptions& options,
              TmqiSummary* summary, int nthreads) {
    ImageBuf dst;
    tmqi(dst, hdr, ldr, options, summary, nthreads);
    return dst;
}

std::optional<double> tmqi_quantity(const TmqiScore& score, const std::string& name) {
    for (const TmqiQuantity& q : kTmqiQuantities)
        if (name == q.name)
            return score.*q.value;
    return std::nullopt;
}

std::vector<std::string> tmqi_quantities() {
    std::vector<std::string> names;
    for (const TmqiQuantity& q : kTmqiQuantities)
        names.emplace_back(q.name);
    return names;
}

} // namespace ToneAlgo
} // namespace tonetool
