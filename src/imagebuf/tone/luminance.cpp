// SPDX-License-Identifier: BSD-3-Clause
// The public functions of include/tonetool/luminance.h.
#include "tonetool/luminance.h"

#include <OpenImageIO/imagebufalgo.h>
#include <cmath>

#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/ignored_pixels.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/row_source.h"
#include "metrics/luminance.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

void measure(LuminanceStats& stats, const ImageBuf& src, const PixelOptions& options, ROI roi,
             int nthreads, const IgnoreOptions& without) {
    check_readable(src, "source");
    const ROI region = part_of(src, roi);
    IgnoredPixels ignored;
    ignored.open(without, src.spec(), region);
    ColorReader reader;
    reader.ignore(ignored.any() ? &ignored : nullptr);
    reader.open(src, options, region, false, nthreads);
    ColorPlanes planes = reader.planes();
    const auto luminance = read_luminance(reader, planes, nthreads);
    const int64_t pixels = ignored.counted(region);
    if (planes.counts.nonfinite == pixels)
        throw Refusal("the image has no finite pixel");
    stats = metrics::luminance(luminance.data(), region.width(), region.height(),
                               make_parallel(nthreads));
    stats.pixels = pixels;
    stats.nonfinite = planes.counts.nonfinite;
    stats.negative = planes.counts.negative;
    stats.layer = planes.choice.layer;
    stats.space = planes.choice.space;
}

void scale_color(ImageBuf& dst, const ImageBuf& src, double stops, const PixelOptions& options,
                 ROI roi, int nthreads) {
    check_readable(src, "source");
    const ColorChoice choice = chosen_color(deciding_spec(src), options);
    if (!(stops >= -126 && stops <= 126))
        throw Refusal(
            OIIO::Strutil::fmt::format("exposure is {}: must be -126 to 126 stops", stops));
    if (choice.display_encoded)
        throw Refusal("the image is display-encoded (" + choice.space +
                      "): exposure needs linear values; convert it first or pass from=");
    std::vector<float> factor(size_t(src.nchannels()), 1.0f);
    for (int channel : channels_of(choice))
        factor[size_t(channel)] = float(std::exp2(stops));
    // In float, lest a half overflows or an integer is cut off.
    ImageBuf out = copy_pixels(src, part_of(src, roi), nthreads);
    if (!OIIO::ImageBufAlgo::mul(out, out, factor, {}, nthreads))
        throw Refusal(out.geterror());
    dst = std::move(out);
}

} // namespace

namespace ToneAlgo {

bool luminance_stats(LuminanceStats& stats, const ImageBuf& src, std::string& error,
                     const PixelOptions& options, ROI roi, int nthreads,
                     const IgnoreOptions& ignored) {
    return contained(error, [&] { measure(stats, src, options, roi, nthreads, ignored); });
}

bool exposure(ImageBuf& dst, const ImageBuf& src, double stops, const PixelOptions& options,
              ROI roi, int nthreads) {
    return guarded(dst, "exposure", [&] { scale_color(dst, src, stops, options, roi, nthreads); });
}

ImageBuf exposure(const ImageBuf& src, double stops, const PixelOptions& options, ROI roi,
                  int nthreads) {
    ImageBuf dst;
    exposure(dst, src, stops, options, roi, nthreads);
    return dst;
}

} // namespace ToneAlgo
} // namespace tonetool
