#include "metrics/pooling.h"

#include <algorithm>

#include "metrics/order_statistics.h"

namespace tonetool::metrics {
namespace {

// Mean, extremes and histogram in one pass; a sum per row, then over rows, both in order.
void scan(FlipPool& pool, const float* map, int width, int height, ptrdiff_t stride) {
    const double buckets = double(pool.histogram.size());
    double sum = 0;
    pool.min = pool.max = map[0];
    for (int y = 0; y < height; ++y) {
        double row = 0;
        for (int x = 0; x < width; ++x) {
            const double value = map[y * stride + x];
            row += value;
            const auto bucket = std::clamp(value * buckets, 0.0, buckets - 1.0);
            ++pool.histogram[size_t(bucket)];
            if (value < pool.min) {
                pool.min = value;
                pool.min_x = x;
                pool.min_y = y;
            }
            if (value > pool.max) {
                pool.max = value;
                pool.max_x = x;
                pool.max_y = y;
            }
        }
        sum += row;
    }
    pool.pixels = int64_t(width) * height;
    pool.mean = sum / double(pool.pixels);
}

} // namespace

FlipPool pool(const float* map, int width, int height, ptrdiff_t stride, int x0, int y0) {
    FlipPool out;
    if (width <= 0 || height <= 0)
        return out;
    scan(out, map, width, height, stride);
    out.min_x += x0;
    out.max_x += x0;
    out.min_y += y0;
    out.max_y += y0;
    const OrderStatistics order(map, width, height, stride);
    out.p50 = order.percentile(0.50);
    out.p95 = order.percentile(0.95);
    out.p99 = order.percentile(0.99);
    out.p999 = order.percentile(0.999);
    out.weighted_q1 = order.weighted_percentile(0.25);
    out.weighted_median = order.weighted_percentile(0.50);
    out.weighted_q3 = order.weighted_percentile(0.75);
    return out;
}

} // namespace tonetool::metrics
