// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tonetool::metrics {
namespace {

// The mean of `of(reference, test)` over the components of each pixel, as a finite float.
template <class Of>
void mean_of_components(const float* const r[3], const float* const t[3], float* out, int64_t count,
                        const Of& of) {
    constexpr double largest = std::numeric_limits<float>::max();
    for (int64_t i = 0; i < count; ++i) {
        const double sum = of(double(r[0][i]), double(t[0][i])) +
                           of(double(r[1][i]), double(t[1][i])) +
                           of(double(r[2][i]), double(t[2][i]));
        out[i] = float(std::min(sum / 3, largest));
    }
}

constexpr double kGamma = 2.2, kWhite = 255;

// 2^(c / gamma) turns a photograph at 0 stops into one at c, before it is clamped.
std::vector<double> gains_of(const std::vector<double>& stops) {
    std::vector<double> gains;
    for (double c : stops)
        gains.push_back(kWhite * std::exp2(c / kGamma));
    return gains;
}

double photographed(double gain, double value) {
    return std::round(std::min(gain * value, kWhite));
}

double squared_over_exposures(const std::vector<double>& gains, double r, double t) {
    if (r == t)
        return 0;
    const double at_r = std::pow(r, 1 / kGamma), at_t = std::pow(t, 1 / kGamma);
    double sum = 0;
    for (double gain : gains) {
        const double d = photographed(gain, at_t) - photographed(gain, at_r);
        sum += d * d;
    }
    return sum / (kWhite * kWhite * double(gains.size()));
}

} // namespace

void error_row(const PixelError& error, const std::vector<double>& stops,
               const float* const reference[3], const float* const test[3], float* out,
               int64_t count) {
    const double eps = error.eps;
    const auto mean = [&](const auto& of) { mean_of_components(reference, test, out, count, of); };
    switch (error.kind) {
    case ErrorKind::Absolute:
        mean([](double r, double t) { return std::abs(t - r); });
        break;
    case ErrorKind::Squared:
        mean([](double r, double t) { return (t - r) * (t - r); });
        break;
    case ErrorKind::RelativeAbsolute:
        mean([eps](double r, double t) { return std::abs(t - r) / (r + eps); });
        break;
    case ErrorKind::RelativeSquared:
        mean([eps](double r, double t) { return (t - r) * (t - r) / (r * r + eps); });
        break;
    case ErrorKind::Symmetric:
        mean([eps](double r, double t) { return std::abs(t - r) / (r + t + eps); });
        break;
    case ErrorKind::Exposed:
        mean([gains = gains_of(stops)](double r, double t) {
            return squared_over_exposures(gains, r, t);
        });
        break;
    }
}

} // namespace tonetool::metrics
