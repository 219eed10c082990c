// SPDX-License-Identifier: BSD-3-Clause
// Tone curves on rows of pixels, in float lanes (Google Highway, dynamic dispatch).
#pragma once

#include "kernels/curve.h"

namespace tonetool::kernels {

/// Exposes (multiplies by `scale`) and tone maps `count` pixels; in and out may be the same, and
/// nothing beyond `count` is touched. Values must be finite and >= 0; exposed ones are cut off at
/// kLargestExposed. Where the luminance is 0 or denormal the result on luminance is 0.
void curve_rows(const CurveNumbers& curve, const CurveUse& use, const float* const in[3],
                float* const out[3], ptrdiff_t count, float scale);

/// The instruction set that tone_map_rows runs on: "AVX2".
const char* curve_target();

} // namespace tonetool::kernels
