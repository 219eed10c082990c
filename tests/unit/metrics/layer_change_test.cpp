// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/layer_change.h"

#include <gmock/gmock.h>
#include <limits>

namespace tonetool::metrics {
namespace {

using testing::ElementsAre;
using Values = std::vector<float>;

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

LayerChange change(PairKind kind, size_t channels, const Values& a, const Values& b,
                   const Surfaces& surfaces = Surfaces()) {
    return layer_change(kind, {{&a, &b}, channels}, surfaces);
}

Surfaces surfaces(const Values& a, const Values& b) {
    return surfaces_of({{&a, &b}, 1});
}

TEST(LayerChange, DepthsByAHundredth) {
    const Values a = {10, 10, 10, 1e10f, 5, 1e10f}, b = {10.09f, 10.2f, 9.8f, 2e10f, 1e9f, 7};
    const LayerChange found = change(PairKind::Depth, 1, a, b, surfaces(a, b));
    EXPECT_THAT(found.changed, ElementsAre(0, 1, 1, 0, 1, 1));
    EXPECT_EQ(found.background_changed, 2);
    EXPECT_NEAR(found.max, 0.02, 1e-6);
    EXPECT_NEAR(found.mean, (0.009 + 0.02 + 0.02) / 3, 1e-6); // where both have a surface
}

TEST(LayerChange, PositionsByTheDiagonalOfWhatBothShow) {
    const Values depth = {1, 1, 1, 1e10f};
    // A diagonal of 100; what the background holds does not count.
    const Values a = {0, 0, 0, 60, 80, 0, 0, 0, 0, 1e10f, 1e10f, 1e10f};
    const Values b = {0, 0, 0.09f, 60, 80, 0, 0, 0.11f, 0, 3, 3, 3};
    const LayerChange found = change(PairKind::Position, 3, a, b, surfaces(depth, depth));
    EXPECT_THAT(found.changed, ElementsAre(0, 0, 1, 0));
    EXPECT_NEAR(found.max, 0.0011, 1e-9);
    EXPECT_EQ(found.background_changed, 0);
}

TEST(LayerChange, NormalsByTenDegreesWhereBothAreLong) {
    const Values a = {0, 0, 1, 0, 0, 1, 0, 0, 0.5f, 0, 0, 0};
    const Values b = {0, 0.19f, 0.98f, 0, 0.16f, 0.987f, 0, 0.5f, 0, 1, 0, 0};
    const LayerChange found = change(PairKind::Normal, 3, a, b);
    EXPECT_THAT(found.changed, ElementsAre(1, 0, 0, 0));
    EXPECT_NEAR(found.max, 10.97, 0.01);
}

TEST(LayerChange, IdsByTheirBits) {
    const LayerChange found = change(PairKind::Ids, 1, {1, 2, kNan, 0.f}, {1, 3, kNan, -0.f});
    EXPECT_THAT(found.changed, ElementsAre(0, 1, 0, 1));
    EXPECT_EQ(found.mean, 0.5);
}

TEST(LayerChange, WhatIsNoNumberHasChangedUnlessItIsTheSame) {
    const LayerChange found = change(PairKind::Depth, 1, {1, kInf, kNan}, {kNan, kInf, kNan});
    EXPECT_THAT(found.changed, ElementsAre(1, 0, 0));
    EXPECT_EQ(found.max, 0);
    EXPECT_THAT(surfaces({kNan, 1e9f, 1}, {kInf, 3, 1}).in[0], ElementsAre(0, 0, 1));
}

} // namespace
} // namespace tonetool::metrics
