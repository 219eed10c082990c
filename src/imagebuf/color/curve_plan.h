// SPDX-License-Identifier: BSD-3-Clause
// A tone curve of the public options as the numbers that kernels run on.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kernels/curve.h"
#include "tonemap/table_curve.h"
#include "tonetool/tonemap.h"

namespace tonetool {

struct CurvePlan {
    std::string name; ///< of the registry, of the file without its folder, or "coeffs"
    std::map<std::string, double> parameters;
    std::string on; ///< "rgb", "luminance" or "color"
    kernels::CurveNumbers numbers;
    kernels::CurveUse use;
    std::optional<tonemap::TableFacts> table; ///< of a curve from a file
    std::vector<double> coeffs() const;       ///< six, or none
    std::string table_text() const;           ///< as in TonemapSummary
};

/// With HDR-FLIP's defaults if `flip`. Each name and value is checked here, once. `encode`: what
/// the results of a file are, where they are encoded.
CurvePlan plan_curve(const CurveOptions& options, bool flip, const std::string& encode = "srgb");

/// Six coefficients take the place of the name.
bool is_rational(const CurveOptions& options);

/// Whether the curve has a parameter of that name.
bool has_parameter(const CurveOptions& options, const std::string& name);

} // namespace tonetool
