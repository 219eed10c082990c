#include "metrics/luminance.h"

#include <cmath>
#include <limits>

#include "kernels/tone_curve.h"
#include "metrics/order_statistics.h"

namespace tonetool::metrics {
namespace {

using kernels::ConstRgb;
using kernels::kLuminance;

// Luminance of every pixel, NaN where it is to be skipped.
std::vector<float> luminance_plane(const ConstRgb& image, const std::vector<uint8_t>& skip) {
    std::vector<float> out(size_t(image.width) * size_t(image.height));
    size_t at = 0;
    for (int y = 0; y < image.height; ++y) {
        const float* r = image.plane[0] + y * image.stride;
        const float* g = image.plane[1] + y * image.stride;
        const float* b = image.plane[2] + y * image.stride;
        luminance_row(r, g, b, out.data() + at, image.width);
        at += size_t(image.width);
    }
    for (size_t i = 0; i < skip.size(); ++i)
        if (skip[i])
            out[i] = std::numeric_limits<float>::quiet_NaN();
    return out;
}

// Mean and geometric mean, row by row in order.
void averages(const float* plane, int width, int height, int64_t count, LuminanceStats& stats) {
    double sum = 0, logs = 0;
    int64_t lit = 0;
    const size_t size = size_t(width) * size_t(height);
    for (size_t row = 0; row < size; row += size_t(width)) {
        double row_sum = 0, row_logs = 0;
        for (size_t i = row; i < row + size_t(width); ++i) {
            if (!std::isfinite(plane[i]))
                continue;
            row_sum += double(plane[i]);
            if (plane[i] > 0) {
                row_logs += std::log(double(plane[i]));
                ++lit;
            }
        }
        sum += row_sum;
        logs += row_logs;
    }
    stats.mean = count ? sum / double(count) : 0;
    stats.log_average = lit ? std::exp(logs / double(lit)) : 0;
}

} // namespace

void luminance_row(const float* r, const float* g, const float* b, float* out, int64_t n) {
    for (int64_t x = 0; x < n; ++x)
        out[x] =
            float(kLuminance[0]) * r[x] + float(kLuminance[1]) * g[x] + float(kLuminance[2]) * b[x];
}

LuminanceStats luminance(const ConstRgb& image, const std::vector<uint8_t>& skip) {
    if (image.width <= 0 || image.height <= 0)
        return {};
    const auto plane = luminance_plane(image, skip);
    return luminance(plane.data(), image.width, image.height, {});
}

LuminanceStats luminance(const float* plane, int width, int height, const kernels::ParallelFor&) {
    LuminanceStats stats;
    const OrderStatistics order(plane, width, height, width);
    const int64_t n = order.count(), black = order.zeros();
    stats.black = black;
    stats.min = order.at_rank(0);
    stats.max = order.at_rank(n - 1);
    stats.median = order.at_rank(n / 2);
    stats.median_lit = black < n ? order.at_rank(black + (n - black) / 2) : 0;
    stats.p1 = order.percentile(0.01);
    stats.p99 = order.percentile(0.99);
    stats.p999 = order.percentile(0.999);
    averages(plane, width, height, n, stats);
    return stats;
}

} // namespace tonetool::metrics
