// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "kernels/curve_constants.h"
#include "kernels/curve_reference.h"
#include "kernels/local_rows.h"

namespace tonetool::kernels {

std::array<double, 3> local_reference(const LocalCurve& curve, double base,
                                      const std::array<double, 3>& rgb) {
    constexpr double least = double(kSmallestLuminance);
    constexpr double largest = double(std::numeric_limits<float>::max());
    double lum = 0;
    for (size_t c = 0; c < 3; ++c)
        lum += curve.weights[c] * rgb[c];
    if (!(lum >= least && lum <= largest))
        return {};
    if (curve.log_base)
        base = std::exp(base);
    if (!(base >= least && base <= largest))
        base = lum;
    const CurveNumbers drago{CurveKind::Drago, {curve.maximum / curve.adaptation, curve.bias}};
    const double shown = curve.display_maximum / 100 *
                         curve_reference(drago, base / curve.adaptation) * (lum / base);
    std::array<double, 3> out{};
    for (size_t c = 0; c < 3; ++c)
        out[c] = shown * std::copysign(std::pow(std::abs(rgb[c]) / lum, curve.saturation), rgb[c]);
    return out;
}

} // namespace tonetool::kernels
