// SPDX-License-Identifier: BSD-3-Clause
// Luminance statistics and exposure.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

#include "tonetool/compare.h"
#include "tonetool/export.h"
#include "tonetool/numbers.h"
#include "tonetool/pixels.h"

namespace tonetool {

namespace ToneAlgo {

/// Measure an image. Returns false with the reason in `error`; deep images, images without colour
/// and images without a finite pixel are errors. An ImageBuf that was not read is read from its
/// file in bands, as ldr_flip says; then 4 bytes per pixel are held. What `ignored` leaves out is
/// in no number.
TONETOOL_API bool luminance_stats(LuminanceStats& stats, const OIIO::ImageBuf& src,
                                  std::string& error, const PixelOptions& options = {},
                                  OIIO::ROI roi = {}, int nthreads = 0,
                                  const IgnoreOptions& ignored = {});

/// Multiply the colour of an image by 2^stops. Only R, G, B of the layer that options choose are
/// scaled, in float, so that nothing overflows; alpha and every other channel are carried
/// unchanged. Non-finite pixels stay as they are. The image must be linear: a display-encoded one
/// is an error, as are stops outside
/// [-126, 126].
TONETOOL_API bool exposure(OIIO::ImageBuf& dst, const OIIO::ImageBuf& src, double stops,
                           const PixelOptions& options = {}, OIIO::ROI roi = {}, int nthreads = 0);
TONETOOL_API OIIO::ImageBuf exposure(const OIIO::ImageBuf& src, double stops,
                                     const PixelOptions& options = {}, OIIO::ROI roi = {},
                                     int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
