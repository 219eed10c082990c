// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/data_pair.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <limits>

namespace tonetool::metrics {
namespace {

using Values = std::vector<float>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

DataPair pair_of(PairKind kind, const Values& a, const Values& b, size_t channels,
                 const float* depth = nullptr) {
    DataPair sum;
    sum.add(scan_pair(kind, a, b, channels, depth, 7));
    return sum;
}

float id_of(uint32_t bits) {
    float id = 0;
    std::memcpy(&id, &bits, sizeof id);
    return id;
}

TEST(DataPair, DepthsByATenthOfAPercent) {
    const Values a = {10, 10, 10, 1e9f, 1e10f, kInf, 5};
    const Values b = {10.009f, 10.011f, 9.98f, 2e9f, kInf, kNan, 1e9f};
    const DataPair pair = pair_of(PairKind::Depth, a, b, 1);
    EXPECT_EQ(pair.pixels, 7);
    EXPECT_EQ(pair.off, 3); // the second, the third, and where only one has background
    EXPECT_EQ(pair.x, 6);
    EXPECT_EQ(pair.y, 7);
    EXPECT_EQ(pair_of(PairKind::Depth, {kNan}, {3}, 1).off, 1);
    EXPECT_EQ(pair_of(PairKind::Depth, {3}, {kNan}, 1).off, 1);
    EXPECT_EQ(pair_of(PairKind::Depth, {0}, {0}, 1).off, 0);
}

TEST(DataPair, PositionsByTheirDepth) {
    const Values a = {100, 0, 0, 100, 0, 0, 100, 0, 0}, b = {100, 0.05f, 0, 100, 0, 0.05f, 9, 9, 9};
    const Values depth = {10, 100, kInf}; // where nothing is, positions do not matter
    EXPECT_EQ(pair_of(PairKind::Position, a, b, 3, depth.data()).off, 1);
    // By their largest component, 100.
    EXPECT_EQ(pair_of(PairKind::Position, a, b, 3).off, 1);
    const Values far = {1e10f, 0, 0, 1e10f, 0, 0}, near = {2e10f, 5, 5, 1, 1, 1};
    EXPECT_EQ(pair_of(PairKind::Position, far, near, 3).off, 1);
}

TEST(DataPair, NormalsByTheirAngle) {
    const float s = float(std::sin(0.2)), c = float(std::cos(0.2)); // 11.46 degrees
    const Values a = {0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0, 1, 0, 0, 0.4f, 0, kInf, 0, 0, 0, kNan};
    const Values b = {0, 0, 3, 0, s, c, 0, 0, -1, 0, 0, 0, 0, 0.2f, 0, 1, 0, 0, 0, 0, 1};
    const DataPair pair = pair_of(PairKind::Normal, a, b, 3);
    EXPECT_EQ(pair.both, 3); // of any length
    EXPECT_EQ(pair.off, 2);
    EXPECT_EQ(pair.one, 3); // also where one is not finite
    EXPECT_NEAR(pair.steps.quantile(0.5), 11.46, 0.1);
    EXPECT_NEAR(pair.most, 180, 1e-6);
    EXPECT_EQ(pair.x, 2);
}

TEST(DataPair, MotionByItsDistance) {
    const Values a = {0, 0, 1, 1, 0, 0, 2, 0}, b = {3, 4, 1, 1, 0.3f, 0.3f, 2, 0.6f};
    const DataPair pair = pair_of(PairKind::Motion, a, b, 2);
    EXPECT_EQ(pair.off, 2);
    EXPECT_EQ(pair.most, 5);
    EXPECT_NEAR(pair.steps.quantile(0.5), 0.42, 0.01);
    // Of a forward and a backward motion the larger difference.
    EXPECT_EQ(pair_of(PairKind::Motion, {0, 0, 0, 0}, {0.1f, 0, 0, 0.7f}, 4).off, 1);
    EXPECT_EQ(pair_of(PairKind::Motion, {0, 0, 0}, {0.1f, 0, 0.7f}, 3).off, 1);
}

TEST(DataPair, MotionThatIsNotFinite) {
    const Values bad = {kNan, 0, 0, kInf, kNan, kNan}, good = {1, 0, 0, 1, 1, 1};
    const DataPair pair = pair_of(PairKind::Motion, bad, good, 2);
    EXPECT_EQ(pair.off, 3);
    EXPECT_TRUE(std::isfinite(pair.steps.quantile(0.5)));
    EXPECT_GT(pair.steps.quantile(0.5), 1e8);
    EXPECT_TRUE(std::isfinite(pair.most));
    EXPECT_EQ(pair_of(PairKind::Motion, bad, bad, 2).off, 0);
    // The other channel counts where both are NaN.
    EXPECT_EQ(pair_of(PairKind::Motion, {kNan, 0}, {-kNan, 0.7f}, 2).off, 1);
    EXPECT_EQ(pair_of(PairKind::Motion, {kNan, 0}, {-kNan, 0}, 2).off, 0);
}

TEST(DataPair, IdsByTheirCoverage) {
    const float a = id_of(0x7fc01234), b = id_of(0x3e000001), c = id_of(0x80000000), zero = 0;
    const auto mismatch = [](const Values& before, const Values& after) {
        return pair_of(PairKind::Ids, before, after, before.size()).sum;
    };
    EXPECT_EQ(mismatch({a, 1, zero, 0}, {a, 1, zero, 0}), 0);
    EXPECT_EQ(mismatch({a, 1, zero, 0}, {b, 1, zero, 0}), 1);
    EXPECT_EQ(mismatch({a, 0.75f, b, 0.25f}, {b, 0.25f, a, 0.75f}), 0);
    EXPECT_EQ(mismatch({a, 0.75f, b, 0.25f}, {a, 0.5f, b, 0.5f}), 0.25);
    EXPECT_EQ(mismatch({a, 0.75f, b, 0.25f}, {a, 0.75f, c, 0.25f}), 0.25);
    EXPECT_EQ(mismatch({c, 1, zero, 0}, {zero, 1, zero, 0}), 1); // -0 is another id than 0
    EXPECT_EQ(mismatch({a, 1, zero, 0}, {zero, 0, zero, 0}), 0.5);
    EXPECT_EQ(mismatch({a, 0.5f, a, 0.5f}, {a, 1, zero, 0}), 0); // twice the same id
    EXPECT_EQ(mismatch({a, kNan, zero, 0}, {a, 1, zero, 0}), 1);
    // One id a pixel, without a coverage.
    EXPECT_EQ(mismatch({a}, {a}), 0);
    EXPECT_EQ(mismatch({a}, {id_of(0x7fc01235)}), 1);
}

TEST(DataPair, AlphaAndUnknownValues) {
    const DataPair alpha = pair_of(PairKind::Alpha, {1, 1, 0.5f, kNan}, {1, 0.97f, 0.51f, 1}, 1);
    EXPECT_EQ(alpha.off, 2);
    EXPECT_NEAR(alpha.sum, 0.03 + 0.01 + 1, 1e-6);
    const DataPair data = pair_of(PairKind::Data, {1, 2, kNan, 0, 3, 3}, {1, 2, kNan, 0, 3, 4}, 2);
    EXPECT_EQ(data.off, 1);
    EXPECT_EQ(data.share(data.off), 1 / 3.0);
    EXPECT_EQ(DataPair().share(0), 0);
}

TEST(DataPair, RowsAddUp) {
    DataPair sum;
    for (int64_t y = 0; y < 3; ++y)
        sum.add(scan_pair(PairKind::Depth, {10, 10}, {10, 10 + float(y)}, 1, nullptr, y));
    EXPECT_EQ(sum.pixels, 6);
    EXPECT_EQ(sum.off, 2);
    EXPECT_EQ(sum.y, 2);
    EXPECT_EQ(sum.x, 1);
    EXPECT_NEAR(sum.most, 0.2, 1e-9);
}

} // namespace
} // namespace tonetool::metrics
