// SPDX-License-Identifier: BSD-3-Clause
// Luminance statistics of an image.
#pragma once

#include <cstdint>

#include "kernels/views.h"
#include "tonetool/numbers.h"

namespace tonetool::metrics {

/// Luminance of `count` pixels of linear Rec.709.
void luminance_row(const float* r, const float* g, const float* b, float* out, int64_t count);

/// The luminances that the exposures of HDR-FLIP follow from; LuminanceStats says what each is.
struct ExposureStats {
    int64_t counted = 0, black = 0;
    double max = 0, median = 0, median_lit = 0;
};

/// The statistics of a luminance plane without padding; non-finite values are skipped.
ExposureStats exposure_statistics(const float* plane, int width, int height,
                                  const kernels::ParallelFor& parallel);

/// The same for all of LuminanceStats. Fills every figure of LuminanceStats but the counts of
/// pixels, non-finite and negative ones, the layer and the space.
LuminanceStats luminance(const float* plane, int width, int height,
                         const kernels::ParallelFor& parallel);

} // namespace tonetool::metrics
