// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "kernels/curve_reference.h"
#include "tonemap/curves.h"
#include "tonemap/rational.h"

namespace tonetool::tonemap {
namespace {

using kernels::curve_reference;
using kernels::CurveKind;
using kernels::CurveNumbers;

constexpr double kLargest = 0x1p64;

// Exact: near an asymptote the curve itself no longer tells its values apart.
std::optional<double> rational_inverse(const CurveNumbers& curve, double y) {
    const auto& k = curve.p;
    auto roots = roots_within(k[0] - y * k[3], k[1] - y * k[4], k[2] - y * k[5], kLargest);
    while (!roots.empty() && !std::isfinite(curve_reference(curve, roots.back())))
        roots.pop_back();
    return roots.empty() ? std::nullopt : std::optional(roots.back());
}

// -1, 0, 1: the curve is below y, there, above. A few ulp are rounding: a curve must be found to
// reach its white.
int side(const CurveNumbers& curve, double x, double y) {
    const double off = curve_reference(curve, x) - y, rounding = 1e-15 * std::abs(y);
    return (off > rounding) - (off < -rounding);
}

// Bisects between `low` and `high`, which are on different sides, for the end of the side that
// `high` is on.
double boundary(const CurveNumbers& curve, double y, double low, double high) {
    const int beyond = side(curve, high, y);
    for (;;) {
        const double middle = low + (high - low) / 2;
        if (!(middle > low && middle < high))
            return beyond == 0 ? high : low;
        (side(curve, middle, y) == beyond ? high : low) = middle;
    }
}

} // namespace

// Searches downwards in sixteenths of an octave: of the curves of the registry only the rational
// ones have turning points.
std::optional<double> inverse(const CurveNumbers& curve, double y) {
    if (curve.kind == CurveKind::Rational)
        return rational_inverse(curve, y);
    const int beyond = side(curve, kLargest, y);
    double high = kLargest;
    for (int i = 1; i <= 128 * 16; ++i) {
        const double low = i < 128 * 16 ? std::exp2(64 - i / 16.0) : 0;
        if (side(curve, low, y) != beyond)
            return boundary(curve, y, low, high);
        high = low;
    }
    return beyond == 0 ? std::optional(0.0) : std::nullopt;
}

} // namespace tonetool::tonemap
