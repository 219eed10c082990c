#include "metrics/order_statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace tonetool::metrics {
namespace {

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

OrderStatistics statistics(const Values& v) {
    return {v.data(), int(v.size()), 1, ptrdiff_t(v.size())};
}

TEST(OrderStatistics, RanksAreThoseOfASort) {
    for (const Case& c : cases()) {
        const auto order = statistics(c.values);
        const Values expected = sorted(c.values);
        ASSERT_EQ(order.count(), int64_t(expected.size())) << c.name;
        EXPECT_EQ(order.zeros(), std::count(expected.begin(), expected.end(), 0.0f)) << c.name;
        const size_t step = std::max<size_t>(1, expected.size() / 23);
        for (size_t i = 0; i < expected.size(); i += step)
            EXPECT_EQ(order.at_rank(int64_t(i)), expected[i]) << c.name << " rank " << i;
        EXPECT_EQ(order.at_rank(order.count() - 1), expected.back()) << c.name;
        EXPECT_EQ(order.at_rank(-5), expected.front()) << c.name;
        EXPECT_EQ(order.at_rank(order.count() + 5), expected.back()) << c.name;
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
            EXPECT_EQ(order.percentile(share), *at) << c.name << " " << share;
        }
    }
}

TEST(OrderStatistics, WeightedPercentileFollowsItsDefinition) {
    for (const Case& c : cases()) {
        if (std::string(c.name) == "ends")
            continue; // its sums round: see the test of large and small values
        const auto order = statistics(c.values);
        const Values all = sorted(c.values);
        double total = 0;
        for (float v : all)
            total += double(v);
        for (double share : {0.25, 0.5, 0.75}) {
            double running = 0;
            float expected = 0;
            for (float v : all) {
                running += double(v);
                if (running > share * total) {
                    expected = v;
                    break;
                }
            }
            EXPECT_EQ(order.weighted_percentile(share), expected) << c.name << " " << share;
        }
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
        EXPECT_EQ(statistics(row.values).weighted_percentile(row.share), row.expected)
            << testing::PrintToString(row.values) << " " << row.share;
}

TEST(OrderStatistics, IgnoreWhatIsNotAFiniteNonNegativeNumber) {
    const Values values = {kNan, 0.5f, -kNan, kInf, 0.25f, -kInf, -1.0f, 1.0f, -0.0f};
    const auto order = statistics(values);
    EXPECT_EQ(order.count(), 4);
    EXPECT_EQ(order.zeros(), 1) << "-0 is 0";
    EXPECT_EQ(order.at_rank(0), 0.0f);
    EXPECT_EQ(order.at_rank(1), 0.25f);
    EXPECT_EQ(order.at_rank(3), 1.0f);
    EXPECT_EQ(order.weighted_percentile(0.5), 1.0f);
}

TEST(OrderStatistics, OfNothingAreZero) {
    for (const Values& values : {Values{}, Values{kNan, kNan}}) {
        const auto order = statistics(values);
        EXPECT_EQ(order.count(), 0);
        EXPECT_EQ(order.at_rank(0), 0.0f);
        EXPECT_EQ(order.percentile(0.5), 0.0f);
        EXPECT_EQ(order.weighted_percentile(0.5), 0.0f);
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
    const OrderStatistics order(padded.data(), 3, 5, 8);
    const Values expected = sorted(plain);
    ASSERT_EQ(order.count(), 15);
    for (int64_t i = 0; i < 15; ++i)
        EXPECT_EQ(order.at_rank(i), expected[size_t(i)]);
    EXPECT_EQ(order.weighted_percentile(0.5), statistics(plain).weighted_percentile(0.5));
}

} // namespace
} // namespace tonetool::metrics
