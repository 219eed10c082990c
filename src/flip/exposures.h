// SPDX-License-Identifier: BSD-3-Clause
// The exposures that HDR-FLIP compares at (Eurographics 2021, section 4).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tonetool::flip {

/// The display value of the exposure anchor, which is the scene value of a grey that the curve
/// shows at this value: both ends of the range bring a luminance to the anchor.
inline constexpr double kAnchorValue = 0.85;

inline constexpr int kMaxExposures = 1024;
/// The stops whose power of two is a normal float.
inline constexpr double kMinStops = -126.0, kMaxStops = 127.0;

/// The largest x with curve(x) = kAnchorValue, for the six coefficients of Eq. 1; nullopt if the
/// curve never gets there at a positive x.
std::optional<double> exposure_anchor(const std::array<double, 6>& k);

/// The display values of greys with these scene values.
using GreyResponse = std::function<std::vector<double>(const std::vector<double>&)>;

/// The same for any continuous curve, solved numerically between 2^-64 and 2^64. Two solutions
/// less than 1/32 stop apart may be missed.
std::optional<double> exposure_anchor(const GreyResponse& response);

struct ExposureRequest {
    std::optional<double> start, stop;
    std::optional<int> count;
    double max_luminance = 0, median_luminance = 0; ///< used where start or stop is not given
};

/// The exposures in stops, ascending. Eq. 2 and 3: start = log2(x / max), stop = log2(x / median),
/// N = max(2, ceil(stop - start)). `bright` is x, the exposure anchor of the curve, if it has one.
/// One exposure means the start. A number that is out of range is a std::invalid_argument that says
/// what would be valid.
std::vector<double> make_exposures(std::optional<double> bright, const ExposureRequest& request);

} // namespace tonetool::flip
