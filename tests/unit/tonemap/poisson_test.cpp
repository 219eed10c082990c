#include "tonemap/poisson.h"

#include <gtest/gtest.h>

#include <algorithm>
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

int least_square(const std::vector<Offset>& offsets) {
    int least = 1 << 30;
    for (size_t i = 0; i < offsets.size(); ++i)
        for (size_t j = 0; j < i; ++j) {
            const int x = offsets[i].dx - offsets[j].dx, y = offsets[i].dy - offsets[j].dy;
            least = std::min(least, x * x + y * y);
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

// A square grid of as many points in 41 x 41 has steps of 41 / sqrt(count); a Poisson disk keeps
// half of that at least, where random points come to touch.
TEST(PoissonSets, AreWellApart) {
    for (int count : {32, 64, 80, 120})
        for (const auto& set : poisson_sets(20, count))
            EXPECT_GE(least_square(set) * 4, 41 * 41 / count) << count;
}

// Nothing but integers: the same with every compiler and library.
TEST(PoissonSets, AreTheSameEverywhere) {
    uint32_t sum = 0;
    for (const auto& set : poisson_sets(20, 80))
        for (const Offset& o : set)
            sum = sum * 31 + uint32_t(o.dx + 20) * 41 + uint32_t(o.dy + 20);
    EXPECT_EQ(sum, 296769513u);
}

// Every part of the window gets its share over all sets.
TEST(PoissonSets, CoverTheWindowEvenly) {
    int quarters[4] = {}, edges = 0, all = 0;
    for (const auto& set : poisson_sets(20, 80))
        for (const Offset& o : set) {
            ++all;
            ++quarters[(o.dx > 0) + 2 * (o.dy > 0)];
            edges += std::max(std::abs(o.dx), std::abs(o.dy)) == 20;
        }
    const double shares[4] = {21 * 21, 20 * 21, 20 * 21, 20 * 20};
    for (int q = 0; q < 4; ++q)
        EXPECT_NEAR(quarters[q] / double(all), shares[q] / 1681, 0.02);
    EXPECT_NEAR(edges / double(all), 160 / 1681.0, 0.01);
}

} // namespace
} // namespace tonetool::tonemap
