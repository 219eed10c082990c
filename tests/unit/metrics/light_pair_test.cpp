// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/light_pair.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <random>

namespace tonetool::metrics {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

struct Picture {
    size_t width, height, channels;
    std::vector<float> values;

    Picture(size_t w, size_t h, size_t c, float value)
        : width(w),
          height(h),
          channels(c),
          values(w * h * c, value) {}
    float& at(size_t x, size_t y, size_t c = 0) { return values[(y * width + x) * channels + c]; }
    double at(size_t x, size_t y, size_t c) const {
        return double(values[(y * width + x) * channels + c]);
    }
    std::vector<float> row(size_t y) const {
        const auto begin = values.begin() + std::ptrdiff_t(y * width * channels);
        return {begin, begin + std::ptrdiff_t(width * channels)};
    }
    void scale(size_t x, size_t y, size_t size, float factor) {
        for (size_t j = y; j < y + size; ++j)
            for (size_t i = x; i < x + size; ++i)
                for (size_t c = 0; c < channels; ++c)
                    at(i, j, c) *= factor;
    }
};

LightPair::Result result_of(const Picture& a, const Picture& b) {
    LightPair pair(int64_t(a.width), int64_t(a.height), a.channels);
    for (size_t y = 0; y < a.height; ++y)
        pair.add(int64_t(y), pair.scan(a.row(y), b.row(y)));
    return pair.result();
}

Picture noise(size_t width, size_t height, size_t channels, unsigned seed) {
    Picture picture(width, height, channels, 0);
    std::mt19937 random(seed);
    std::gamma_distribution<float> grain(16, 1 / 16.0f);
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x)
            for (size_t c = 0; c < channels; ++c)
                picture.at(x, y, c) =
                    (0.2f + 0.01f * float(x) + (y > 20 ? 1.0f : 0.0f)) * grain(random);
    return picture;
}

TEST(LightPair, AnExposureIsAGainOfAllBlocks) {
    const Picture a(48, 16, 1, 1), b(48, 16, 1, 2);
    const LightPair::Result result = result_of(a, b);
    EXPECT_NEAR(result.gain, std::log2(2.001 / 1.001), 1e-6); // with the floor of 0.1 %
    EXPECT_EQ(result.blocks, 1);
    EXPECT_NEAR(result_of(b, a).gain, std::log2(1.002 / 2.002), 1e-6);
    EXPECT_EQ(result_of(a, a).gain, 0);
    EXPECT_EQ(result_of(a, a).blocks, 0);
}

TEST(LightPair, OneBlockIsNoGain) {
    const Picture a(48, 32, 3, 1);
    Picture b = a;
    b.scale(32, 16, 16, 4);
    const LightPair::Result result = result_of(a, b);
    EXPECT_EQ(result.gain, 0);
    EXPECT_NEAR(result.blocks, 1 / 6.0, 1e-12);
    EXPECT_EQ(result.x, 32);
    EXPECT_EQ(result.y, 16);
}

// 5 % of the brighter one and 2 % of the mean of the approved one.
TEST(LightPair, WhatABlockMayDiffer) {
    const Picture a(16, 16, 1, 1);
    EXPECT_EQ(result_of(a, Picture(16, 16, 1, 1.07f)).blocks, 0); // 0.0535 + 0.02
    EXPECT_EQ(result_of(a, Picture(16, 16, 1, 1.08f)).blocks, 1); // 0.054 + 0.02
    // No neighbours differ: 1.1 for 1 is too much.
    Picture stripes = a, checked = a;
    for (size_t y = 0; y < 16; ++y)
        for (size_t x = 0; x < 16; ++x) {
            stripes.at(x, y) = y % 2 == 0 ? 0.0f : 2.2f;
            checked.at(x, y) = (x + y) % 2 == 0 ? 0.0f : 2.2f;
        }
    EXPECT_EQ(result_of(a, stripes).blocks, 1);
    // All neighbours differ by 2.2: six standard errors are 6 * 2.2 / sqrt(2) / 16 = 0.583.
    EXPECT_EQ(result_of(a, checked).blocks, 0);
    for (const float more : {0.45f, 0.5f}) {
        Picture brighter = checked;
        for (float& value : brighter.values)
            value += more;
        EXPECT_EQ(result_of(a, brighter).blocks, more < 0.48f ? 0 : 1);
    }
}

