// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/cell_mean.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "schedules.h"

namespace tonetool::tonemap {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

CellMean mean_of(const std::vector<float>& plane, int width,
                 const kernels::ParallelFor& parallel = kernels::in_order()) {
    return cell_mean(plane.data(), width, int(plane.size()) / width, parallel);
}

TEST(CellMean, HasAbout2300CellsAtAnyResolution) {
    for (const auto& [width, height, side] :
         {std::tuple{48, 48, 1}, {384, 384, 8}, {1920, 1080, 30}, {96, 96, 2}, {10, 10, 1}}) {
        const auto found = mean_of(std::vector<float>(size_t(width * height), 2.5f), width);
        EXPECT_EQ(found.side, side) << width;
        EXPECT_NEAR(found.mean, 2.5, 1e-12);
        EXPECT_EQ(found.cells, int64_t((width + side - 1) / side) * ((height + side - 1) / side));
    }
}

// The mean of a cell first, the logarithm after.
TEST(CellMean, HardlyFollowsTheNoiseOfPixels) {
    std::mt19937 random(1);
    std::vector<float> plane(960 * 480);
    for (size_t i = 0; i < plane.size(); ++i)
        plane[i] = random() % 4 == 0 ? 4.0f : kBlackSurface; // of mean 1
    const auto found = mean_of(plane, 960);
    EXPECT_EQ(found.side, 14);
    EXPECT_NEAR(found.mean, 1, 0.01);
}

TEST(CellMean, BlackPixelsCountInCellsThatAreLit) {
    std::vector<float> plane(9216, kNone);
    for (size_t i = 0; i < plane.size(); ++i)
        if (i % 96 < 48)
            plane[i] = i % 2 ? 2.0f : kBlackSurface;
    const auto found = mean_of(plane, 96);
    EXPECT_EQ(found.side, 1) << "half of the pixels are none";
    EXPECT_EQ(found.cells, 2304);
    EXPECT_NEAR(found.mean, 2, 1e-12);
    // The same with pixels that are perhaps background: they are no pixels of the side.
    for (float& v : plane)
        v = v == kBlackSurface ? kBlackAnywhere : v;
    EXPECT_EQ(mean_of(plane, 96).side, 1);
    std::vector<float> large(size_t(384) * 384, kBlackAnywhere);
    for (size_t i = 0; i < large.size(); i += 2)
        large[i] = 3;
    const auto half = mean_of(large, 384);
    EXPECT_EQ(half.side, 6) << "sqrt(73728) / 48 is 5.66";
    EXPECT_NEAR(half.mean, 1.5, 1e-12);
}

TEST(CellMean, OfNothingIsZero) {
    EXPECT_EQ(mean_of(std::vector<float>(100, kNone), 10).mean, 0);
    EXPECT_EQ(mean_of(std::vector<float>(100, 0.0f), 10).cells, 0);
}

TEST(CellMean, DoesNotDependOnTheSchedule) {
    std::mt19937 random(3);
    std::vector<float> plane(size_t(331) * 211);
    for (float& v : plane)
        v = std::exp2(float(random() % 4096) / 128 - 18);
    const double expected = mean_of(plane, 331).mean;
    EXPECT_EQ(mean_of(plane, 331, kernels::backwards()).mean, expected);
    EXPECT_EQ(mean_of(plane, 331, kernels::on_threads(3)).mean, expected);
}

} // namespace
} // namespace tonetool::tonemap
