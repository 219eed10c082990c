// SPDX-License-Identifier: BSD-3-Clause
// The registry of tone curves: one row each. Options, help, tests, look-up tables and figures are
// all read from these rows.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kernels/curve.h"

namespace tonetool::tonemap {

struct CurveParameter {
    const char* name; ///< "white"
    double value;     ///< default
    double low, high; ///< closed range of valid values
    const char* help;
    /// The default in HDR-FLIP, where its paper has another one.
    std::optional<double> flip_value{};
    /// It may have a value for each of R, G and B.
    bool per_channel = false;
};

enum class CurveDomain {
    Channel,   ///< on each channel, unless asked otherwise
    Luminance, ///< on luminance, unless asked otherwise
    Color,     ///< mixes the channels: neither can be chosen
};

/// Range of the parameter `white` of most curves.
inline constexpr double kLeastWhite = 1e-4, kMostWhite = 1e9;

/// Values of the parameters, in the order of the row.
using CurveValues = std::vector<double>;

struct Curve {
    const char* name;    ///< "aces"
    const char* title;   ///< "ACES, Narkowicz's fit"
    const char* source;  ///< whom and what it is from
    const char* formula; ///< as one line of text
    CurveDomain domain;
    bool encoded;  ///< the published formula gives display-encoded values, decoded here
    bool monotone; ///< a brighter grey never becomes darker; clamped to [0,1] this holds for all
    std::vector<CurveParameter> parameters;
    kernels::CurveNumbers (*make)(const CurveValues&);
    const char* note = ""; ///< what a user must know: "clamped where it exceeds 1"
};

const std::vector<Curve>& all_curves();
const Curve* find_curve(std::string_view name);
std::vector<std::string> curve_names();
/// Every parameter name of any curve, once, in the order of first appearance.
std::vector<std::string> curve_parameter_names();

/// Defaults, with those of `given` in their place. An unknown name or a value out of range is an
/// error that says what would be valid; so are values that together make a curve that falls or has
/// a pole. `flip`: HDR-FLIP's defaults.
CurveValues curve_values(const Curve& curve, const std::map<std::string, double>& given, bool flip);

/// Curves of R, G and B, which only has_channels() may tell apart, as one.
kernels::CurveNumbers of_channels(const std::array<kernels::CurveNumbers, 3>& channels);

/// Six coefficients as a curve. Not finite, or a denominator that is 0 everywhere, is an error.
kernels::CurveNumbers coefficient_curve(const std::vector<double>& k);

/// The largest x >= 0 up to 2^64 with curve(x) = y for a grey; nullopt where there is none. Where
/// the curve stays at y from somewhere on, as agx does, it is the smallest of those x.
std::optional<double> inverse(const kernels::CurveNumbers& curve, double y);

} // namespace tonetool::tonemap
