// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/detail_scan.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace tonetool::metrics {
namespace {

std::vector<StepHistogram::Code> codes_of(const std::vector<float>& values) {
    std::vector<StepHistogram::Code> codes;
    for (const float value : values)
        codes.push_back(StepHistogram::code(value));
    return codes;
}

// By sorting: the smallest value that has this share of all at or below it.
double sorted_quantile(std::vector<float> values, double share) {
    if (values.empty())
        return 0;
    std::sort(values.begin(), values.end());
    const auto rank = size_t(std::max(std::ceil(share * double(values.size())), 1.0));
    return double(values[rank - 1]);
}

TEST(StepHistogram, QuantilesAreThoseOfTheSortedValues) {
    std::mt19937 random(1);
    std::lognormal_distribution<float> wide(0, 3);
    std::vector<float> values;
    for (int i = 0; i < 20001; ++i)
        values.push_back(wide(random));
    StepHistogram histogram;
    histogram.add(codes_of(values));
    for (const double share : {0.01, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99}) {
        const double expected = sorted_quantile(values, share);
        EXPECT_NEAR(histogram.quantile(share), expected, 0.01 * expected) << share;
    }
}

TEST(StepHistogram, OrderDoesNotMatterAndZerosCount) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> any(0, 100);
    std::vector<float> values(1000);
    std::generate(values.begin(), values.end(), [&] { return any(random); });
    StepHistogram once, parts;
    once.add(codes_of(values));
    std::shuffle(values.begin(), values.end(), random);
    parts.add(codes_of({values.begin(), values.begin() + 300}));
    parts.add({});
    parts.add(codes_of({values.begin() + 300, values.end()}));
    EXPECT_EQ(once.quantile(0.5), parts.quantile(0.5));
    EXPECT_EQ(once.quantile(0.95), parts.quantile(0.95));
    StepHistogram zeros;
    EXPECT_EQ(zeros.quantile(0.5), 0);
    zeros.add(codes_of({0, -0.0f, 0, 8, 8}));
    EXPECT_EQ(zeros.quantile(0.5), 0);
    EXPECT_NEAR(zeros.quantile(0.8), 8, 0.08);
}

// ---- against a plain double loop

struct Picture {
    size_t width, height;
    std::vector<float> light;
    float at(size_t x, size_t y) const { return std::max(light[y * width + x], 0.0f); }
    double stops(size_t x, size_t y) const { return std::log2(std::max(at(x, y), 1e-6f)); }
    bool is_lit(size_t x, size_t y) const { return at(x, y) > 1e-6f; }
};

Picture picture_of(size_t width, size_t height, unsigned seed) {
    Picture picture{width, height, std::vector<float>(width * height)};
    std::mt19937 random(seed);
    std::gamma_distribution<float> noise(4, 0.25f);
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x) {
            const float wall = 1 + 0.5f * std::sin(0.2f * float(x)) + 0.01f * float(y);
            picture.light[y * width + x] = wall * noise(random);
        }
    // A dark place, pixels that are negative, and a lamp.
    for (size_t y = height / 2; y < std::min(height, height / 2 + 4); ++y)
        for (size_t x = 0; x < width / 4; ++x)
            picture.light[y * width + x] = x % 3 == 0 ? -0.1f : 0.0f;
    picture.light[width / 2] = 5000;
    return picture;
}

DetailScan scan_of(const Picture& picture) {
    std::vector<LightRow> rows;
    for (size_t y = 0; y < picture.height; ++y) {
        const auto begin = picture.light.begin() + std::ptrdiff_t(y * picture.width);
        rows.push_back(light_row({begin, begin + std::ptrdiff_t(picture.width)}));
    }
    DetailScan scan;
    for (int64_t y = 0; y < int64_t(rows.size()); ++y) {
        const LightRow* around[2 * DetailScan::kRadius + 1] = {};
        for (int64_t i = -DetailScan::kRadius; i <= DetailScan::kRadius; ++i)
            if (y + i >= 0 && y + i < int64_t(rows.size()))
                around[i + DetailScan::kRadius] = &rows[size_t(y + i)];
        scan.add(DetailScan::scan(around, y));
    }
    return scan;
}

