// Luminance statistics of an image.
#pragma once

#include <cstdint>
#include <vector>

#include "include/tonetool/numbers.h"
#include "kernels/views.h"

namespace tonetool::metrics {

/// Statistics of finite, non-negative linear Rec.709. `skip`, if not empty, marks (row by row,
/// without padding) the pixels that are not to be looked at. Fills every figure of LuminanceStats
/// but the counts of pixels, non-finite and negative ones, the layer and the space.
LuminanceStats luminance(const kernels::ConstRgb& image, const std::vector<uint8_t>& skip);

/// The same of a plane of luminances without padding, NaN where a pixel is not to be looked at.
LuminanceStats luminance(const float* plane, int width, int height,
                         const kernels::ParallelFor& parallel);

/// Luminance of `n` pixels.
void luminance_row(const float* r, const float* g, const float* b, float* out, int64_t n);

} // namespace tonetool::metrics
