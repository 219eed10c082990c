// Luminance statistics of a region, read band by band.
#pragma once

#include <string>

#include "imagebuf/color_reader.h"
#include "include/tonetool/numbers.h"

namespace tonetool {

/// Statistics over the finite pixels of the region that the image covers. Planes that hold the
/// whole region are used as they are; others are read through from the top and end up empty, with
/// the counts of all pixels. Holds 4 bytes per pixel beside a band.
bool measure_luminance(ColorReader& reader, ColorPlanes& planes, int nthreads,
                       LuminanceStats& stats, std::string& error);

/// Bytes of the plane of luminances.
size_t luminance_bytes(const OIIO::ROI& region);
/// Rows that are read at once.
inline constexpr int kLuminanceRows = 64;

} // namespace tonetool
