// SPDX-License-Identifier: BSD-3-Clause
// The sums behind the means of luminance, row by row in float lanes (Google Highway, dynamic
// dispatch).
#pragma once

#include <cstddef>
#include <cstdint>

namespace tonetool::kernels {

struct LuminanceSums {
    int64_t counted = 0; ///< values that are finite and not negative; the others take no part
    double values = 0;
    double logs = 0;        ///< of ln(L + epsilon)
    double reciprocals = 0; ///< of 1 / (L + epsilon)
    float most = 0;
};

/// The sums of `count` values; epsilon is not 0. Logarithms are those of float lanes, to 2e-7.
LuminanceSums luminance_sums(const float* luminance, ptrdiff_t count, float epsilon);

} // namespace tonetool::kernels
