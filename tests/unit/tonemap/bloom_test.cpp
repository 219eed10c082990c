// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/bloom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <vector>

#include "schedules.h"

namespace tonetool::tonemap {
namespace {

const kernels::ParallelFor kInOrder = kernels::in_order(), kBackwards = kernels::backwards();

// Of a function per steradian over the hemisphere about the light: finely near the light, where the
// core is 0.02 degrees wide.
double over_hemisphere(const std::function<double(double)>& function) {
    constexpr double steps = 400000;
    double sum = 0;
    for (int i = 0; i < int(steps); ++i) {
        // The angle is the cube of a parameter that goes from 0 to the cube root of 90.
        const double length = std::cbrt(90.0) / steps, at = (i + 0.5) * length;
        const double angle = at * at * at, radians = angle * M_PI / 180;
        sum += function(angle) * 2 * M_PI * std::sin(radians) * 3 * at * at * length * M_PI / 180;
    }
    return sum;
}

// The article's constants, each of which is in one of these, have three digits.
TEST(Bloom, EachPartOfTheEyesFunctionAddsUpToOne) {
    constexpr double about = 0.9996, digits = 1e-3;
    EXPECT_NEAR(over_hemisphere(glare_core), about, digits);
    EXPECT_NEAR(over_hemisphere(glare_inverse_cube), about, digits);
    EXPECT_NEAR(over_hemisphere(glare_inverse_square), about, digits);
    for (double wavelength : kWavelengths)
        EXPECT_NEAR(over_hemisphere([&](double t) { return glare_halo(t, wavelength); }), about,
                    digits)
            << wavelength;
}

// What all of a function's pixels hold, not only those of a quadrant.
double sum_of(const PointSpread& spread) {
    double sum = 0;
    for (int y = 0; y < spread.height; ++y)
        for (int x = 0; x < spread.width; ++x)
            sum += (x > 0 ? 2 : 1) * (y > 0 ? 2 : 1) * spread.at(x, y);
    return sum;
}

TEST(Bloom, FunctionsAddUpToOneAndEndAtTheirRadius) {
    const SpreadSize size{64, 64, 20.5};
    for (Vision vision : {Vision::Photopic, Vision::Mesopic, Vision::Scotopic}) {
        const PointSpread spread = eye_spread(vision, 549, 0.2, size, kInOrder);
        EXPECT_EQ(spread.width, 21);
        EXPECT_NEAR(sum_of(spread), 1, 1e-12);
        EXPECT_GT(spread.at(20, 4), 0);
        EXPECT_EQ(spread.at(20, 5), 0); // 20.6 pixels away
        EXPECT_EQ(spread.at(13, 7), spread.at(7, 13));
    }
    EXPECT_NEAR(sum_of(gaussian_spread(4, size, kInOrder)), 1, 1e-12);
}

TEST(Bloom, LightThatLeavesTheImageIsMissing) {
    const double whole = sum_of(eye_spread(Vision::Photopic, 549, 0.2, {64, 64, 60}, kInOrder));
    const PointSpread low = eye_spread(Vision::Photopic, 549, 0.2, {64, 16, 60}, kInOrder);
    EXPECT_NEAR(whole, 1, 1e-12);
    EXPECT_EQ(low.height, 16);
    EXPECT_LT(sum_of(low), 0.999);
    EXPECT_EQ(low.at(9, 3),
              eye_spread(Vision::Photopic, 549, 0.2, {64, 64, 60}, kInOrder).at(9, 3));
}

TEST(Bloom, NightHasMoreGlareAndAHalo) {
    const SpreadSize size{400, 400, 300};
    constexpr double pixel = 0.05;
    const PointSpread day = eye_spread(Vision::Photopic, 549, pixel, size, kInOrder);
    const PointSpread night = eye_spread(Vision::Scotopic, 549, pixel, size, kInOrder);
    EXPECT_LT(night.at(0, 0), day.at(0, 0));
    const int halo = int(std::lround(3 * 549 / 568. / pixel)); // in pixels
    EXPECT_GT(night.at(halo, 0), 1.2 * night.at(halo - 12, 0));
    EXPECT_LT(day.at(halo, 0), day.at(halo - 12, 0));
}

TEST(Bloom, APointOfLightBecomesTheFunction) {
    constexpr int width = 45, height = 31, x0 = 12, y0 = 20;
    const PointSpread spread =
        eye_spread(Vision::Photopic, 549, 0.3, {width, height, 45}, kInOrder);
    const Spreading spreading(spread, width, height, kInOrder);
    std::vector<float> plane(size_t(width) * height, 0.0f);
    constexpr float light = 5000;
    plane[size_t(y0) * width + x0] = light;
    spreading.apply(plane.data(), kInOrder);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double wanted = light * spread.at(std::abs(x - x0), std::abs(y - y0));
            // A float's rounding, and a transform's of the largest.
            EXPECT_NEAR(double(plane[size_t(y) * width + x]), wanted, 1e-7 * wanted + 1e-11 * light)
                << x << " " << y;
        }
}

TEST(Bloom, SumsOfLightsAreSumsOfFunctions) {
    constexpr int width = 23, height = 40;
    const PointSpread spread = gaussian_spread(3, {width, height, 15}, kInOrder);
    const Spreading spreading(spread, width, height, kInOrder);
    std::vector<float> plane(size_t(width) * height);
    for (size_t i = 0; i < plane.size(); ++i)
        plane[i] = i % 7 == 0 ? float(i) : 0.0f;
    const std::vector<float> lights = plane;
    spreading.apply(plane.data(), kInOrder);
    for (int y : {0, 17, height - 1})
        for (int x : {0, 11, width - 1}) {
            double wanted = 0;
            for (int v = 0; v < height; ++v)
                for (int u = 0; u < width; ++u)
                    if (std::abs(u - x) < spread.width && std::abs(v - y) < spread.height)
                        wanted += double(lights[size_t(v) * width + u]) *
                                  spread.at(std::abs(u - x), std::abs(v - y));
            EXPECT_NEAR(double(plane[size_t(y) * width + x]) / wanted, 1, 1e-6) << x << " " << y;
        }
}

TEST(Bloom, BitsDoNotDependOnTheOrderOfTasks) {
    const SpreadSize size{130, 70, 64};
    const PointSpread spread = eye_spread(Vision::Mesopic, 611, 0.1, size, kInOrder);
    EXPECT_EQ(spread.share, eye_spread(Vision::Mesopic, 611, 0.1, size, kBackwards).share);
    std::vector<float> plane(130 * 70);
    for (size_t i = 0; i < plane.size(); ++i)
        plane[i] = float(i % 97) * float(i % 13);
    std::vector<float> other = plane;
    Spreading(spread, 130, 70, kInOrder).apply(plane.data(), kInOrder);
    Spreading(spread, 130, 70, kBackwards).apply(other.data(), kBackwards);
    EXPECT_EQ(plane, other);
}

// Of the article's figures: the core is 0.02 degrees wide.
TEST(Bloom, LargePixelsKeepMostOfTheirLight) {
    const double large =
        eye_spread(Vision::Photopic, 549, 0.0833, {480, 480, 360}, kInOrder).at(0, 0);
    const double small =
        eye_spread(Vision::Photopic, 549, 0.0208, {1920, 1920, 1440}, kInOrder).at(0, 0);
    EXPECT_NEAR(large, 0.63, 0.01);
    EXPECT_NEAR(small, 0.18, 0.01);
}

} // namespace
} // namespace tonetool::tonemap
