// SPDX-License-Identifier: BSD-3-Clause
// Errors of single pixels, and the metrics that are made of them; include/tonetool/errors.h says
// what each is and where it comes from.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tonetool::metrics {

enum class ErrorKind { Absolute, Squared, RelativeAbsolute, RelativeSquared, Symmetric, Exposed };

enum ErrorTrait : unsigned {
    kBounded = 1,   ///< the error of a pixel is at most 1
    kDecibels = 2,  ///< the measure is in dB, and higher is better; else 0 is best
    kEps = 4,       ///< it has the option eps,
    kPeak = 8,      ///< or peak,
    kExposures = 16 ///< or those of the exposures that it is taken at
};

/// All that is known of a metric beside the kernel of its kind. Every entry point reads it here.
struct ErrorMetric {
    const char* name;
    ErrorKind kind;
    unsigned traits;
    const char* source = ""; ///< where it was published

    constexpr bool has(ErrorTrait trait) const { return (traits & trait) != 0; }

    /// The measure of a map of this mean. `peak` is 1 for metrics without it.
    double measure(double mean, double peak) const {
        return has(kDecibels) ? 10 * std::log10(peak * peak / mean) : mean;
    }
};

inline constexpr ErrorMetric kErrorMetrics[] = {
    {"smape", ErrorKind::Symmetric, kBounded | kEps,
     "Vogels et al., \"Denoising with Kernel Prediction and Asymmetric Loss Functions\", 2018"},
    {"rmae", ErrorKind::RelativeAbsolute, kEps, "as the viewer tev"},
    {"relmse", ErrorKind::RelativeSquared, kEps,
     "Rousselle, Knaus, Zwicker, \"Adaptive Sampling and Reconstruction using Greedy Error "
     "Minimization\", 2011"},
    {"mse", ErrorKind::Squared, 0},
    {"mae", ErrorKind::Absolute, 0},
    {"psnr", ErrorKind::Squared, kDecibels | kPeak},
    {"mpsnr", ErrorKind::Exposed, kBounded | kDecibels | kExposures,
     "Munkberg, Clarberg, Hasselgren, Akenine-Moller, \"High Dynamic Range Texture Compression for "
     "Graphics Hardware\", 2006"},
};

/// nullptr for any other name.
constexpr const ErrorMetric* find_error_metric(std::string_view name) {
    for (const ErrorMetric& metric : kErrorMetrics)
        if (name == metric.name)
            return &metric;
    return nullptr;
}

struct PixelError {
    ErrorKind kind = ErrorKind::Absolute;
    double eps = 0;

    /// Errors are at most 1.
    constexpr bool bounded() const {
        for (const ErrorMetric& metric : kErrorMetrics)
            if (kind == metric.kind)
                return metric.has(kBounded);
        return false;
    }
};

/// The error of `count` pixels of linear Rec.709, finite and >= 0. `stops` are the exposures of
/// ErrorKind::Exposed; the other kinds do not look at them. Where the pixels are equal it is 0.
void error_row(const PixelError& error, const std::vector<double>& stops,
               const float* const reference[3], const float* const test[3], float* out,
               int64_t count);

} // namespace tonetool::metrics
