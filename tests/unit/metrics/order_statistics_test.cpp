// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/order_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "schedules.h"

namespace tonetool::metrics {
namespace {

using kernels::backwards;
using kernels::in_order;
using kernels::on_threads;
using kernels::ParallelFor;
using Values = std::vector<float>;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Values random_values(size_t n, float (*make)(uint32_t)) {
    std::mt19937 random(7);
    Values out(n);
    for (float& v : out)
        v = make(uint32_t(random()));
    return out;
}

struct Case {
    const char* name;
    Values values;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        {"one pixel", {0.25f}},
        {"one zero", {0.0f}},
        {"two", {2.0f, 1.0f}},
        {"constant", Values(99, 0.7f)},
        {"zeros", Values(99, 0.0f)},
        {"unit interval", random_values(4000, [](uint32_t r) { return float(r) * 0x1p-32f; })},
        {"odd count", random_values(4001, [](uint32_t r) { return float(r) * 0x1p-32f; })},
        {"ties", random_values(3000, [](uint32_t r) { return float(r % 5) * 0.25f; })},
        {"every exponent",
         random_values(3000, [](uint32_t r) { return std::ldexp(1.0f, int(r % 277) - 149); })},
        {"denormals", random_values(500, [](uint32_t r) { return float(r % 1000) * 0x1p-149f; })},
        {"huge range", random_values(3000,
                                     [](uint32_t r) {
                                         return std::ldexp(1.0f + float(r >> 9) * 0x1p-23f,
                                                           int(r % 270) - 149);
                                     })},
        {"within a bucket",
         random_values(500, [](uint32_t r) { return 1.0f + float(r % 60000) * 0x1p-23f; })},
        {"mostly zero",
         random_values(1000, [](uint32_t r) { return r % 10 ? 0.0f : float(r) * 0x1p-32f; })},
        {"ends", {0.0f, 0x1p-149f, 1.17549435e-38f, 1.0f, 3.4028234e38f, 3.4028234e38f}}};
    return all;
}

Values sorted(Values values) {
    std::sort(values.begin(), values.end());
    return values;
}

constexpr auto kSums = OrderStatistics::Keep::CountsAndSums;

OrderStatistics statistics(const Values& v) {
    return {v.data(), int(v.size()), 1, ptrdiff_t(v.size()), in_order(), kSums};
}

float find(const OrderStatistics& order, const Wanted& wanted) {
    return order.find({wanted})[0];
}

TEST(OrderStatistics, RanksAreThoseOfASort) {
    for (const Case& c : cases()) {
        const auto order = statistics(c.values);
        const Values expected = sorted(c.values);
        ASSERT_EQ(order.count(), int64_t(expected.size())) << c.name;
        EXPECT_EQ(order.zeros(), std::count(expected.begin(), expected.end(), 0.0f)) << c.name;
        const size_t step = std::max<size_t>(1, expected.size() / 23);
        for (size_t i = 0; i < expected.size(); i += step)
            EXPECT_EQ(find(order, Wanted::rank(int64_t(i))), expected[i])
                << c.name << " rank " << i;
        EXPECT_EQ(find(order, Wanted::rank(order.count() - 1)), expected.back()) << c.name;
        EXPECT_EQ(find(order, Wanted::rank(-5)), expected.front()) << c.name;
        EXPECT_EQ(find(order, Wanted::rank(order.count() + 5)), expected.back()) << c.name;
    }
}

TEST(OrderStatistics, PercentileIsTheNearestRank) {
    for (const Case& c : cases()) {
        const auto order = statistics(c.values);
        const Values all = sorted(c.values);
        for (double share : {0.0, 0.01, 0.25, 0.5, 0.95, 0.99, 0.999, 1.0}) {
            // The smallest element with at least that share at or below it.
            const auto at = std::find_if(all.begin(), all.end(), [&](const float& v) {
                return double(std::upper_bound(all.begin(), all.end(), v) - all.begin()) >=
                       share * double(all.size());
            });
            EXPECT_EQ(find(order, Wanted::percentile(share)), *at) << c.name << " " << share;
        }
    }
}

// The definition, word by word, on sorted values. A sum of long doubles is exact to 2^-64, so that
// only an element that ends within rounding of the share could differ: none here does.
float weighted(const Values& all, double share) {
    long double total = 0, running = 0;
    for (float v : all)
        total += v;
    for (float v : all) {
        running += v;
        if (running > share * total)
            return v;
    }
    return 0;
}

TEST(OrderStatistics, WeightedPercentileFollowsItsDefinition) {
    for (const Case& c : cases()) {
        const auto order = statistics(c.values);
        const Values all = sorted(c.values);
        for (double share : {0.001, 0.25, 0.5, 0.75, 0.999})
            EXPECT_EQ(find(order, Wanted::weighted_percentile(share)), weighted(all, share))
                << c.name << " " << share;
    }
}

TEST(OrderStatistics, WeightedPercentileByHand) {
    const struct {
        Values values;
        double share;
        float expected;
    } table[] = {{{1, 2, 3, 4}, 0.25, 2}, // sums 1 3 6 10 against 2.5
                 {{4, 3, 2, 1}, 0.5, 3},  // against 5
                 {{1, 2, 3, 4}, 0.75, 4}, // against 7.5
                 {{1, 1, 1, 1}, 0.25, 1},     {{1, 1, 2}, 0.25, 1},
                 {{1, 3}, 0.25, 3}, // strict: 1 is not above 1
                 {{0, 0, 0, 8}, 0.25, 8},     {{0, 0}, 0.5, 0},
                 {{1, 2, 3}, 1.0, 3}, // nothing exceeds the total: the largest
                 {{1e30f, 1, 1}, 0.25, 1e30f}};
    for (const auto& row : table)
        EXPECT_EQ(find(statistics(row.values), Wanted::weighted_percentile(row.share)),
                  row.expected)
            << testing::PrintToString(row.values) << " " << row.share;
}

TEST(OrderStatistics, IgnoreWhatIsNotAFiniteNonNegativeNumber) {
    const Values values = {kNan, 0.5f, -kNan, kInf, 0.25f, -kInf, -1.0f, 1.0f, -0.0f};
    const auto order = statistics(values);
    EXPECT_EQ(order.count(), 4);
    EXPECT_EQ(order.zeros(), 1) << "-0 is 0";
    EXPECT_EQ(find(order, Wanted::rank(0)), 0.0f);
    EXPECT_EQ(find(order, Wanted::rank(1)), 0.25f);
    EXPECT_EQ(find(order, Wanted::rank(3)), 1.0f);
    EXPECT_EQ(find(order, Wanted::weighted_percentile(0.5)), 1.0f);
}

TEST(OrderStatistics, OfNothingAreZero) {
    for (const Values& values : {Values{}, Values{kNan, kNan}}) {
        const auto order = statistics(values);
        EXPECT_EQ(order.count(), 0);
        EXPECT_EQ(find(order, Wanted::rank(0)), 0.0f);
        EXPECT_EQ(find(order, Wanted::percentile(0.5)), 0.0f);
        EXPECT_EQ(find(order, Wanted::weighted_percentile(0.5)), 0.0f);
    }
}

// A picture with something of everything, larger than a block of rows.
Values everything(size_t n) {
    Values out = random_values(n, [](uint32_t r) {
        const float value = std::ldexp(1.0f + float(r >> 9) * 0x1p-23f, int(r % 250) - 149);
        return r % 7 ? value : -0.0f;
    });
    for (size_t i = 0; i < n; i += 11)
        out[i] = i % 2 ? kNan : kInf;
    std::fill_n(out.begin() + ptrdiff_t(n / 3), n / 5, 0.375f);
    return out;
}

TEST(OrderStatistics, WantedTogetherAreThoseWantedAlone) {
    const Values values = everything(300 * 400);
    const OrderStatistics order(values.data(), 300, 400, 300, in_order(), kSums);
    std::vector<Wanted> wanted;
    for (double share : {0.5, 0.25, 0.999, 0.0, 1.0, 0.5, 0.75, 0.01}) {
        wanted.push_back(Wanted::percentile(share));
        wanted.push_back(Wanted::weighted_percentile(share));
        wanted.push_back(Wanted::rank(int64_t(share * 1e5)));
    }
    const Values together = order.find(wanted);
    for (size_t i = 0; i < wanted.size(); ++i)
        EXPECT_EQ(together[i], find(order, wanted[i])) << i;
    EXPECT_EQ(order.find({}), Values{});
}

TEST(OrderStatistics, MatchASortOfALargePicture) {
    const Values values = everything(700 * 301);
    const OrderStatistics order(values.data(), 700, 301, 700, in_order(), kSums);
    Values all;
    for (float v : values)
        if (std::isfinite(v))
            all.push_back(v);
    std::sort(all.begin(), all.end());
    ASSERT_EQ(order.count(), int64_t(all.size()));
    EXPECT_EQ(order.zeros(), std::count(all.begin(), all.end(), 0.0f));
    for (size_t i = 0; i < all.size(); i += 9973)
        EXPECT_EQ(find(order, Wanted::rank(int64_t(i))), all[i]) << i;
    for (double share : {0.25, 0.5, 0.75})
        EXPECT_EQ(find(order, Wanted::weighted_percentile(share)), weighted(all, share)) << share;
}

TEST(OrderStatistics, ScheduleDoesNotChangeABit) {
    const int sizes[][2] = {{700, 301}, {1, 200000}, {200000, 1}, {70000, 3}};
    for (const auto& size : sizes) {
        SCOPED_TRACE(testing::Message() << size[0] << "x" << size[1]);
        const Values values = everything(size_t(size[0]) * size_t(size[1]));
        const auto figures = [&](const ParallelFor& parallel) {
            const OrderStatistics order(values.data(), size[0], size[1], size[0], parallel, kSums);
            Values found =
                order.find({Wanted::rank(0), Wanted::percentile(0.5), Wanted::percentile(0.999),
                            Wanted::rank(order.count()), Wanted::weighted_percentile(0.25),
                            Wanted::weighted_percentile(0.75)});
            found.push_back(float(order.count()));
            found.push_back(float(order.zeros()));
            return found;
        };
        const Values expected = figures(in_order());
        for (const ParallelFor& parallel : {backwards(), on_threads(2), on_threads(7)})
            EXPECT_EQ(figures(parallel), expected);
    }
}

TEST(OrderStatistics, RespectTheStride) {
    Values padded(5 * 8, 100.0f);
    Values plain;
    for (int y = 0; y < 5; ++y)
        for (int x = 0; x < 3; ++x) {
            padded[size_t(y * 8 + x)] = float((x * 7 + y * 3) % 11);
            plain.push_back(padded[size_t(y * 8 + x)]);
        }
    const OrderStatistics order(padded.data(), 3, 5, 8, in_order(), kSums);
    const Values expected = sorted(plain);
    ASSERT_EQ(order.count(), 15);
    for (int64_t i = 0; i < 15; ++i)
        EXPECT_EQ(find(order, Wanted::rank(i)), expected[size_t(i)]);
    EXPECT_EQ(find(order, Wanted::weighted_percentile(0.5)),
              find(statistics(plain), Wanted::weighted_percentile(0.5)));
}

} // namespace
} // namespace tonetool::metrics
