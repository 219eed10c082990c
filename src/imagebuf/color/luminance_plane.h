// SPDX-License-Identifier: BSD-3-Clause
// Luminances of a region, read band by band.
#pragma once

#include <string>

#include "imagebuf/color/color_reader.h"
#include "imagebuf/pixels/paged_array.h"
#include "metrics/luminance.h"

namespace tonetool {

/// Luminances of `count` pixels of linear Rec.709.
using LuminanceRow = void (*)(const float* r, const float* g, const float* b, float* out,
                              int64_t count);

/// The luminances of a region, row by row; NaN where the image does not cover it or is not finite.
/// Planes that hold the whole region are used as they are; others are read through from the top and
/// end up empty, with the counts of all pixels. Holds 4 bytes per pixel beside a band.
PagedArray<float> read_luminance(ColorReader& reader, ColorPlanes& planes, int nthreads,
                                 LuminanceRow luminances = metrics::luminance_row);

/// Bytes of the plane of luminances.
size_t luminance_bytes(const OIIO::ROI& region);
/// Rows that are read at once.
inline constexpr int kLuminanceRows = 64;

} // namespace tonetool
