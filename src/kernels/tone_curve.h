// SPDX-License-Identifier: BSD-3-Clause
// The tone curves that HDR-FLIP runs, as plain numbers.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "kernels/curve.h"

namespace tonetool::kernels {

enum class ToneKind {
    None,              ///< the value itself (LDR-FLIP)
    Rational,          ///< Eq. 1 per channel
    ReinhardLuminance, ///< RGB / (1 + luminance)
};

/// y = (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5), HDR-FLIP paper Eq. 1. The result is clamped to
/// [0,1] wherever a curve is applied.
struct ToneCurve {
    ToneKind kind = ToneKind::None;
    std::array<double, 6> k{};
};

/// Tone maps rows by other means than a ToneCurve: `count` pixels of finite values >= 0 are
/// multiplied by `scale` and mapped to linear Rec.709 display light in [0,1]. In and out do not
/// overlap. Called by several threads at a time.
using ToneRows = std::function<void(const float* const in[3], float* const out[3], ptrdiff_t count,
                                    float scale)>;

/// Exposed values are cut off here before the curve: x^2 stays finite in float and every curve
/// has long reached its end. Without it an infinite x^2 / x^2 turns a bright pixel black.
inline constexpr float kLargestExposed = 1e15f;

} // namespace tonetool::kernels
