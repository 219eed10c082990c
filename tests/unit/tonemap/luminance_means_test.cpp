// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/luminance_means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "schedules.h"
#include "target.h"

namespace tonetool::tonemap {
namespace {

constexpr double kEpsilon = 1e-6;
// Logarithms and reciprocals of float lanes.
constexpr double kClose = 4e-7;

LuminanceMeans means_of(const std::vector<float>& plane, int width,
                        const kernels::ParallelFor& parallel = kernels::in_order()) {
    return luminance_means(plane.data(), width, int(plane.size()) / width, kEpsilon, parallel);
}

std::vector<float> wide_range(size_t count) {
    std::mt19937 random(3);
    std::vector<float> plane(count);
    for (float& v : plane)
        v = std::exp2(float(random() % 4096) / 128 - 18);
    plane[1] = 0;
    return plane;
}

LuminanceMeans exactly(const std::vector<float>& plane) {
    LuminanceMeans out;
    double logs = 0, reciprocals = 0;
    for (float v : plane)
        if (v >= 0 && std::isfinite(v)) {
            ++out.counted;
            out.max = std::max(out.max, double(v));
            out.arithmetic += double(v);
            logs += std::log(double(v) + kEpsilon);
            reciprocals += 1 / (double(v) + kEpsilon);
        }
    const auto n = double(out.counted);
    out.arithmetic /= n;
    out.geometric = std::exp(logs / n);
    out.harmonic = n / reciprocals;
    return out;
}

TEST(LuminanceMeans, AreThoseOfDoublePrecisionOnEveryTarget) {
    auto plane = wide_range(37 * 29);
    plane[5] = std::numeric_limits<float>::quiet_NaN();
    plane[6] = INFINITY;
    plane[7] = -1;
    const LuminanceMeans expected = exactly(plane);
    EXPECT_EQ(expected.counted, 37 * 29 - 3);
    kernels::on_every_target([&] {
        const LuminanceMeans found = means_of(plane, 37);
        EXPECT_EQ(found.counted, expected.counted);
        EXPECT_EQ(found.max, expected.max);
        EXPECT_NEAR(found.arithmetic / expected.arithmetic, 1, 1e-12);
        EXPECT_NEAR(found.geometric / expected.geometric, 1, kClose);
        EXPECT_NEAR(found.harmonic / expected.harmonic, 1, kClose);
    });
}

TEST(LuminanceMeans, OfAConstantAreTheConstant) {
    for (float v : {1e-4f, 0.18f, 1.0f, 333.0f, 1e30f}) {
        const LuminanceMeans found = means_of(std::vector<float>(100 * 80, v), 100);
        const double raised = double(v) + kEpsilon;
        EXPECT_NEAR(found.arithmetic / double(v), 1, 1e-12) << v;
        // The last place of the logarithm as a float.
        const double place = 6e-8 * std::abs(std::log(raised));
        EXPECT_NEAR(found.geometric / raised, 1, kClose + place) << v;
        EXPECT_NEAR(found.harmonic / raised, 1, kClose) << v;
    }
}

TEST(LuminanceMeans, OfTheLargestFloats) {
    constexpr float largest = std::numeric_limits<float>::max();
    const LuminanceMeans found = means_of(std::vector<float>(64 * 64, largest), 64);
    EXPECT_NEAR(found.arithmetic / double(largest), 1, 1e-6);
    EXPECT_NEAR(found.geometric / double(largest), 1, 1e-5);
}

TEST(LuminanceMeans, OfNothingAreZero) {
    const LuminanceMeans found = means_of({NAN, -1, INFINITY}, 3);
    EXPECT_EQ(found.counted, 0);
    EXPECT_EQ(found.max, 0);
    EXPECT_EQ(found.geometric, 0);
}

TEST(LuminanceMeans, DoNotDependOnTheSchedule) {
    const auto plane = wide_range(300 * 211);
    const LuminanceMeans expected = means_of(plane, 300);
    for (const auto& parallel : {kernels::backwards(), kernels::on_threads(3)}) {
        const LuminanceMeans found = means_of(plane, 300, parallel);
        EXPECT_EQ(found.geometric, expected.geometric);
        EXPECT_EQ(found.arithmetic, expected.arithmetic);
        EXPECT_EQ(found.harmonic, expected.harmonic);
    }
}

} // namespace
} // namespace tonetool::tonemap
