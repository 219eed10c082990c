// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/curves.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include "curve_cases.h"
#include "kernels/curve_reference.h"
#include "refusal.h"
#include "tonemap/rational.h"

namespace tonetool::tonemap {
namespace {

using kernels::curve_reference;
using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(const char* name, const std::map<std::string, double>& given) {
    return refusal([&] { curve_values(*find_curve(name), given, false); });
}

TEST(Curves, AreNamedOnceAndDescribed) {
    std::set<std::string> names;
    for (const Curve& row : all_curves()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name;
        EXPECT_EQ(find_curve(row.name), &row);
        for (const char* text : {row.title, row.source, row.formula})
            EXPECT_GT(std::strlen(text), 2u) << row.name;
        EXPECT_EQ(std::string(row.name).find_first_not_of("abcdefghijklmnopqrstuvwxyz-0123456789"),
                  std::string::npos);
        std::set<std::string> parameters;
        for (const CurveParameter& p : row.parameters) {
            EXPECT_TRUE(parameters.insert(p.name).second) << row.name << " " << p.name;
            EXPECT_TRUE(p.low <= p.value && p.value <= p.high) << row.name << " " << p.name;
            EXPECT_GT(std::strlen(p.help), 0u) << row.name << " " << p.name;
            const double flip = p.flip_value.value_or(p.value);
            EXPECT_TRUE(p.low <= flip && flip <= p.high) << row.name << " " << p.name;
        }
        EXPECT_EQ(row.domain == CurveDomain::Color,
                  kernels::mixes_channels(kernels::cases_of(row).front().numbers.kind))
            << row.name;
    }
    EXPECT_EQ(curve_names().size(), names.size());
    EXPECT_EQ(find_curve("Aces"), nullptr);
    EXPECT_EQ(find_curve(""), nullptr);
}

TEST(Curves, ParameterNamesAreListedOnce) {
    const auto names = curve_parameter_names();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (const Curve& row : all_curves())
        for (const CurveParameter& p : row.parameters)
            EXPECT_THAT(names, testing::Contains(p.name));
}

TEST(CurveValues, AreDefaultsWithThoseGiven) {
    const Curve& drago = *find_curve("drago");
    EXPECT_THAT(curve_values(drago, {}, false), ElementsAre(5, 0.85));
    EXPECT_THAT(curve_values(drago, {{"bias", 0.7}}, false), ElementsAre(5, 0.7));
    const Curve& aces = *find_curve("aces");
    EXPECT_THAT(curve_values(aces, {}, false), ElementsAre(1));
    EXPECT_THAT(curve_values(aces, {}, true), ElementsAre(0.6));
    EXPECT_THAT(curve_values(aces, {{"prescale", 0.8}}, true), ElementsAre(0.8));
}

TEST(CurveValues, SayWhatWouldBeValid) {
    EXPECT_THAT(error_of("drago", {{"biass", 0.8}}),
                testing::AllOf(HasSubstr("\"drago\" has no parameter \"biass\""),
                               HasSubstr("white, bias")));
    EXPECT_THAT(error_of("hable", {{"white", 5}}), HasSubstr("it has none"));
    for (double bias : {0.0, -1.0, 1.01, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THAT(error_of("drago", {{"bias", bias}}), HasSubstr("valid: 0.01 to 1"));
    EXPECT_EQ(error_of("drago", {{"bias", 1}, {"white", 1e9}}), "");
}

TEST(CurveValues, MustGoTogether) {
    EXPECT_THAT(error_of("lottes", {{"white", 0.2}}), HasSubstr("falls at x = "));
    EXPECT_THAT(error_of("lottes", {{"white", 0.18}}), HasSubstr("no result"));
    EXPECT_THAT(error_of("uchimura", {{"pedestal", 0.5}}), HasSubstr("falls at x = "));
    EXPECT_EQ(error_of("uchimura", {{"pedestal", 0.05}}), "");
}

// 16 to an octave, 2^-20 to 2^20.
TEST(Curves, NeverFall) {
    constexpr int steps = 16;
    for (const Curve& row : all_curves()) {
        bool falls = false;
        for (const auto& one : kernels::cases_of(row)) {
            double before = curve_reference(one.numbers, 0),
                   clamped_before = std::clamp(before, 0., 1.);
            for (int i = -20 * steps; i <= 20 * steps; ++i) {
                const double y = curve_reference(one.numbers, std::exp2(double(i) / steps));
                const double clamped = std::clamp(y, 0.0, 1.0);
                EXPECT_GE(clamped, clamped_before - 1e-12) << one.what << " at 2^" << i << "/16";
                falls = falls || (one.defaults && y < before - 1e-12);
                before = y;
                clamped_before = clamped;
            }
        }
        EXPECT_EQ(row.monotone, !falls) << row.name;
    }
}

TEST(Curves, KeepBlackBlack) {
    for (const Curve& row : all_curves())
        for (const auto& one : kernels::cases_of(row)) {
            const auto& p = one.numbers.p;
            double black = 0;
            if (one.numbers.kind == kernels::CurveKind::Uchimura)
                black = p[5]; // the pedestal
            else if (one.numbers.kind == kernels::CurveKind::Film)
                black = std::pow(10, p[2] - p[3]); // its densest
            const double y = std::max(curve_reference(one.numbers, 0), 0.0);
            EXPECT_DOUBLE_EQ(y, black) << one.what;
        }
}

// A calibration sets `white` on any curve that has it.
TEST(Curves, WhiteBecomesOne) {
    for (const Curve& row : all_curves())
        for (const CurveParameter& p : row.parameters)
            for (double white : {0.5, 1.0, 11.2, 1000.0}) {
                if (p.name != std::string("white") || row.name == std::string("exponential"))
                    continue; // the latter reaches 1 - 1/e there
                const CurveValues values = curve_values(row, {{"white", white}}, false);
                EXPECT_NEAR(curve_reference(row.make(values), white), 1, 1e-12) << row.name;
            }
}

TEST(Coefficients, OfNamedCurvesAreThoseKnown) {
    const double w = 5;
    const struct {
        const char* name;
        std::array<double, 6> k; ///< up to a common factor
        double close;            ///< digits that the source gives
    } cases[] = {{"linear", {0, 1, 0, 0, 0, 1}, 0},
                 {"reinhard", {0, 1, 0, 0, 1, 1}, 0},
                 {"reinhard-extended", {1 / (w * w), 1, 0, 0, 1, 1}, 0},
                 {"aces", {2.51, 0.03, 0, 2.43, 0.59, 0.14}, 0},
                 {"hable", {0.231683, 0.013791, 0, 0.18, 0.30, 0.018}, 0},
                 {"uncharted2", {0.0735615, 0.00691801, 0, 0.066, 0.09, 0.018}, 5e-6},
                 {"steve-a", {10, 0.3, 0, 10, 0.5, 1.5}, 0},
                 {"steve-b", {1.8, 1.4, 0, 1.8, 0.5, 1.5}, 0}};
    for (const auto& c : cases) {
        const auto numbers = kernels::cases_of(*find_curve(c.name)).front().numbers;
        ASSERT_EQ(numbers.kind, kernels::CurveKind::Rational);
        for (size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(numbers.p[i], c.k[i], c.close * std::abs(c.k[i]) + 1e-16)
                << c.name << " k" << i;
    }
}

TEST(Coefficients, MakeTheSameCurveAsTheName) {
    for (const std::string& name : rational_curve_names()) {
        const auto k = rational_curve(name)->k;
        const CurveValues values = curve_values(*find_curve(name), {}, true);
        const kernels::CurveNumbers numbers = coefficient_curve({k.begin(), k.end()});
        EXPECT_EQ(numbers.p, find_curve(name)->make(values).p) << name;
    }
}

TEST(Coefficients, MustBeSixAndUsable) {
    const double inf = std::numeric_limits<double>::infinity();
    const struct {
        std::vector<double> k;
        const char* word;
    } cases[] = {{{}, "6 coefficients, not 0"},
                 {{1, 2, 3, 4, 5, 6, 7}, "not 7"},
                 {{0, inf, 0, 0, 0, 1}, "not finite"},
                 {{0, 1, 0, 0, 0, 0}, "denominator is 0"}};
    for (const auto& c : cases)
        EXPECT_THAT(refusal([&] { coefficient_curve(c.k); }), HasSubstr(c.word));
}

} // namespace
} // namespace tonetool::tonemap
