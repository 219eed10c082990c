// SPDX-License-Identifier: BSD-3-Clause
// ToneAlgo::frame_light: what is measured of a frame of a shot.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/row_source.h"
#include "imagebuf/tone/counted_pixels.h"
#include "imagebuf/tone/header_light.h"
#include "imagebuf/tone/shot_statistics.h"
#include "tonemap/cell_mean.h"
#include "tonemap/luminance_means.h"
#include "tonemap/shot.h"
#include "tonetool/shot.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// Added to luminances that are above 0.
constexpr double kNoEpsilon = 1e-30;

void measure(FrameLight& light, const ImageBuf& src, const PixelOptions& options, int nthreads) {
    check_readable(src, "source");
    const ROI region = part_of(src, {});
    const auto parallel = make_parallel(nthreads);
    ColorReader reader;
    reader.keep_color_of_any_alpha();
    reader.open(src, options, region, true, nthreads);
    ColorPlanes planes = reader.planes();
    reader.read(region.ybegin, region.yend, planes);
    const PagedArray<float> luminance = read_luminance(reader, planes, nthreads);
    const int width = region.width(), height = region.height();
    // What shows no surface matters only where there is no light.
    const bool dark = std::any_of(luminance.data(), luminance.data() + region.npixels(),
                                  [](float v) { return v <= 0; });
    const auto background =
        dark ? background_of(src, planes.choice.layer, region, nthreads) : std::vector<uint8_t>();
    const bool alpha = planes.choice.a >= 0 && !planes.alpha.empty();
    const CountedPixels counted = counted_pixels(
        luminance.data(), width, height,
        {alpha ? planes.alpha.data() : nullptr, background.empty() ? nullptr : background.data()},
        parallel);
    const float* const plane = counted.luminance.data();
    const auto means = tonemap::luminance_means(plane, width, height, kNoEpsilon, parallel);
    light.counted = means.counted;
    light.maximum = means.max;
    light.shown = 1 - double(counted.nothing) / double(region.npixels());
    light.lwa = tonemap::cell_mean(plane, width, height, parallel).mean;
    light.lwa_geometric = light.lmax = 0;
    if (light.counted > 0) {
        const metrics::OrderStatistics order(plane, width, height, width, parallel);
        light.lwa_geometric = means.geometric;
        light.lmax = order.find({maximum_of_lit(kShotPercentile, light.counted)})[0];
    }
    light.histogram = tonemap::light_histogram(plane, int64_t(region.npixels()));
    light.thumbnail = tonemap::thumbnail_of(luminance.data(), width, height);
    for (double& v : light.thumbnail)
        v = std::round(v * kThumbnailSteps) / kThumbnailSteps;
    const OIIO::ImageSpec& spec = src.nativespec();
    light.unit = header_unit(spec);
    light.fps = header_number(spec, {"FramesPerSecond"});
}

} // namespace

bool ToneAlgo::frame_light(FrameLight& light, const ImageBuf& src, std::string& error,
                           const PixelOptions& options, int nthreads) {
    return contained(error, [&] { measure(light, src, options, nthreads); });
}

} // namespace tonetool
