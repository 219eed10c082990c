// Which exposures HDR-FLIP looks at (Eurographics 2021, section 4).
#pragma once

#include <array>
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

struct ExposureRequest {
    std::optional<double> start, stop;
    std::optional<int> count;
    double max_luminance = 0, median_luminance = 0; ///< used where start or stop is not given
};

/// The exposures in stops, ascending. Eq. 2 and 3: start = log2(x / max), stop = log2(x / median),
/// N = max(2, ceil(stop - start)). One exposure means the start. On failure `error` says which
/// number is out of range and what would be valid.
bool make_exposures(const std::array<double, 6>& curve, const ExposureRequest& request,
                    std::vector<double>& stops, std::string& error);

} // namespace tonetool::flip
