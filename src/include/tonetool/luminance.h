// Luminance statistics and exposure.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>

#include "tonetool/export.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// Luminance 0.2126 R + 0.7152 G + 0.0722 B of linear Rec.709, negative components set to 0,
/// over the finite pixels of the data window.
struct LuminanceStats {
    int64_t pixels = 0;    ///< in the data window (or the ROI)
    int64_t nonfinite = 0; ///< with NaN or Inf in R, G or B: not in any figure below
    int64_t negative = 0;  ///< finite, with a negative R, G or B
    int64_t black = 0;     ///< luminance exactly 0
    double min = 0, max = 0, mean = 0;
    double median = 0;      ///< element of rank n/2 (the upper median), as HDR-FLIP takes it
    double median_lit = 0;  ///< the same over luminance > 0
    double log_average = 0; ///< geometric mean over luminance > 0
    double p1 = 0, p99 = 0, p999 = 0; ///< nearest-rank percentiles
    std::string layer, space;
};

namespace ToneAlgo {

/// Measure an image. Returns false with the reason in src.geterror(); deep images, images
/// without colour and images without a finite pixel are errors.
TONETOOL_API bool luminance_stats(LuminanceStats& stats, const OIIO::ImageBuf& src,
                                  const PixelOptions& options = {}, OIIO::ROI roi = {},
                                  int nthreads = 0);

/// Multiply the colour of an image by 2^stops. Only R, G, B of the layer that options choose are
/// scaled; alpha and every other channel are carried unchanged. Non-finite pixels stay as they
/// are. The image must be linear: a display-encoded one is an error, as are stops outside
/// [-126, 126].
TONETOOL_API bool exposure(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src, double stops,
                           const PixelOptions& options = {}, OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf exposure(const OIIO::ImageBuf& src, double stops,
                                     const PixelOptions& options = {}, OIIO::ROI roi = {},
                                     int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
