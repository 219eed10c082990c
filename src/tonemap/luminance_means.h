// SPDX-License-Identifier: BSD-3-Clause
// The means of luminance that the adaptation luminance is taken from.
#pragma once

#include <cstdint>

#include "kernels/views.h"

namespace tonetool::tonemap {

struct LuminanceMeans {
    int64_t counted = 0; ///< pixels; those that are not finite or negative are not
    double max = 0, arithmetic = 0;
    double geometric = 0; ///< exp(mean of ln(L + epsilon))
    double harmonic = 0;  ///< 1 / mean of 1 / (L + epsilon)
};

/// The means of a luminance plane without padding, all 0 if no pixel counts. Sums are of rows, in
/// their order; epsilon is above 0.
LuminanceMeans luminance_means(const float* plane, int width, int height, double epsilon,
                               const kernels::ParallelFor& parallel);

} // namespace tonetool::tonemap
