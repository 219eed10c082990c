// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "curve_cases.h"
#include "kernels/curve_reference.h"
#include "tonemap/curves.h"

namespace tonetool::tonemap {
namespace {

using kernels::curve_reference;
using kernels::CurveNumbers;

CurveNumbers curve(const char* name) {
    return kernels::cases_of(*find_curve(name)).front().numbers;
}

// Invertible: strictly between 0 and 1, and so steep that a 1e-4th of x changes the result by more
// than the noise of a double.
TEST(Inverse, FindsWhatTheCurveWasAt) {
    constexpr double close = 1e-4, noise = 1e-13;
    for (const Curve& row : all_curves())
        for (const auto& one : kernels::cases_of(row)) {
            size_t invertible = 0;
            for (int i = -80; i <= 80; ++i) {
                const double x = std::exp2(i / 4.0 + 0.01), y = curve_reference(one.numbers, x);
                const double below = curve_reference(one.numbers, x * (1 - close));
                const double above = curve_reference(one.numbers, x * (1 + close));
                if (!(below > 0 && above < 1 && y - below > noise && above - y > noise))
                    continue;
                ++invertible;
                const auto found = inverse(one.numbers, y);
                ASSERT_TRUE(found.has_value()) << one.what << " at " << x;
                EXPECT_NEAR(*found / x, 1, close) << one.what << " at " << x;
            }
            EXPECT_GT(invertible, one.defaults ? 30u : 0u) << one.what;
        }
}

TEST(Inverse, OfTheCurvesOfHdrFlip) {
    const CurveValues values = curve_values(*find_curve("aces"), {}, true);
    EXPECT_NEAR(inverse(find_curve("aces")->make(values), 0.85).value_or(0), 2.11887312, 1e-6);
    EXPECT_NEAR(inverse(curve("hable"), 0.85).value_or(0), 3.12774992, 1e-6);
    EXPECT_NEAR(inverse(curve("reinhard"), 0.85).value_or(0), 17.0 / 3, 1e-12);
}

TEST(Inverse, IsTheLargestSolution) {
    // 1.8 x^2 + 1.4 x over 1.8 x^2 + 0.5 x + 1.5 is 1 at 5/3 alone, 1.06 on both sides of its top.
    EXPECT_NEAR(inverse(curve("steve-b"), 1).value_or(0), 5.0 / 3, 1e-12);
    const double falling = inverse(curve("steve-b"), 1.06).value_or(0);
    EXPECT_GT(falling, 3.7);
    EXPECT_NEAR(curve_reference(curve("steve-b"), falling), 1.06, 1e-12);
    EXPECT_FALSE(inverse(curve("steve-b"), 1.07).has_value());
    EXPECT_NEAR(inverse(curve("filmic-alu"), 0).value_or(0), 0.004, 1e-12);
}

TEST(Inverse, OfWhatIsNeverReached) {
    for (const char* name : {"reinhard", "steve-a"})
        EXPECT_FALSE(inverse(curve(name), 1).has_value()) << name;
    for (const char* name : {"exponential", "uchimura", "neutral", "agx", "drago"})
        EXPECT_FALSE(inverse(curve(name), 1.01).has_value()) << name;
    for (const Curve& row : all_curves())
        EXPECT_FALSE(inverse(curve(row.name), -0.5).has_value()) << row.name;
}

TEST(Inverse, OfBlackIsWhereItEnds) {
    for (const char* name : {"linear", "logarithmic", "drago", "lottes", "uchimura"})
        EXPECT_NEAR(inverse(curve(name), 0).value_or(1), 0, 1e-100) << name;
}

TEST(Inverse, OfAPlateauIsItsStart) {
    EXPECT_NEAR(inverse(curve("agx"), curve_reference(curve("agx"), 1e6)).value_or(0),
                std::exp2(4.026069), 1e-2);
    EXPECT_NEAR(inverse(curve("drago"), 1).value_or(0), 5, 1e-9);
}

} // namespace
} // namespace tonetool::tonemap
