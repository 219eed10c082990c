// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/noise_floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "metrics/distributions.h"
#include "refusal.h"

namespace tonetool::metrics {
namespace {

std::vector<double> ramp(int count) {
    std::vector<double> out;
    for (int i = 1; i <= count; ++i)
        out.push_back(i / 100.0);
    return out;
}

NoiseFloor floor_of(const std::vector<double>& values, double content = 0.99) {
    NoiseFloorOptions options;
    options.content = content;
    return noise_floor(values, options);
}

const std::vector<double> kEight = {.2026, .2032, .2016, .202, .2011, .2027, .2023, .2024};

// The results of the method's reference implementation.
TEST(NoiseFloor, LognormalOfEightRenders) {
    const NoiseFloor got = floor_of(kEight);
    EXPECT_EQ(got.method, NoiseFloorMethod::Lognormal);
    EXPECT_NEAR(got.limit, 0.20513683893385157, 1e-12);
    EXPECT_NEAR(got.k, 4.35385580922893, 1e-10);
    EXPECT_EQ(got.needed, 299);
    EXPECT_EQ(got.values, 8);
    EXPECT_EQ(got.rank, 0);
    EXPECT_FALSE(got.outlier.has_value());
}

TEST(NoiseFloor, NormalWhereAValueIsZero) {
    const NoiseFloor got = floor_of({0.0, .2, .1, .3, .25});
    EXPECT_EQ(got.method, NoiseFloorMethod::Normal);
    EXPECT_NEAR(got.limit, 0.8613181219902425, 1e-12);
}

TEST(NoiseFloor, OrderStatisticsOfManyRenders) {
    const NoiseFloor all = floor_of(ramp(59), 0.95);
    EXPECT_EQ(all.method, NoiseFloorMethod::OrderStatistic);
    EXPECT_EQ(all.rank, 59);
    EXPECT_EQ(all.limit, 0.59);
    EXPECT_EQ(all.needed, 59);
    const NoiseFloor second = floor_of(ramp(99), 0.95);
    EXPECT_EQ(second.rank, 98);
    EXPECT_EQ(second.limit, 0.98);
    EXPECT_EQ(floor_of(ramp(58), 0.95).method, NoiseFloorMethod::Lognormal);
    EXPECT_EQ(floor_of(ramp(299)).rank, 299);
}

// By the definition: one rank lower would not do.
TEST(NoiseFloor, RankIsTheSmallestThatWillDo) {
    for (const int count : {59, 93, 150, 400}) {
        const int64_t rank = floor_of(ramp(count), 0.95).rank;
        EXPECT_GE(binomial_at_most(rank - 1, count, 0.95), 0.95) << count;
        EXPECT_LT(binomial_at_most(rank - 2, count, 0.95), 0.95) << count;
    }
}

TEST(NoiseFloor, OrderOfTheValuesDoesNotMatter) {
    std::vector<double> values = kEight;
    std::sort(values.begin(), values.end());
    EXPECT_NEAR(floor_of(values).limit, floor_of(kEight).limit, 1e-15);
    std::vector<double> many = ramp(99);
    std::reverse(many.begin(), many.end());
    EXPECT_EQ(floor_of(many, 0.95).limit, 0.98);
}

// A lognormal limit goes with the unit of its values.
TEST(NoiseFloor, ScalesWithTheValues) {
    std::vector<double> twice = kEight;
    for (double& value : twice)
        value *= 2;
    EXPECT_NEAR(floor_of(twice).limit, 2 * floor_of(kEight).limit, 1e-14);
}

// The claim itself: of limits from 8 lognormal values, 95 % lie above 99 % of the distribution.
TEST(NoiseFloor, HoldsWithTheConfidenceClaimed) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const double quantile = std::exp(0.1 * normal_quantile(0.99));
    int held = 0;
    constexpr int trials = 2000;
    for (int i = 0; i < trials; ++i) {
        std::vector<double> values;
        for (int k = 0; k < 8; ++k)
            values.push_back(std::exp(0.1 * normal(random)));
        held += floor_of(values).limit >= quantile;
    }
    // Four standard deviations of a share of 0.95 of 2000.
    EXPECT_NEAR(held / double(trials), 0.95, 0.02);
}

TEST(NoiseFloor, NamesTheOutlier) {
    std::vector<double> values = kEight;
    values[2] = 0.3;
    EXPECT_EQ(floor_of(values).outlier, size_t(2));
    // Just within and just above 4 standard deviations of the logarithms of the others.
    double mean = 0, squares = 0;
    for (double value : kEight)
        mean += std::log(value) / 8;
    for (double value : kEight)
        squares += (std::log(value) - mean) * (std::log(value) - mean);
    const double sd = std::sqrt(squares / 7);
    std::vector<double> within = kEight, above = kEight;
    within.push_back(std::exp(mean + 3.99 * sd));
    above.insert(above.begin(), std::exp(mean + 4.01 * sd));
    EXPECT_FALSE(floor_of(within).outlier.has_value());
    EXPECT_EQ(floor_of(above).outlier, size_t(0));
}

TEST(NoiseFloor, OutlierBelowIsNone) {
    std::vector<double> values = kEight;
    values[2] = 0.1;
    EXPECT_FALSE(floor_of(values).outlier.has_value());
}

TEST(NoiseFloor, RefusesTooFewValues) {
    EXPECT_EQ(refusal([] {
                  floor_of({.1, .2, .3});
              }),
              "a limit needs the values of at least 4 renders, there are 3");
    EXPECT_NE(refusal([] { floor_of({}); }), "");
    EXPECT_EQ(refusal([] { floor_of({.1, .11, .12, .13}); }), "");
}

TEST(NoiseFloor, RefusesALimitThatCannotBeExceeded) {
    NoiseFloorOptions options;
    const std::vector<double> values = {.8, .9, .7, .95};
    EXPECT_EQ(refusal([&] { noise_floor(values, options); }), "") << "the quantity has no bound";
    options.below_one = true;
    EXPECT_NE(refusal([&] { noise_floor(values, options); }).find("never exceeds"),
              std::string::npos);
    EXPECT_EQ(refusal([&] { noise_floor(kEight, options); }), "");
    // An order statistic of 1 is as useless.
    std::vector<double> many(299, 0.5);
    many.back() = 1;
    EXPECT_NE(refusal([&] { noise_floor(many, options); }), "");
}

TEST(NoiseFloor, RefusesWhatIsNoNumber) {
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(refusal([&] { floor_of({.1, .2, .3, inf}); }), "a value is not finite");
    EXPECT_EQ(refusal([&] { floor_of({.1, .2, .3, std::nan("")}); }), "a value is not finite");
    for (const double content : {0.0, 1.0, -1.0, std::nan("")})
        EXPECT_NE(refusal([&] { floor_of(kEight, content); }).find("content"), std::string::npos);
    NoiseFloorOptions options;
    options.confidence = 1;
    EXPECT_NE(refusal([&] { noise_floor(kEight, options); }).find("confidence"), std::string::npos);
}

} // namespace
} // namespace tonetool::metrics
