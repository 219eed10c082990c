#include "flip/exposures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tonetool::flip {
namespace {

std::string text(const char* format, double a, double b = 0) {
    char buffer[320];
    std::snprintf(buffer, sizeof buffer, format, a, b);
    return buffer;
}

bool in_range(double stops, const char* name, std::string& error) {
    if (std::isfinite(stops) && stops >= kMinStops && stops <= kMaxStops)
        return true;
    error = std::string(name) + text(" exposure is %g stops", stops) +
            text(": must be finite and between %g and %g; pass ", kMinStops, kMaxStops) + name +
            "Exposure";
    return false;
}

// The exposure that brings a luminance to the exposure anchor.
bool measure(std::optional<double> bright, double luminance, const char* name, double& stops,
             std::string& error) {
    if (!bright) {
        error = text("what the image is shown through never reaches %g, so there is no automatic "
                     "exposure: pass "
                     "startExposure and stopExposure",
                     kAnchorValue);
        return false;
    }
    if (!(std::isfinite(luminance) && luminance > 0)) {
        error = std::string(name) +
                text(" exposure cannot be measured: the luminance is %g, must "
                     "be positive and finite; pass ",
                     luminance) +
                name + "Exposure";
        return false;
    }
    stops = std::log2(*bright / luminance);
    return true;
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

bool make_exposures(std::optional<double> bright, const ExposureRequest& request,
                    std::vector<double>& stops, std::string& error) {
    double start = request.start.value_or(0), stop = request.stop.value_or(0);
    const bool single = request.count == 1;
    if (!request.start && !measure(bright, request.max_luminance, "start", start, error))
        return false;
    if (single && !request.stop)
        stop = start;
    else if (!request.stop && !measure(bright, request.median_luminance, "stop", stop, error))
        return false;
    if (!in_range(start, "start", error) || !in_range(stop, "stop", error))
        return false;
    if (start > stop) {
        error = text("start exposure %g is above stop exposure %g", start, stop) +
                ": must not be larger";
        return false;
    }
    const int count = request.count.value_or(std::max(2, int(std::ceil(stop - start))));
    if (count < 1 || count > kMaxExposures) {
        error = text("number of exposures is %g: must be 1 to %g", count, kMaxExposures);
        return false;
    }
    stops.clear();
    for (int i = 0; i < count; ++i)
        stops.push_back(count == 1 ? start : start + i * (stop - start) / (count - 1));
    return true;
}

} // namespace tonetool::flip