TEST(LightPair, PixelsThatAreNotFiniteCountInNeither) {
    Picture a(32, 16, 3, 1), b = a;
    for (size_t y = 0; y < 8; ++y) {
        a.at(3, y, 1) = kNan;
        a.at(9, y, 0) = 1000;
        b.at(9, y, 2) = kInf;
        b.at(20, y, 0) = -kInf;
    }
    const LightPair::Result result = result_of(a, b);
    EXPECT_EQ(result.gain, 0);
    EXPECT_EQ(result.blocks, 0);
    const Picture none(32, 16, 3, kNan);
    EXPECT_EQ(result_of(none, a).gain, 0);
    EXPECT_EQ(result_of(none, none).blocks, 0);
}

TEST(LightPair, PicturesSmallerThanABlock) {
    for (const size_t size : {1U, 2U, 15U}) {
        const Picture a(size, size, 3, 0.5f), b(size, size, 3, 1);
        EXPECT_NEAR(result_of(a, b).gain, 1, 0.01) << size;
        EXPECT_EQ(result_of(a, b).blocks, 1) << size;
        EXPECT_EQ(result_of(a, a).blocks, 0) << size;
    }
    EXPECT_EQ(LightPair().result().blocks, 0);
}

// ---- the formulas, by plain loops over blocks

struct Plain {
    double a = 0, b = 0, error = 0;
};

Plain plain_block(const Picture& a, const Picture& b, size_t left, size_t top, size_t c) {
    double sum_a = 0, sum_b = 0, squares = 0;
    for (size_t y = top; y < top + 16; ++y)
        for (size_t x = left; x < left + 16; ++x) {
            const size_t from = std::min(x, a.width - 2); // the last has the difference before it
            const double da = a.at(from + 1, y, c) - a.at(from, y, c);
            const double db = b.at(from + 1, y, c) - b.at(from, y, c);
            sum_a += a.at(x, y, c);
            sum_b += b.at(x, y, c);
            squares += da * da / 2 + db * db / 2;
        }
    return {sum_a / 256, sum_b / 256, std::sqrt(squares / 256) / 16};
}

LightPair::Result plain_result(const Picture& a, const Picture& b) {
    std::vector<std::vector<Plain>> blocks;
    double mean_a = 0, mean = 0;
    for (size_t top = 0; top + 16 <= a.height; top += 16)
        for (size_t left = 0; left + 16 <= a.width; left += 16) {
            std::vector<Plain>& block = blocks.emplace_back();
            for (size_t c = 0; c < a.channels; ++c) {
                block.push_back(plain_block(a, b, left, top, c));
                mean_a += block.back().a;
                mean += block.back().a + block.back().b;
            }
        }
    const double count = double(blocks.size() * a.channels);
    mean_a /= count;
    mean /= count;
    double off = 0;
    std::vector<double> stops;
    for (const std::vector<Plain>& block : blocks) {
        double sum_a = 0, sum_b = 0;
        bool differs = false;
        for (const Plain& one : block) {
            const double floor = 0.05 * std::max(one.a, one.b) + 0.02 * mean_a + 1e-6;
            differs = differs || std::abs(one.a - one.b) > std::max(6 * one.error, floor);
            sum_a += one.a / double(a.channels);
            sum_b += one.b / double(a.channels);
        }
        off += differs;
        if (sum_a + sum_b > 0.02 * mean)
            stops.push_back(
                std::log2((sum_b + 1e-3 * mean_a + 1e-7) / (sum_a + 1e-3 * mean_a + 1e-7)));
    }
    std::sort(stops.begin(), stops.end());
    const double middle = stops[stops.size() / 2];
    double all_a = 1e-6 * double(a.values.size()), all_b = all_a;
    for (size_t i = 0; i < a.values.size(); ++i) {
        all_a += std::abs(double(a.values[i]));
        all_b += std::abs(double(b.values[i]));
    }
    const double sum = std::log2(all_b / all_a);
    LightPair::Result result;
    result.blocks = off / double(blocks.size());
    result.gain = middle * sum <= 0 ? 0 : std::abs(middle) < std::abs(sum) ? middle : sum;
    return result;
}

TEST(LightPair, TheFormulasByPlainLoops) {
    for (const size_t width : {80U, 85U}) // what is left over counts in the sums
        for (const float factor : {1.0f, 1.06f, 0.6f}) {
            const Picture a = noise(width, 53, 3, 1);
            Picture b = noise(width, 53, 3, 2);
            for (float& value : b.values)
                value *= factor;
            b.scale(16, 16, 16, 1.5f);
            b.scale(48, 0, 16, 0.5f);
            const LightPair::Result found = result_of(a, b), plain = plain_result(a, b);
            EXPECT_NEAR(found.gain, plain.gain, 1e-9) << width << " " << factor;
            EXPECT_EQ(found.blocks, plain.blocks) << width << " " << factor;
            EXPECT_GT(plain.blocks, 0);
        }
}

} // namespace
} // namespace tonetool::metrics
