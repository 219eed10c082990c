// SPDX-License-Identifier: BSD-3-Clause
// The rows of the registry, by family. Every function lists its curves in the order of the help.
#pragma once

#include "tonemap/curves.h"

namespace tonetool::tonemap {

std::vector<Curve> basic_curves();
std::vector<Curve> filmic_curves();
std::vector<Curve> modern_curves();

/// The parameter `white`: the scene value that becomes display white, or the nearest thing that the
/// curve has. Calibration sets it by this name.
inline CurveParameter white_parameter(double value, const char* help) {
    return {"white", value, kLeastWhite, kMostWhite, help};
}

inline kernels::CurveNumbers rational(double k0, double k1, double k2, double k3, double k4,
                                      double k5) {
    return {kernels::CurveKind::Rational, {k0, k1, k2, k3, k4, k5}};
}

} // namespace tonetool::tonemap
