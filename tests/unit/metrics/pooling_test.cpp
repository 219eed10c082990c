// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/pooling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "schedules.h"

namespace tonetool::metrics {
namespace {

using kernels::backwards;
using kernels::in_order;
using kernels::on_threads;
using kernels::ParallelFor;

std::vector<float> random_map(size_t n) {
    std::mt19937 random(3);
    std::vector<float> map(n);
    for (float& v : map)
        v = float(random()) * 0x1p-32f;
    return map;
}

TEST(Pool, AgreesWithBruteForce) {
    constexpr int width = 31, height = 23;
    auto map = random_map(size_t(width) * size_t(height));
    map[100] = 0.0f;
    map[200] = 1.0f;
    const FlipPool p = pool(map.data(), width, height, width, 0, 0, in_order());
    // A sum of doubles in another order.
    EXPECT_NEAR(p.mean, std::accumulate(map.begin(), map.end(), 0.0) / double(map.size()), 1e-14);
    EXPECT_EQ(p.pixels, width * height);
    EXPECT_EQ(p.min, 0.0);
    EXPECT_EQ(p.min_x, 100 % width);
    EXPECT_EQ(p.min_y, 100 / width);
    EXPECT_EQ(p.max, 1.0);
    EXPECT_EQ(p.max_x, 200 % width);
    EXPECT_EQ(p.max_y, 200 / width);
    std::array<int64_t, 100> histogram{};
    for (float v : map)
        ++histogram[std::min<size_t>(99, size_t(double(v) * 100))];
    EXPECT_EQ(p.histogram, histogram);
    std::sort(map.begin(), map.end());
    const auto rank = [&](double share) {
        return double(map[size_t(std::ceil(share * double(map.size()))) - 1]);
    };
    EXPECT_EQ(p.p50, rank(0.5));
    EXPECT_EQ(p.p95, rank(0.95));
    EXPECT_EQ(p.p99, rank(0.99));
    EXPECT_EQ(p.p999, rank(0.999));
    EXPECT_LE(p.weighted_q1, p.weighted_median);
    EXPECT_LE(p.weighted_median, p.weighted_q3);
    EXPECT_GT(p.weighted_median, p.p50) << "error mass lies above the pixels' median";
}

TEST(Pool, FindsTheFirstExtremes) {
    const std::vector<float> map = {0.5f, 0.9f, 0.1f, 0.9f, 0.1f, 0.5f};
    const FlipPool p = pool(map.data(), 3, 2, 3, -10, 20, in_order());
    EXPECT_EQ(p.max_x, -9);
    EXPECT_EQ(p.max_y, 20);
    EXPECT_EQ(p.min_x, -8);
    EXPECT_EQ(p.min_y, 20);
}

std::vector<double> figures(const FlipPool& p) {
    std::vector<double> out = {p.mean,          p.weighted_q1,   p.weighted_median,
                               p.weighted_q3,   p.p50,           p.p95,
                               p.p99,           p.p999,          p.min,
                               p.max,           double(p.min_x), double(p.min_y),
                               double(p.max_x), double(p.max_y), double(p.pixels)};
    out.insert(out.end(), p.histogram.begin(), p.histogram.end());
    return out;
}

TEST(Pool, StridedMapsGiveTheSameBits) {
    constexpr int width = 17, height = 12, stride = 29;
    const auto map = random_map(size_t(width) * size_t(height));
    std::vector<float> padded(size_t(stride) * size_t(height), 7.0f);
    for (int y = 0; y < height; ++y)
        std::copy_n(map.data() + y * width, width, padded.data() + y * stride);
    const FlipPool a = pool(map.data(), width, height, width, 0, 0, in_order());
    const FlipPool b = pool(padded.data(), width, height, stride, 0, 0, in_order());
    EXPECT_EQ(figures(a), figures(b));
}

TEST(Pool, ScheduleDoesNotChangeABit) {
    const int sizes[][2] = {{700, 301}, {1, 200000}, {200000, 1}, {1, 1}};
    for (const auto& size : sizes) {
        SCOPED_TRACE(testing::Message() << size[0] << "x" << size[1]);
        auto map = random_map(size_t(size[0]) * size_t(size[1]));
        for (size_t i = 0; i < map.size(); i += 3) // the extremes many times, in many blocks
            map[i] = i % 2 ? 1.0f : 0.0f;
        const auto of = [&](const ParallelFor& parallel) {
            return figures(pool(map.data(), size[0], size[1], size[0], 3, 4, parallel));
        };
        for (const ParallelFor& parallel : {backwards(), on_threads(2), on_threads(7)})
            EXPECT_EQ(of(parallel), of(in_order()));
    }
}

TEST(Pool, TheFirstExtremeMayLieInAnyBlock) {
    constexpr int width = 600, height = 400;
    for (int row : {0, 150, 399}) {
        std::vector<float> map(size_t(width) * size_t(height), 0.5f);
        for (int y = row; y < height; ++y) {
            map[size_t(y * width + 17)] = map[size_t(y * width + 40)] = 0.75f;
            map[size_t(y * width + 19)] = map[size_t(y * width + 41)] = 0.25f;
        }
        const FlipPool p = pool(map.data(), width, height, width, 0, 0, backwards());
        EXPECT_EQ(p.max_x, 17);
        EXPECT_EQ(p.max_y, row);
        EXPECT_EQ(p.min_x, 19);
        EXPECT_EQ(p.min_y, row);
    }
}

TEST(Pool, ConstantMaps) {
    for (float value : {0.0f, 0.25f, 1.0f}) {
        const std::vector<float> map(60, value);
        const FlipPool p = pool(map.data(), 10, 6, 10, 0, 0, in_order());
        for (double v : {p.mean, p.min, p.max, p.p50, p.p999, p.weighted_q1, p.weighted_q3})
            EXPECT_EQ(v, double(value));
        EXPECT_EQ(p.histogram[std::min<size_t>(99, size_t(value * 100))], 60);
        EXPECT_EQ(p.max_x, 0);
        EXPECT_EQ(p.max_y, 0);
    }
}

TEST(Pool, OnePixelAndNone) {
    const float one = 0.5f;
    const FlipPool p = pool(&one, 1, 1, 1, 4, 5, in_order());
    EXPECT_EQ(p.mean, 0.5);
    EXPECT_EQ(p.weighted_median, 0.5);
    EXPECT_EQ(p.max_x, 4);
    EXPECT_EQ(p.min_y, 5);
    EXPECT_EQ(p.pixels, 1);
    EXPECT_EQ(pool(nullptr, 0, 5, 0, 0, 0, in_order()).pixels, 0);
}

// Gaps are as if the pixels around them were next to each other.
TEST(Pool, GapsDoNotCount) {
    constexpr int width = 40, height = 30, left = 7, top = 3, inner = 26, rows = 20;
    auto map = random_map(size_t(width) * size_t(height));
    std::vector<float> crop;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float& value = map[size_t(y * width + x)];
            if (x >= left && x < left + inner && y >= top && y < top + rows)
                crop.push_back(value);
            else
                value = std::numeric_limits<float>::quiet_NaN();
        }
    PoolRequest of_gaps{{99.95}, {0.5}, {}, {}}, of_crop = of_gaps;
    const FlipPool a =
        pool(map.data(), width, height, width, 0, 0, on_threads(3), &of_gaps, Gaps::Nan);
    const FlipPool b = pool(crop.data(), inner, rows, inner, left, top, in_order(), &of_crop);
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.weighted_q1, b.weighted_q1);
    EXPECT_EQ(a.p95, b.p95);
    EXPECT_EQ(a.min, b.min);
    EXPECT_EQ(a.max, b.max);
    EXPECT_EQ(std::vector({a.min_x, a.min_y, a.max_x, a.max_y}),
              std::vector({b.min_x, b.min_y, b.max_x, b.max_y}));
    EXPECT_EQ(a.histogram, b.histogram);
    EXPECT_EQ(a.pixels, inner * rows);
    EXPECT_EQ(of_gaps.found_percentiles, of_crop.found_percentiles);
    EXPECT_EQ(of_gaps.found_above, of_crop.found_above);
    std::fill(map.begin(), map.end(), std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(pool(map.data(), width, height, width, 0, 0, in_order(), nullptr, Gaps::Nan).pixels,
              0);
}

// 8K worth of equal errors: a sum in float would be 9 % off.
TEST(Pool, MeanOfManyPixelsIsExact) {
    const std::vector<float> row(8192, 0.1f);
    constexpr int height = 4320;
    // Every row is the same memory: stride 0.
    const FlipPool p = pool(row.data(), 8192, height, 0, 0, 0, in_order());
    EXPECT_NEAR(p.mean, double(0.1f), 1e-15); // 12 512 additions of rounding 2^-53, averaged
    EXPECT_EQ(p.pixels, int64_t(8192) * height);
}

} // namespace
} // namespace tonetool::metrics
