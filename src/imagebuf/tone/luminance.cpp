// The public functions of include/tonetool/luminance.h.
#include "tonetool/luminance.h"

#include <OpenImageIO/imagebufalgo.h>
#include <cmath>

#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/row_source.h"
#include "metrics/luminance.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

bool measure(LuminanceStats& stats, const ImageBuf& src, const PixelOptions& options, ROI roi,
             int nthreads, std::string& error) {
    if (!check_readable(src, "source", error))
        return false;
    ROI region;
    if (!part_of(src, roi, region, error))
        return false;
    ColorReader reader;
    if (!reader.open(src, options, region, false, nthreads, error))
        return false;
    ColorPlanes planes = reader.planes();
    PagedArray<float> luminance;
    if (!read_luminance(reader, planes, nthreads, luminance, error))
        return false;
    const int64_t pixels = int64_t(region.width()) * region.height();
    if (planes.counts.nonfinite == pixels) {
        error = "the image has no finite pixel";
        return false;
    }
    stats = metrics::luminance(luminance.data(), region.width(), region.height(),
                               make_parallel(nthreads));
    stats.pixels = pixels;
    stats.nonfinite = planes.counts.nonfinite;
    stats.negative = planes.counts.negative;
    stats.layer = planes.choice.layer;
    stats.space = planes.choice.space;
    return true;
}

bool scale_color(ImageBuf& dst, const ImageBuf& src, double stops, const PixelOptions& options,
                 ROI roi, int nthreads, std::string& error) {
    ColorChoice choice;
    if (!check_readable(src, "source", error) ||
        !ToneAlgo::find_color(deciding_spec(src), options, choice, error))
        return false;
    if (!(stops >= -126 && stops <= 126)) {
        error = OIIO::Strutil::fmt::format("exposure is {}: must be -126 to 126 stops", stops);
        return false;
    }
    if (choice.display_encoded) {
        error = "the image is display-encoded (" + choice.space +
                "): exposure needs linear values; convert it first or pass from=";
        return false;
    }
    std::vector<float> factor(size_t(src.nchannels()), 1.0f);
    for (int channel : channels_of(choice))
        factor[size_t(channel)] = float(std::exp2(stops));
    // In float, lest a half overflows or an integer is cut off.
    ROI part;
    ImageBuf out;
    if (!part_of(src, roi, part, error) || !copy_pixels(out, src, part, nthreads, error))
        return false;
    if (!OIIO::ImageBufAlgo::mul(out, out, factor, {}, nthreads)) {
        error = out.geterror();
        return false;
    }
    dst = std::move(out);
    return true;
}

} // namespace

namespace ToneAlgo {

bool luminance_stats(LuminanceStats& stats, const ImageBuf& src, std::string& error,
                     const PixelOptions& options, ROI roi, int nthreads) {
    return contained(
        error, [&](std::string& why) { return measure(stats, src, options, roi, nthreads, why); });
}

bool exposure(ImageBuf& dst, const ImageBuf& src, double stops, const PixelOptions& options,
              ROI roi, int nthreads) {
    return guarded(dst, "exposure", [&](std::string& error) {
        return scale_color(dst, src, stops, options, roi, nthreads, error);
    });
}

ImageBuf exposure(const ImageBuf& src, double stops, const PixelOptions& options, ROI roi,
                  int nthreads) {
    ImageBuf dst;
    exposure(dst, src, stops, options, roi, nthreads);
    return dst;
}

} // namespace ToneAlgo
} // namespace tonetool
