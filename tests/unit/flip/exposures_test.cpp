// SPDX-License-Identifier: BSD-3-Clause
#include "flip/exposures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "refusal.h"
#include "tonemap/rational.h"

namespace tonetool::flip {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

std::array<double, 6> curve(const char* name) {
    return tonemap::rational_curve(name)->k;
}

TEST(BrightPoint, IsThatOfThePublishedProgram) {
    const struct {
        const char* name;
        double x, log2;
    } cases[] = {{"reinhard", 5.66666794, 2.50250077},
                 {"aces", 2.11887312, 1.08329725},
                 {"hable", 3.12774992, 1.64512515}};
    for (const auto& c : cases) {
        const auto x = exposure_anchor(curve(c.name));
        ASSERT_TRUE(x.has_value()) << c.name;
        // Solved in float32 there: a few ulps after its square root and differences.
        EXPECT_NEAR(*x, c.x, 1e-6 * c.x) << c.name;
        EXPECT_NEAR(std::log2(*x), c.log2, 1e-6) << c.name;
        const auto k = curve(c.name);
        EXPECT_NEAR((k[0] * *x * *x + k[1] * *x + k[2]) / (k[3] * *x * *x + k[4] * *x + k[5]),
                    kAnchorValue, 1e-14);
    }
}

TEST(BrightPoint, IsNothingWhereTheCurveStaysBelow) {
    EXPECT_FALSE(exposure_anchor({0, 0.8, 0, 0, 1, 1}).has_value());
    EXPECT_FALSE(exposure_anchor({0, 0, 0, 0, 0, 1}).has_value());
    EXPECT_FALSE(exposure_anchor({0.8, 0, 0, 1, 0, 1}).has_value());
}

double rational(const std::array<double, 6>& k, double x) {
    return ((k[0] * x + k[1]) * x + k[2]) / ((k[3] * x + k[4]) * x + k[5]);
}

std::optional<double> solved(const std::function<double(double)>& shown) {
    return exposure_anchor([&](const std::vector<double>& values) {
        std::vector<double> out;
        for (double x : values)
            out.push_back(shown(x));
        return out;
    });
}

TEST(BrightPoint, IsTheSameSolvedNumerically) {
    for (const char* name : {"reinhard", "aces", "hable"}) {
        const auto k = curve(name);
        const auto x = solved([&](double v) { return rational(k, v); });
        ASSERT_TRUE(x.has_value()) << name;
        // A step of 1e-14 stops, less what the curve's own rounding hides.
        EXPECT_NEAR(*x, *exposure_anchor(k), 1e-12 * *x) << name;
    }
}

TEST(BrightPoint, IsTheLargestSolution) {
    // Rises through kAnchorValue at 1, falls through it at 4, rises for good at 16.
    const auto x = solved([](double v) {
        const double s = std::log2(v);
        return kAnchorValue + 0.01 * s * (s - 2) * (s - 4);
    });
    ASSERT_TRUE(x.has_value());
    EXPECT_NEAR(*x, 16, 1e-10);
    // A curve that ends below it was there last on its way down.
    const auto down = solved([](double v) { return v / (1 + 0.01 * v * v); });
    ASSERT_TRUE(down.has_value());
    EXPECT_GT(*down, 10);
}

TEST(BrightPoint, IsNothingWhereTheResponseStaysOnOneSide) {
    EXPECT_FALSE(solved([](double v) { return 0.84 * v / (1 + v); }).has_value());
    EXPECT_FALSE(solved([](double) { return 0.9; }).has_value());
}

ExposureRequest request(std::optional<double> start, std::optional<double> stop,
                        std::optional<int> count, double max = 0, double median = 0) {
    return {start, stop, count, max, median};
}

std::vector<double> exposures(const ExposureRequest& r) {
    return make_exposures(exposure_anchor(curve("aces")), r);
}

TEST(MakeExposures, FollowTheLuminances) {
    const double x = *exposure_anchor(curve("aces"));
    const auto stops = exposures(request({}, {}, {}, 16.0, 0.125));
    ASSERT_EQ(stops.size(), 7u);
    // Logarithms of double.
    EXPECT_NEAR(stops.front(), std::log2(x / 16), 1e-14);
    EXPECT_NEAR(stops.back(), std::log2(x / 0.125), 1e-14);
    for (size_t i = 1; i < stops.size(); ++i)
        EXPECT_NEAR(stops[i] - stops[i - 1], 7.0 / 6, 1e-14);
}

TEST(MakeExposures, NumberIsTheRangeRoundedUpButTwoAtLeast) {
    const struct {
        double range;
        size_t count;
    } cases[] = {{0, 2}, {0.1, 2}, {1, 2}, {2, 2}, {2.25, 3}, {3, 3}, {3.0625, 4}, {20.5, 21}};
    for (const auto& c : cases)
        EXPECT_EQ(exposures(request(-1, -1 + c.range, {})).size(), c.count) << c.range;
}

TEST(MakeExposures, TakeWhatIsGiven) {
    const double x = *exposure_anchor(curve("aces"));
    EXPECT_THAT(exposures(request(-2, 4, 4)), ElementsAre(-2, 0, 2, 4));
    EXPECT_THAT(exposures(request(1.5, 1.5, {})), ElementsAre(1.5, 1.5));
    EXPECT_THAT(exposures(request(1.5, 1.5, 3)), ElementsAre(1.5, 1.5, 1.5));
    EXPECT_THAT(exposures(request(-2, 4, 1)), ElementsAre(-2)) << "one exposure is the start";
    EXPECT_THAT(exposures(request(-2, {}, 1)), ElementsAre(-2)) << "needs no median";
    EXPECT_THAT(exposures(request({}, {}, 1, 4)), ElementsAre(std::log2(x / 4)));
    EXPECT_THAT(exposures(request(-6, {}, 2, 0, 0.5)), ElementsAre(-6, std::log2(x / 0.5)));
    EXPECT_THAT(exposures(request({}, 6, 2, 4, 0)), ElementsAre(std::log2(x / 4), 6));
    EXPECT_EQ(exposures(request(-126, 127, {})).size(), 253u);
    EXPECT_EQ(exposures(request(0, 1, kMaxExposures)).size(), size_t(kMaxExposures));
}

TEST(MakeExposures, BothEndsAreIncludedExactly) {
    for (int n : {2, 3, 7, 10, 100}) {
        const auto stops = exposures(request(-0.1, 0.7, n));
        ASSERT_EQ(stops.size(), size_t(n));
        EXPECT_EQ(stops.front(), -0.1);
        EXPECT_NEAR(stops.back(), 0.7, 1e-15); // start + (n-1) (stop-start)/(n-1)
    }
}

TEST(MakeExposures, SayWhatIsWrong) {
    const struct {
        ExposureRequest asked;
        std::vector<const char*> words;
    } cases[] = {
        {request(3, 2.5, {}), {"start exposure 3", "stop exposure 2.5", "must not be larger"}},
        {request(0, 1, 0), {"number of exposures is 0", "1 to 1024"}},
        {request(0, 1, -4), {"number of exposures is -4"}},
        {request(0, 1, 1025), {"number of exposures is 1025", "1 to 1024"}},
        {request(-127, 1, {}), {"start exposure is -127", "-126"}},
        {request(0, 128, {}), {"stop exposure is 128", "127"}},
        {request(kNan, 1, {}), {"start exposure is nan"}},
        {request(0, kInf, {}), {"stop exposure is inf"}},
        {request({}, 1, {}, 0), {"start", "luminance is 0", "startExposure"}},
        {request({}, 1, {}, -2), {"start", "luminance is -2"}},
        {request({}, 1, {}, kNan), {"luminance is nan"}},
        {request(0, {}, {}, 1, 0), {"stop", "luminance is 0", "stopExposure"}},
        {request({}, 0, {}, 1e-38 * 1e-2), {"start exposure is 1", "127"}}};
    for (const auto& c : cases) {
        const std::string error = refusal([&] { exposures(c.asked); });
        for (const char* word : c.words)
            EXPECT_THAT(error, HasSubstr(word));
    }
}

TEST(MakeExposures, ACurveThatStaysDarkNeedsThemGiven) {
    const std::array<double, 6> dark = {0, 0.8, 0, 0, 1, 1};
    EXPECT_THAT(refusal([&] { make_exposures(exposure_anchor(dark), request({}, {}, {}, 1, 1)); }),
                HasSubstr("never reaches 0.85"));
    EXPECT_NO_THROW(make_exposures(exposure_anchor(dark), request(0, 1, {})));
}

} // namespace
} // namespace tonetool::flip
