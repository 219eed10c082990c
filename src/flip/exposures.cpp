// SPDX-License-Identifier: BSD-3-Clause
#include "flip/exposures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace tonetool::flip {
namespace {

std::string text(const char* format, double a, double b = 0) {
    char buffer[320];
    std::snprintf(buffer, sizeof buffer, format, a, b);
    return buffer;
}

void check_range(double stops, const char* name) {
    if (!(std::isfinite(stops) && stops >= kMinStops && stops <= kMaxStops))
        throw std::invalid_argument(
            std::string(name) + text(" exposure is %g stops", stops) +
            text(": must be finite and between %g and %g; pass ", kMinStops, kMaxStops) + name +
            "Exposure");
}

// One end of the range from a luminance.
double measured(std::optional<double> bright, double luminance, const char* name) {
    if (!bright)
        throw std::invalid_argument(
            text("what the image is shown through never reaches %g, so there is no automatic "
                 "exposure: pass "
                 "startExposure and stopExposure",
                 kAnchorValue));
    if (!(std::isfinite(luminance) && luminance > 0))
        throw std::invalid_argument(std::string(name) +
                                    text(" exposure cannot be measured: the luminance is %g, must "
                                         "be positive and finite; pass ",
                                         luminance) +
                                    name + "Exposure");
    return std::log2(*bright / luminance);
}

} // namespace

std::optional<double> exposure_anchor(const std::array<double, 6>& k) {
    const double a = k[0] - kAnchorValue * k[3], b = k[1] - kAnchorValue * k[4],
                 c = k[2] - kAnchorValue * k[5];
    double x = 0;
    if (a == 0) {
        x = -c / b;
    } else {
        const double half = b / (2.0 * a);
        x = -half + std::sqrt(half * half - c / a);
    }
    if (!(std::isfinite(x) && x > 0))
        return std::nullopt;
    return x;
}

std::optional<double> exposure_anchor(const GreyResponse& response) {
    constexpr double first = -64, last = 64;
    constexpr int steps_per_stop = 32;
    double low = first, high = last;
    int steps = int(last - first) * steps_per_stop;
    // The uppermost step between two values on both sides of kAnchorValue, in ever finer steps.
    for (constexpr int finer = 64; (high - low) / steps > 1e-14; steps = finer) {
        std::vector<double> values;
        for (int i = 0; i <= steps; ++i)
            values.push_back(std::exp2(low + (high - low) * i / steps));
        const std::vector<double> shown = response(values);
        int i = steps - 1;
        while (i >= 0 &&
               (shown[size_t(i)] >= kAnchorValue) == (shown[size_t(i + 1)] >= kAnchorValue))
            --i;
        if (i < 0)
            return std::nullopt;
        const double step = (high - low) / steps;
        high = low + step * (i + 1);
        low += step * i;
    }
    return std::exp2(0.5 * (low + high));
}

std::vector<double> make_exposures(std::optional<double> bright, const ExposureRequest& request) {
    double start = request.start.value_or(0), stop = request.stop.value_or(0);
    const bool single = request.count == 1;
    if (!request.start)
        start = measured(bright, request.max_luminance, "start");
    if (single && !request.stop)
        stop = start;
    else if (!request.stop)
        stop = measured(bright, request.median_luminance, "stop");
    check_range(start, "start");
    check_range(stop, "stop");
    if (start > stop)
        throw std::invalid_argument(
            text("start exposure %g is above stop exposure %g", start, stop) +
            ": must not be larger");
    const int count = request.count.value_or(std::max(2, int(std::ceil(stop - start))));
    if (count < 1 || count > kMaxExposures)
        throw std::invalid_argument(
            text("number of exposures is %g: must be 1 to %g", count, kMaxExposures));
    std::vector<double> stops;
    for (int i = 0; i < count; ++i)
        stops.push_back(count == 1 ? start : start + i * (stop - start) / (count - 1));
    return stops;
}

} // namespace tonetool::flip
