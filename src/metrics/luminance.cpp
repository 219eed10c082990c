// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/luminance.h"

#include <cmath>

#include "kernels/tone_curve.h"
#include "metrics/blocks.h"
#include "metrics/order_statistics.h"

namespace tonetool::metrics {
namespace {

using kernels::kLuminance;
using kernels::ParallelFor;

struct Sums {
    double values = 0, logs = 0;
    int64_t lit = 0;
};

Sums sums_of(const float* row, int width) {
    Sums sums;
    for (int x = 0; x < width; ++x) {
        if (!std::isfinite(row[x]))
            continue;
        sums.values += double(row[x]);
        if (row[x] > 0) {
            sums.logs += std::log(double(row[x]));
            ++sums.lit;
        }
    }
    return sums;
}

// Mean and geometric mean: sums of rows, added in their order.
void averages(const float* plane, int width, int height, int64_t count, const ParallelFor& parallel,
              LuminanceStats& stats) {
    std::vector<Sums> rows(size_t(std::max(height, 0)));
    for_each_block(width, height, parallel, [&](int first, int end) {
        for (int y = first; y < end; ++y)
            rows[size_t(y)] = sums_of(plane + int64_t(y) * width, width);
    });
    Sums all;
    for (const Sums& row : rows) {
        all.values += row.values;
        all.logs += row.logs;
        all.lit += row.lit;
    }
    stats.mean = count ? all.values / double(count) : 0;
    stats.log_average = all.lit ? std::exp(all.logs / double(all.lit)) : 0;
}

// The maximum, the upper median, and the upper median of the non-black pixels.
std::vector<Wanted> for_exposures(const OrderStatistics& order) {
    const int64_t n = order.count(), black = order.zeros();
    return {Wanted::rank(n - 1), Wanted::rank(n / 2), Wanted::rank(black + (n - black) / 2)};
}

} // namespace

void luminance_row(const float* r, const float* g, const float* b, float* out, int64_t count) {
    for (int64_t i = 0; i < count; ++i)
        out[i] =
            float(kLuminance[0]) * r[i] + float(kLuminance[1]) * g[i] + float(kLuminance[2]) * b[i];
}

ExposureStats exposure_statistics(const float* plane, int width, int height,
                                  const ParallelFor& parallel) {
    const OrderStatistics order(plane, width, height, width, parallel);
    const auto found = order.find(for_exposures(order));
    return {order.count(), order.zeros(), found[0], found[1], found[2]};
}

LuminanceStats luminance(const float* plane, int width, int height, const ParallelFor& parallel) {
    const OrderStatistics order(plane, width, height, width, parallel);
    auto wanted = for_exposures(order);
    wanted.insert(wanted.end(), {Wanted::rank(0), Wanted::percentile(0.01),
                                 Wanted::percentile(0.99), Wanted::percentile(0.999)});
    const auto found = order.find(wanted);
    LuminanceStats stats;
    stats.black = order.zeros();
    stats.max = found[0];
    stats.median = found[1];
    stats.median_lit = found[2];
    stats.min = found[3];
    stats.p1 = found[4];
    stats.p99 = found[5];
    stats.p999 = found[6];
    averages(plane, width, height, order.count(), parallel, stats);
    return stats;
}

} // namespace tonetool::metrics
