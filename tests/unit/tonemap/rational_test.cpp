// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/rational.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tonetool::tonemap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kLargest = 1e15; // where exposed values are cut off

TEST(RationalCurve, AreThoseOfThePaper) {
    const struct {
        const char* name;
        kernels::ToneKind kind;
        std::array<double, 6> k;
    } cases[] = {{"aces", kernels::ToneKind::Rational, {0.9036, 0.018, 0, 0.8748, 0.354, 0.14}},
                 {"hable", kernels::ToneKind::Rational, {0.231683, 0.013791, 0, 0.18, 0.3, 0.018}},
                 {"reinhard", kernels::ToneKind::ReinhardLuminance, {0, 1, 0, 0, 1, 1}}};
    for (const auto& c : cases) {
        const auto curve = rational_curve(c.name);
        ASSERT_TRUE(curve.has_value()) << c.name;
        EXPECT_EQ(curve->kind, c.kind);
        for (size_t i = 0; i < 6; ++i)
            EXPECT_DOUBLE_EQ(curve->k[i], c.k[i]) << c.name << " k" << i;
    }
}

TEST(RationalCurve, NamesAreExactAndListed) {
    EXPECT_THAT(rational_curve_names(), ElementsAre("aces", "hable", "reinhard"));
    for (const std::string& name : rational_curve_names())
        EXPECT_TRUE(rational_curve(name).has_value()) << name;
    for (const char* name : {"", "ACES", "ace", "aces ", "filmic"})
        EXPECT_FALSE(rational_curve(name).has_value()) << name;
}

TEST(CurveFault, FindsNoneInUsableCurves) {
    const struct {
        const char* what;
        std::array<double, 6> k;
        double largest;
    } cases[] = {{"reinhard", rational_curve("reinhard")->k, kLargest},
                 {"the identity", {0, 1, 0, 0, 0, 1}, kLargest},
                 {"a line with an offset", {0, 2, 0.5, 0, 0, 1}, kLargest},
                 {"x^2: no slope at 0", {1, 0, 0, 0, 0, 1}, kLargest},
                 {"x^2 / (x^2 + 1): no slope at 0", {1, 0, 0, 1, 0, 1}, kLargest},
                 {"negated above and below", {0, -1, 0, 0, -1, -1}, kLargest},
                 {"a pole below 0", {0, 1, 0, 0, 1, 0.01}, kLargest},
                 {"a pole beyond the values", {0, 1, 0, 0, -1, 1}, 0.999},
                 {"a turn beyond the values", {-1, 2, 0, 0, 0, 1}, 0.999},
                 {"a turn at the largest value", {-1, 2, 0, 0, 0, 1}, 1.0},
                 {"nothing but black", {0, 1, 0, 0, 1, 1}, 0.0}};
    for (const auto& c : cases)
        EXPECT_THAT(curve_fault(c.k, c.largest), IsEmpty()) << c.what;
}

TEST(CurveFault, FindsNoneInTheNamedCurvesOnTheirUsefulRange) {
    // Hable's poles lie at -0.0623 and -1.604; ACES has none. Both rise on [0, 100].
    for (const std::string& name : rational_curve_names())
        EXPECT_THAT(curve_fault(rational_curve(name)->k, 100), IsEmpty()) << name;
}

TEST(CurveFault, NamesThePlace) {
    const struct {
        const char* what;
        std::array<double, 6> k;
        double largest;
        std::vector<const char*> words;
    } cases[] = {
        {"a simple pole", {0, 1, 0, 0, -1, 2}, 10, {"pole at x = 2", "0 to 10"}},
        {"the first of two poles", {0, 1, 0, 1, -5, 6}, 10, {"pole at x = 2"}},
        {"a double pole", {0, 1, 0, 1, -2, 1}, 10, {"pole at x = 1"}},
        {"a pole at 0", {1, 0, 1, 0, 1, 0}, 10, {"pole at x = 0"}},
        {"a pole at the end", {0, 1, 0, 0, -1, 2}, 2, {"pole at x = 2"}},
        {"a double pole at 0", {0, 1, 1, 1, 0, 0}, 10, {"pole at x = 0"}},
        {"falling", {0, -1, 1, 0, 0, 1}, 10, {"does not increase above x = 0", "0 to 10"}},
        {"flat", {0, 0, 1, 0, 0, 2}, 10, {"does not increase above x = 0"}},
        {"a constant in disguise", {1, 2, 3, 2, 4, 6}, 10, {"does not increase above x = 0"}},
        {"turning", {-1, 2, 0, 0, 0, 1}, 10, {"does not increase above x = 1"}},
        {"turning within 1e-9 of the end", {-1, 2, 0, 0, 0, 1}, 1 + 1e-9, {"increase above x = 1"}},
        {"first falling", {1, -2, 2, 0, 0, 1}, 10, {"does not increase above x = 0"}},
        {"no denominator", {1, 1, 1, 0, 0, 0}, 10, {"denominator is 0 everywhere"}},
        {"NaN", {kNan, 1, 0, 0, 1, 1}, 10, {"not finite"}},
        {"Inf", {0, 1, 0, 0, 1, kInf}, 10, {"not finite"}}};
    for (const auto& c : cases)
        for (const char* word : c.words)
            EXPECT_THAT(curve_fault(c.k, c.largest), HasSubstr(word)) << c.what;
}

// The verdict against the curve itself, walked in small steps.
TEST(CurveFault, AgreesWithTheCurveItself) {
    const double values[] = {-1, 0, 0.5, 1};
    const double largest = 4;
    int usable = 0, all = 0;
    for (int code = 0; code < 4096; ++code) {
        std::array<double, 6> k{};
        for (size_t i = 0, rest = size_t(code); i < 6; ++i, rest /= 4)
            k[i] = values[rest % 4];
        const auto up = [&](double x) { return (k[0] * x + k[1]) * x + k[2]; };
        const auto down = [&](double x) { return (k[3] * x + k[4]) * x + k[5]; };
        // Roots of these denominators and turning points lie further than a step apart from
        // each other, or are double roots at multiples of the step.
        constexpr double step = 1.0 / 256;
        bool fine = true;
        double before = 0;
        for (int i = 0; fine && i <= int(largest / step); ++i) {
            const double x = i * step, below = down(x);
            fine = below != 0 && (below > 0) == (down(0) > 0);
            fine = fine && (i == 0 || up(x) / below > before);
            before = up(x) / below;
        }
        EXPECT_EQ(curve_fault(k, largest).empty(), fine)
            << testing::PrintToString(k) << " " << curve_fault(k, largest);
        usable += fine;
        ++all;
    }
    EXPECT_GT(usable, all / 20);
    EXPECT_LT(usable, all / 2);
}

} // namespace
} // namespace tonetool::tonemap