struct Detail {
    std::vector<float> fine, coarse, across, down;
};

double block_stops(const Picture& p, size_t x, size_t y) {
    const float sum = p.at(2 * x, 2 * y) + p.at(2 * x + 1, 2 * y) + p.at(2 * x, 2 * y + 1) +
                      p.at(2 * x + 1, 2 * y + 1);
    return std::log2(std::max(sum / 4, 1e-6f));
}

Detail detail_of(const Picture& p) {
    Detail detail;
    for (size_t y = 0; y < p.height; ++y)
        for (size_t x = 0; x < p.width; ++x) {
            if (!p.is_lit(x, y))
                continue;
            const double here = p.stops(x, y);
            if (x > 0)
                detail.across.push_back(float(std::abs(here - p.stops(x - 1, y))));
            if (y > 0)
                detail.down.push_back(float(std::abs(here - p.stops(x, y - 1))));
            if (x > 0 && y > 0 && x + 1 < p.width && y + 1 < p.height)
                detail.fine.push_back(
                    float(std::abs(here - (p.stops(x - 1, y) + p.stops(x + 1, y) +
                                           p.stops(x, y - 1) + p.stops(x, y + 1)) /
                                              4)));
        }
    for (size_t y = 1; y + 1 < p.height / 2; ++y)
        for (size_t x = 1; x + 1 < p.width / 2; ++x)
            detail.coarse.push_back(float(std::abs(
                block_stops(p, x, y) - (block_stops(p, x - 1, y) + block_stops(p, x + 1, y) +
                                        block_stops(p, x, y - 1) + block_stops(p, x, y + 1)) /
                                           4)));
    return detail;
}

void expect_same(size_t width, size_t height) {
    const Picture picture = picture_of(width, height, unsigned(width * height));
    const DetailScan scan = scan_of(picture);
    const Detail plain = detail_of(picture);
    const auto expect_median = [](double found, const std::vector<float>& values) {
        const double expected = sorted_quantile(values, 0.5);
        EXPECT_NEAR(found, expected, 0.01 * expected);
    };
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
    expect_median(scan.fine(), plain.fine);
    expect_median(scan.coarse(), plain.coarse);
    expect_median(scan.across(), plain.across);
    expect_median(scan.down(), plain.down);
}

TEST(DetailScan, MediansOfAPlainDoubleLoop) {
    expect_same(97, 53);
    expect_same(64, 48);
    expect_same(33, 34);
    expect_same(8, 7);
}

TEST(DetailScan, WhatIsTooSmallHasNone) {
    for (const auto& [width, height] : {std::pair<size_t, size_t>{1, 1}, {1, 9}, {9, 1}, {2, 2}}) {
        const DetailScan scan =
            scan_of(Picture{width, height, std::vector<float>(width * height, 1)});
        EXPECT_EQ(scan.fine(), 0);
        EXPECT_EQ(scan.coarse(), 0);
    }
    EXPECT_GT(scan_of(picture_of(9, 1, 1)).across(), 0);
    EXPECT_EQ(scan_of(picture_of(9, 1, 1)).down(), 0);
    EXPECT_EQ(scan_of(Picture{32, 32, std::vector<float>(32 * 32, 0)}).fine(), 0);
}

// A blur along one axis shows in the ratio of both.
TEST(DetailScan, ABlurAcrossLowersTheDifferencesAcross) {
    Picture picture = picture_of(96, 54, 9);
    const DetailScan sharp = scan_of(picture);
    const Picture before = picture;
    for (size_t y = 0; y < picture.height; ++y)
        for (size_t x = 1; x + 1 < picture.width; ++x)
            picture.light[y * picture.width + x] =
                (before.at(x - 1, y) + before.at(x, y) + before.at(x + 1, y)) / 3;
    const DetailScan blurred = scan_of(picture);
    EXPECT_NEAR(sharp.across() / sharp.down(), 1, 0.1);
    EXPECT_LT(blurred.across() / blurred.down(), 0.7);
}

} // namespace
} // namespace tonetool::metrics
