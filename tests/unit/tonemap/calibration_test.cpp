// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace tonetool::tonemap {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void serial(int64_t count, const std::function<void(int64_t)>& task) {
    for (int64_t i = 0; i < count; ++i)
        task(i);
}

void backwards(int64_t count, const std::function<void(int64_t)>& task) {
    for (int64_t i = count - 1; i >= 0; --i)
        task(i);
}

std::vector<float> noise(int width, int height) {
    std::mt19937 random(3);
    std::lognormal_distribution<float> value(0, 2);
    std::vector<float> plane(size_t(width) * size_t(height));
    for (float& v : plane)
        v = value(random);
    return plane;
}

std::vector<double> row_of(const LocalMeans& means, int y, int width) {
    std::vector<double> row(static_cast<size_t>(width));
    means.row(y, row.data());
    return row;
}

TEST(AutoKey, IsThePublishedOne) {
    // Values of 1.03 - 2 / (2 + log10(1 + mean)) to five digits.
    const double cases[][2] = {{0, 0.03},     {0.18, 0.06469}, {1, 0.16082},
                               {10, 0.37241}, {100, 0.53054},  {1e4, 0.69667}};
    for (const auto& c : cases)
        EXPECT_NEAR(auto_key(c[0]), c[1], 5e-6) << c[0];
}

TEST(Gain, HasTheArticlesLimits) {
    EXPECT_DOUBLE_EQ(gain(0.18, 0.36), 0.5);
    EXPECT_DOUBLE_EQ(gain(0.18, 0), 180); // a mean of 1e-3 at least
    EXPECT_DOUBLE_EQ(gain(0.18, 1e6), 1e-4);
}

TEST(LocalMeans, OfOneCellAreTheGeometricMeanEverywhere) {
    const std::vector<float> plane = {1, 2, 4, 8, 16, 32};
    const LocalMeans means(plane.data(), 3, 2, 0, 1e-30, serial);
    const double expected = std::pow(2.0, 15.0 / 6);
    EXPECT_NEAR(means.mean(), expected, 1e-14 * expected);
    EXPECT_EQ(means.pixels(), 6);
    for (int y = 0; y < 2; ++y)
        for (double m : row_of(means, y, 3))
            EXPECT_NEAR(m, expected, 1e-14 * expected);
}

TEST(LocalMeans, EpsilonIsAddedToEachLuminance) {
    const std::vector<float> plane = {0, 1};
    const LocalMeans means(plane.data(), 2, 1, 0, 0.25, serial);
    EXPECT_NEAR(means.mean(), std::sqrt(0.25 * 1.25), 1e-15);
}

TEST(LocalMeans, CellsAreMeansOfTheirPixels) {
    // 2 x 2 cells of 2 x 2 pixels: at the middles of cells... there is no pixel, but beyond the
    // outer middles, at the corners, the mean of the cell is held.
    std::vector<float> plane(16);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x)
            plane[size_t(4 * y + x)] = float(1 << (x / 2 + 2 * (y / 2)));
    const LocalMeans means(plane.data(), 4, 4, 1, 1e-30, serial);
    EXPECT_NEAR(row_of(means, 0, 4)[0], 1, 1e-14);
    EXPECT_NEAR(row_of(means, 0, 4)[3], 2, 1e-14);
    EXPECT_NEAR(row_of(means, 3, 4)[0], 4, 1e-14);
    EXPECT_NEAR(row_of(means, 3, 4)[3], 8, 1e-13);
    // A quarter of the way between the middles, in logarithms.
    EXPECT_NEAR(row_of(means, 0, 4)[1], std::exp2(0.25), 1e-14);
    EXPECT_NEAR(row_of(means, 1, 4)[0], std::exp2(2 * 0.25), 1e-14);
    EXPECT_NEAR(row_of(means, 1, 4)[1], std::exp2(3 * 0.25), 1e-14);
}

TEST(LocalMeans, PixelsOnABorderCountForTheirShare) {
    // 3 pixels in 2 cells: the one in the middle is half in either.
    const std::vector<float> plane = {1, 8, 64, 1, 8, 64, 1, 8, 64};
    const LocalMeans means(plane.data(), 3, 3, 1, 1e-30, serial);
    const auto row = row_of(means, 1, 3);
    EXPECT_NEAR(row[0], std::exp2((0 + 0.5 * 3) / 1.5), 1e-12);
    EXPECT_NEAR(row[2], std::exp2((6 + 0.5 * 3) / 1.5), 1e-11);
    EXPECT_NEAR(row[1], 8, 1e-12);
}

TEST(LocalMeans, WhatIsNotANumberIsNotCounted) {
    const std::vector<float> plane = {1, kNan, kNan, kNan, 4, kNan, kNan, kNan,
                                      1, kNan, kNan, kNan, 4, kNan, kNan, kNan};
    const LocalMeans means(plane.data(), 4, 4, 1, 1e-30, serial);
    EXPECT_EQ(means.pixels(), 4);
    EXPECT_NEAR(means.mean(), 2, 1e-14);
    // Cells without a number have the mean of the whole.
    EXPECT_NEAR(row_of(means, 0, 4)[3], 2, 1e-14);
    const std::vector<float> nothing(4, kNan);
    EXPECT_EQ(LocalMeans(nothing.data(), 2, 2, 0, 1e-6, serial).pixels(), 0);
}

TEST(LocalMeans, AMultipleOfTheImageIsAMultipleOfTheMeans) {
    std::vector<float> plane = noise(37, 23);
    const LocalMeans once(plane.data(), 37, 23, 3, 1e-30, serial);
    for (float& v : plane)
        v *= 4;
    const LocalMeans fourfold(plane.data(), 37, 23, 3, 1e-30, serial);
    for (int y = 0; y < 23; ++y) {
        const auto a = row_of(once, y, 37), b = row_of(fourfold, y, 37);
        for (size_t x = 0; x < 37; ++x)
            EXPECT_NEAR(b[x], 4 * a[x], 1e-12 * b[x]); // rounding of logarithms
    }
}

TEST(LocalMeans, DoNotDependOnTheSchedule) {
    const std::vector<float> plane = noise(53, 41);
    for (int level = 0; level <= LocalMeans::most_levels(53, 41); ++level) {
        const LocalMeans a(plane.data(), 53, 41, level, 1e-6, serial);
        const LocalMeans b(plane.data(), 53, 41, level, 1e-6, backwards);
        for (int y = 0; y < 41; ++y)
            EXPECT_EQ(row_of(a, y, 53), row_of(b, y, 53));
    }
}

TEST(LocalMeans, LevelsEndWhereCellsWouldBeNarrowerThanPixels) {
    EXPECT_EQ(LocalMeans::most_levels(1, 1), 0);
    EXPECT_EQ(LocalMeans::most_levels(3, 100), 1);
    EXPECT_EQ(LocalMeans::most_levels(1024, 1024), 10);
    EXPECT_EQ(LocalMeans::most_levels(1920, 1080), 10);
    // At the last level of a square the means are the pixels.
    const std::vector<float> plane = noise(8, 8);
    const LocalMeans means(plane.data(), 8, 8, 3, 1e-30, serial);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            EXPECT_NEAR(row_of(means, y, 8)[size_t(x)], plane[size_t(8 * y + x)],
                        1e-12 * plane[size_t(8 * y + x)]);
}

} // namespace
} // namespace tonetool::tonemap
