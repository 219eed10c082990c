// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/poisson.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace tonetool::tonemap {
namespace {

using kernels::Offset;

std::set<std::pair<int, int>> as_set(const std::vector<Offset>& offsets) {
    std::set<std::pair<int, int>> out;
    for (const Offset& o : offsets)
        out.insert({o.dx, o.dy});
    return out;
}

// Squared distance of the nearest two, in steps of the mean distance at their density.
double least_square(const std::vector<Offset>& offsets) {
    double least = 1e30;
    for (size_t i = 0; i < offsets.size(); ++i)
        for (size_t j = 0; j < i; ++j) {
            const int x = offsets[i].dx - offsets[j].dx, y = offsets[i].dy - offsets[j].dy;
            least = std::min(least, (x * x + y * y) * std::sqrt(offsets[i].density) *
                                        std::sqrt(offsets[j].density));
        }
    return least;
}

TEST(PoissonSets, HaveExactlyAsManyOffsetsAmongThemTheCentre) {
    for (int half : {3, 20, 25})
        for (int count : {4, 5, 32, 49}) {
            for (const auto& set : poisson_sets(half, count)) {
                ASSERT_EQ(set.size(), size_t(count));
                EXPECT_EQ(as_set(set).size(), size_t(count)) << "each once";
                EXPECT_TRUE(set[0].dx == 0 && set[0].dy == 0);
                for (const Offset& o : set)
                    EXPECT_TRUE(std::abs(o.dx) <= half && std::abs(o.dy) <= half);
            }
        }
    EXPECT_EQ(as_set(poisson_set(20, 400, 3)).size(), 400u);
    EXPECT_EQ(as_set(poisson_set(2, 400, 3)).size(), 25u) << "all there are";
}

TEST(PoissonSets, AreAllDifferent) {
    for (int count : {4, 64, 80, 400}) {
        std::set<std::set<std::pair<int, int>>> all;
        for (const auto& set : poisson_sets(20, count))
            all.insert(as_set(set));
        EXPECT_EQ(all.size(), 64u) << count;
    }
}

// The density is 1 at the centre and its integral 400 pi / 8 = 157: so much there is for each of
// them. A Poisson disk keeps half the distance of a square grid at least; random points touch.
TEST(PoissonSets, AreWellApart) {
    for (int count : {16, 32, 64})
        for (const auto& set : poisson_sets(20, count))
            EXPECT_GE(least_square(set), 0.25 * 157 / count) << count;
}

// Nothing but integers: the same with every compiler and library.
TEST(PoissonSets, AreTheSameEverywhere) {
    uint32_t sum = 0;
    for (const auto& set : poisson_sets(20, 80))
        for (const Offset& o : set)
            sum = sum * 31 + uint32_t(o.dx + 20) * 41 + uint32_t(o.dy + 20);
    EXPECT_EQ(sum, 3626618291u);
}

// Over all sets every place has as many offsets as its density says, whatever the direction.
TEST(PoissonSets, FollowTheirDensity) {
    double x = 0, y = 0, near = 0, all = 0, expected = 0, sum = 0;
    for (const auto& set : poisson_sets(20, 80))
        for (const Offset& o : set) {
            ++all;
            x += o.dx;
            y += o.dy;
            near += o.dx * o.dx + o.dy * o.dy <= 50;
        }
    for (const Offset& o : kernels::whole_window(20)) {
        const int square = o.dx * o.dx + o.dy * o.dy;
        const double density = 1 / std::pow(1 + square / 50.0, 2);
        sum += density;
        expected += square <= 50 ? density : 0;
    }
    EXPECT_NEAR(x / all, 0, 0.1);
    EXPECT_NEAR(y / all, 0, 0.1);
    // Whole pixels cannot lie as close as the density wants them to at the centre.
    EXPECT_NEAR(near / all, expected / sum, 0.08);
}

TEST(PoissonSets, OfEveryPlaceAreEven) {
    for (const Offset& o : poisson_set(4, 81, 0))
        EXPECT_DOUBLE_EQ(o.density, 1);
}

} // namespace
} // namespace tonetool::tonemap
