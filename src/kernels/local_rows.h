// SPDX-License-Identifier: BSD-3-Clause
// A tone curve on the base of an image, its detail multiplied back, on rows of pixels in float
// lanes (Google Highway, dynamic dispatch).
#pragma once

#include <array>
#include <cstddef>

#include "kernels/curve.h"

namespace tonetool::kernels {

/// Drago's curve as a local operator: Ld = T(Lb) (L / Lb), and C' = (C / L)^saturation Ld.
struct LocalCurve {
    double adaptation = 1; ///< Lwa, which luminance is counted in
    double maximum = 1;    ///< Lmax, in the unit of luminance: what becomes display_maximum / 100
    double bias = 0.85;
    double display_maximum = 100; ///< cd/m2
    double saturation = 1;
    std::array<double, 3> weights = kLuminance; ///< of luminance
    bool log_base = false;                      ///< the base is a natural logarithm
};

/// Luminance of `count` pixels. These functions take any count, and in and out may be the same.
void luminance_rows(const std::array<double, 3>& weights, const float* const in[3], float* out,
                    ptrdiff_t count);

/// scale log2 of luminance, of `least` where it is smaller; NaN for what is not finite or negative.
void log_rows(const float* in, float* out, ptrdiff_t count, float least, float scale);

/// Tone maps pixels to display light, which is not clamped. The result is 0 where luminance is not
/// a finite positive number. Where the base is not one, luminance itself is the base, so there is
/// no detail. The curve stays at its end beyond Lmax. With saturation 1 negative channels remain
/// what they are to the luminance; otherwise their magnitudes are raised and they keep their sign.
void local_rows(const LocalCurve& curve, const float* base, const float* const in[3],
                float* const out[3], ptrdiff_t count);

/// The reference implementation of local_rows for one pixel, in double precision.
std::array<double, 3> local_reference(const LocalCurve& curve, double base,
                                      const std::array<double, 3>& rgb);

} // namespace tonetool::kernels
