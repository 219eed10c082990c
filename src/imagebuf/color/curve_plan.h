// SPDX-License-Identifier: BSD-3-Clause
// A tone curve of the public options as the numbers that kernels run on.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kernels/curve.h"
#include "tonetool/tonemap.h"

namespace tonetool {

struct CurvePlan {
    std::string name; ///< of the registry, or "coeffs"
    std::map<std::string, double> parameters;
    std::string on; ///< "rgb", "luminance" or "color"
    kernels::CurveNumbers numbers;
    kernels::CurveUse use;
    std::vector<double> coeffs() const; ///< six, or none
};

/// With HDR-FLIP's defaults if `flip`. Each name and value is checked here, once.
CurvePlan plan_curve(const CurveOptions& options, bool flip);

/// Whether a curve of the registry has a parameter of that name.
bool has_parameter(const CurveOptions& options, const std::string& name);

} // namespace tonetool
