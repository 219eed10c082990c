// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/noise_floor.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "metrics/distributions.h"
#include "metrics/refusal.h"

namespace tonetool::metrics {
namespace {

constexpr size_t kFewest = 4;
constexpr double kOutlier = 4; // standard deviations of the others

void check(const std::vector<double>& values, const NoiseFloorOptions& options) {
    const auto part = [](const char* name, double value) {
        if (!(value > 0 && value < 1))
            throw Refusal(std::string(name) + " is " + std::to_string(value) +
                          ", must be above 0 and below 1");
    };
    part("content", options.content);
    part("confidence", options.confidence);
    for (double value : values)
        if (!std::isfinite(value))
            throw Refusal("a value is not finite");
}

struct Spread {
    double mean = 0, sd = 0;
};

Spread spread_of(const std::vector<double>& values) {
    const auto n = double(values.size());
    Spread out;
    for (double value : values)
        out.mean += value;
    out.mean /= n;
    double squares = 0;
    for (double value : values)
        squares += (value - out.mean) * (value - out.mean);
    out.sd = std::sqrt(squares / (n - 1));
    return out;
}

// The smallest r of which P(at most r - 1 of n values lie below the quantile `content`) reaches
// `confidence`.
int64_t smallest_rank(int64_t n, const NoiseFloorOptions& options) {
    int64_t rank = n;
    while (rank > 1 && binomial_at_most(rank - 2, n, options.content) >= options.confidence)
        --rank;
    return rank;
}

std::vector<double> logarithms(std::vector<double> values) {
    for (double& value : values)
        value = std::log(value);
    return values;
}

// A seed with a firefly, or one that is not of the approved version. `scaled` as the method sees
// the values.
std::optional<size_t> find_outlier(const std::vector<double>& scaled) {
    if (scaled.size() < kFewest)
        return {};
    const auto largest = std::max_element(scaled.begin(), scaled.end());
    const auto at = size_t(largest - scaled.begin());
    std::vector<double> others = scaled;
    others.erase(others.begin() + ptrdiff_t(at));
    const Spread spread = spread_of(others);
    if (*largest > spread.mean + kOutlier * spread.sd)
        return at;
    return {};
}

void refuse_unreachable(const NoiseFloor& floor, const NoiseFloorOptions& options) {
    if (options.below_one && floor.limit >= 1)
        throw Refusal("the limit would be " + std::to_string(floor.limit) +
                      ", which this quantity never exceeds; take another one (the mean or p99), "
                      "more renders, or less content");
}

} // namespace

NoiseFloor noise_floor(const std::vector<double>& values, const NoiseFloorOptions& options) {
    check(values, options);
    NoiseFloor out;
    out.values = int64_t(values.size());
    out.needed = int64_t(std::ceil(std::log(1 - options.confidence) / std::log(options.content)));
    if (values.size() < kFewest && out.values < out.needed)
        throw Refusal("a limit needs the values of at least 4 renders, there are " +
                      std::to_string(values.size()));
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const bool positive = sorted.front() > 0;
    const std::vector<double> scaled = positive ? logarithms(values) : values;
    out.outlier = find_outlier(scaled);
    if (out.values >= out.needed) {
        out.method = NoiseFloorMethod::OrderStatistic;
        out.rank = smallest_rank(out.values, options);
        out.limit = sorted[size_t(out.rank) - 1];
    } else {
        out.method = positive ? NoiseFloorMethod::Lognormal : NoiseFloorMethod::Normal;
        out.k = tolerance_factor(out.values, options.content, options.confidence);
        const Spread spread = spread_of(scaled);
        const double limit = spread.mean + out.k * spread.sd;
        out.limit = positive ? std::exp(limit) : limit;
    }
    refuse_unreachable(out, options);
    return out;
}

} // namespace tonetool::metrics
