// SPDX-License-Identifier: BSD-3-Clause
// Rational tone curves by their six coefficients (HDR-FLIP paper, Eq. 1).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/tone_curve.h"

namespace tonetool::tonemap {

/// aces, hable, reinhard: with `k` set for all, since exposures are solved on Eq. 1.
std::optional<kernels::ToneCurve> rational_curve(std::string_view name);
std::vector<std::string> rational_curve_names();

/// Roots of a x^2 + b x + c in [0, largest], ascending; none where it is 0 everywhere.
std::vector<double> roots_within(double a, double b, double c, double largest);

/// Where a curve of Eq. 1 is unusable between 0 and `largest`: a pole (the denominator has a
/// zero) or a place where it does not increase. Empty text if there is no such place.
std::string curve_fault(const std::array<double, 6>& k, double largest);

} // namespace tonetool::tonemap
