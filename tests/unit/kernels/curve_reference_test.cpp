// SPDX-License-Identifier: BSD-3-Clause
// The reference implementations against numbers worked out from the published formulas by other
// means, and against values that the sources themselves give.
#include "kernels/curve_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kernels/tone_curve.h"
#include "tonemap/curves.h"

namespace tonetool::kernels {
namespace {

constexpr double kExact = 1e-11; // typed with 12 digits

CurveNumbers curve(const char* name, const std::map<std::string, double>& given = {}) {
    const tonemap::Curve& row = *tonemap::find_curve(name);
    return row.make(tonemap::curve_values(row, given, false));
}

double at(double x, const char* name, const std::map<std::string, double>& given = {}) {
    return curve_reference(curve(name, given), x);
}

TEST(CurveReference, OldCurves) {
    EXPECT_EQ(at(0.3, "linear"), 0.3);
    EXPECT_NEAR(at(1, "logarithmic"), 0.386852807235, kExact);
    EXPECT_NEAR(at(5, "logarithmic"), 1, kExact);
    EXPECT_NEAR(at(1, "exponential"), 0.181269246922, kExact);
    EXPECT_NEAR(at(5, "exponential"), 1 - std::exp(-1), kExact);
    EXPECT_NEAR(at(0.25, "reinhard"), 0.2, kExact);
    EXPECT_NEAR(at(5, "reinhard-extended"), 1, kExact);
    EXPECT_NEAR(at(1, "reinhard-extended"), 0.52, kExact);
}

TEST(CurveReference, DragoHasItsSampleValues) {
    const struct {
        double white, x, y;
    } samples[] = {{10, 0.18, 0.09733},    {10, 1, 0.35096},    {10, 5, 0.79114},
                   {100, 0.18, 0.06164},   {100, 1, 0.22293},   {100, 5, 0.50064},
                   {10000, 0.18, 0.04300}, {10000, 1, 0.16155}, {10000, 5, 0.37086}};
    for (const auto& s : samples)
        EXPECT_NEAR(at(s.x, "drago", {{"white", s.white}, {"bias", 0.85}}), s.y, 5e-6);
}

// A product in place of the power, as in a shader in circulation, gives 1.70 at bias 0.85.
TEST(CurveReference, DragoMakesWhiteOneForEveryBias) {
    for (double white : {1e-3, 0.5, 5.0, 1e4})
        for (double bias : {0.01, 0.5, 0.7, 0.85, 0.95, 1.0}) {
            const std::map<std::string, double> given = {{"white", white}, {"bias", bias}};
            EXPECT_NEAR(at(white, "drago", given), 1, 1e-12);
            EXPECT_EQ(at(0, "drago", given), 0);
        }
    // The formula itself falls above white here, to 0.63 at 1e6 times white.
    EXPECT_NEAR(at(1e10, "drago", {{"white", 1e4}, {"bias", 0.7}}), 1, 1e-12);
    EXPECT_GT(at(1, "drago", {{"bias", 0.7}}), at(1, "drago", {{"bias", 0.85}}));
    // Bias 1 is a plain logarithm.
    EXPECT_NEAR(at(3, "drago", {{"white", 10}, {"bias", 1}}), std::log(4) / std::log(11), kExact);
}

TEST(CurveReference, FilmicCurves) {
    EXPECT_NEAR(at(0.18, "filmic-alu"), 0.225399712683, kExact);
    EXPECT_EQ(at(0.004, "filmic-alu"), 0);
    EXPECT_NEAR(at(0.18, "uncharted2"), 0.0998567837103, kExact);
    EXPECT_NEAR(at(1, "uncharted2"), 0.462526101757, kExact);
    EXPECT_NEAR(at(11.2, "uncharted2"), 1, kExact);
    EXPECT_NEAR(at(0, "hejl2015"), -0.000749272456011, kExact);
    EXPECT_NEAR(at(0.18, "hejl2015"), 0.247142902074, kExact);
    EXPECT_NEAR(at(1, "hejl2015", {{"white", 1.5}}), 0.890577107182, kExact);
    EXPECT_NEAR(at(5, "hejl2015"), 1, kExact);
}

const std::map<std::string, double> kHablesOwn = {{"shoulder", 0.15}, {"linear", 0.5},
                                                  {"angle", 0.1},     {"toe", 0.2},
                                                  {"toenum", 0.02},   {"toeden", 0.3}};

TEST(CurveReference, HableIsTheGeneralFormulaWithAnExposureOfTwo) {
    EXPECT_NEAR(at(4, "uncharted2", kHablesOwn), 0.713238010973, kExact);
    // HDR-FLIP's constants are rounded to six digits.
    for (double x : {0.01, 0.18, 1.0, 5.6, 100.0})
        EXPECT_NEAR(at(x, "hable") / at(2 * x, "uncharted2", kHablesOwn), 1, 3e-5);
}

TEST(CurveReference, SteveMsCurves) {
    EXPECT_NEAR(at(5.0 / 3.0, "steve-b"), 1, 1e-15);
    EXPECT_NEAR(at(3.69, "steve-b"), 1.0654, 5e-5);
    EXPECT_GT(at(3.69, "steve-b"), at(3.5, "steve-b"));
    EXPECT_GT(at(3.69, "steve-b"), at(3.9, "steve-b"));
    EXPECT_NEAR(at(1e-9, "steve-b"), 0.9333e-9, 1e-13);
    EXPECT_NEAR(at(1e-9, "steve-a"), 0.2e-9, 1e-13);
    EXPECT_LT(at(1e6, "steve-a"), 1);
}

TEST(CurveReference, Aces) {
    EXPECT_NEAR(at(7.2417, "aces"), 1, 1e-6);
    EXPECT_NEAR(at(1e12, "aces"), 1.0329, 5e-5);
    EXPECT_NEAR(at(2.11887312, "aces", {{"prescale", 0.6}}), 0.85, 1e-7);
}

TEST(CurveReference, Lottes) {
    EXPECT_NEAR(at(0.18, "lottes"), 0.267, 1e-14);
    EXPECT_NEAR(at(8, "lottes"), 1, 1e-14);
    EXPECT_EQ(at(0, "lottes"), 0);
    EXPECT_NEAR(curve("lottes").p[2], 1.0730397, 5e-8);
    EXPECT_NEAR(curve("lottes").p[3], 0.1674199, 5e-8);
}

TEST(CurveReference, Uchimura) {
    const struct {
        double x, y;
    } samples[] = {{0, 0},     {0.05, 0.0332064103158}, {0.1, 0.0869875066987}, {0.22, 0.22},
                   {0.5, 0.5}, {1, 0.827832421532},     {4, 0.999716852726}};
    for (const auto& s : samples)
        EXPECT_NEAR(at(s.x, "uchimura"), s.y, kExact) << s.x;
    EXPECT_NEAR(at(0.1, "uchimura", {{"pedestal", 0.02}}), 0.0983473864884, kExact);
    EXPECT_NEAR(at(2, "uchimura", {{"maximum", 2}, {"contrast", 1.2}, {"length", 0.3}}),
                1.65553950390, kExact);
}

TEST(CurveReference, FilmHasItsSampleValues) {
    const struct {
        double x, y;
    } samples[] = {{0.045, 0.00374}, {0.18, 0.0316}, {0.72, 0.268}, {2.88, 0.695}};
    for (const auto& s : samples)
        EXPECT_NEAR(at(s.x, "film") / s.y, 1, 2e-3) << s.x;
    EXPECT_NEAR(at(0.18, "film"), std::pow(10, -1.5), kExact);
    EXPECT_NEAR(at(0, "film"), 1e-3, kExact);
    // The slope of the density at the middle is gamma; dmin is taken out again.
    const double step = 1e-5;
    const std::map<std::string, double> given = {
        {"middle", 0.3}, {"gamma", 2.5}, {"dmin", 0.2}, {"dmax", 2.9}};
    const double above = std::log10(at(0.3 * std::pow(10, step), "film", given));
    const double below = std::log10(at(0.3 * std::pow(10, -step), "film", given));
    EXPECT_NEAR((above - below) / (2 * step), 2.5, 1e-6);
    EXPECT_NEAR(at(1e12, "film", given), 1, 1e-9);
}

TEST(CurveReference, CurvesThatMixChannels) {
    using Color = std::array<double, 3>;
    const struct {
        const char* name;
        Color x, y;
    } samples[] = {
        {"aces-hill", {0.18, 0.18, 0.18}, {0.105591247229, 0.105591247229, 0.105590191316}},
        {"aces-hill", {0.9, 0.2, 0.05}, {0.62353082669, 0.141354306632, 0.0277878282792}},
        {"aces-hill", {6, 1.5, 0.3}, {1.0144672224, 0.772796024562, 0.427512715011}},
        {"aces-hill", {0.02, 0.03, 0.4}, {-0.00568872926413, 0.00613530418132, 0.266204580816}},
        {"agx", {0.18, 0.18, 0.18}, {0.214467430707, 0.214532668621, 0.214536728268}},
        {"agx", {0.9, 0.2, 0.05}, {0.622982603076, 0.251069511197, 0.103239801768}},
        {"agx", {6, 1.5, 0.3}, {0.963398865152, 0.710103189719, 0.445576759567}},
        {"agx", {0.02, 0.03, 0.4}, {0.0467528423603, 0.0590935105198, 0.410165947507}},
        {"neutral", {0.18, 0.18, 0.18}, {0.14, 0.14, 0.14}},
        {"neutral", {0.9, 0.2, 0.05}, {0.833345388788, 0.16269600192, 0.0189854190193}},
        {"neutral", {6, 1.5, 0.3}, {0.989411764706, 0.561453401453, 0.447331171252}},
        {"neutral", {0.02, 0.03, 0.4}, {0.0025, 0.0125, 0.3825}}};
    CurveUse use;
    use.clamp = false;
    use.on_luminance = true; // ignored
    for (const auto& s : samples) {
        const Color y = curve_reference(curve(s.name), use, s.x);
        for (size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(y[c], s.y[c], kExact) << s.name << " " << s.x[0] << " " << c;
    }
}

TEST(CurveReference, OnLuminanceKeepsRatios) {
    CurveUse use;
    use.on_luminance = true;
    use.weights = {0.25, 0.5, 0.25};
    // Luminance 1 becomes 1/2.
    EXPECT_EQ(curve_reference(curve("reinhard"), use, {2, 0.5, 1}),
              (std::array<double, 3>{1, 0.25, 0.5}));
    use.saturation = 2;
    EXPECT_EQ(curve_reference(curve("reinhard"), use, {1, 0.5, 2}),
              (std::array<double, 3>{0.5, 0.125, 1}))
        << "clamped: 2^2 / 2";
    use.saturation = 0;
    EXPECT_EQ(curve_reference(curve("reinhard"), use, {0, 1, 2}),
              (std::array<double, 3>{0.5, 0.5, 0.5}));
    EXPECT_EQ(curve_reference(curve("reinhard"), use, {0, 0, 0}), (std::array<double, 3>{0, 0, 0}));
}

TEST(CurveReference, OfAPixelIsThatOfAGrey) {
    CurveUse use;
    use.clamp = false;
    for (const auto& row : tonemap::all_curves()) {
        const CurveNumbers numbers = curve(row.name);
        for (double x : {0.001, 0.18, 1.0, 30.0}) {
            const auto rgb = curve_reference(numbers, use, {x, x, x});
            const double lum = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
            EXPECT_NEAR(lum, curve_reference(numbers, x), 1e-12 * std::max(1.0, lum)) << row.name;
        }
    }
}

} // namespace
} // namespace tonetool::kernels
