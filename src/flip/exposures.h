// Which exposures HDR-FLIP looks at (Eurographics 2021, section 4).
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tonetool::flip {

/// A display value that counts as bright: both ends of the range bring a luminance there.
inline constexpr double kBright = 0.85;

inline constexpr int kMaxExposures = 1024;
/// Exposures a float can be multiplied by.
inline constexpr double kMinStops = -126.0, kMaxStops = 127.0;

/// The largest x with curve(x) = kBright, for the six coefficients of Eq. 1; nullopt if the curve
/// never gets there at a positive x.
std::optional<double> bright_point(const std::array<double, 6>& k);

/// Display values of greys of these scene values.
using GreyResponse = std::function<std::vector<double>(const std::vector<double>&)>;

/// The same for any continuous curve, solved numerically between 2^-64 and 2^64. Two solutions
/// less than 1/32 stop apart may be missed.
std::optional<double> bright_point(const GreyResponse& response);

struct ExposureRequest {
    std::optional<double> start, stop;
    std::optional<int> count;
    double max_luminance = 0, median_luminance = 0; ///< used where start or stop is not given
};

/// The exposures in stops, ascending. Eq. 2 and 3: start = log2(x / max), stop = log2(x / median),
/// N = max(2, ceil(stop - start)). `bright` is x, the bright point of the curve, if it has one. One
/// exposure means the start. A number that is out of range is a Refusal that says what would be
/// valid.
std::vector<double> make_exposures(std::optional<double> bright, const ExposureRequest& request);

} // namespace tonetool::flip
