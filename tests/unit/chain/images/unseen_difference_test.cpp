// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/unseen_difference.h"

#include <OpenImageIO/imagebufalgo.h>
#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace tonetool::chain {
namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

OIIO::ImageBuf image(OIIO::ROI window, OIIO::TypeDesc type = OIIO::TypeFloat) {
    OIIO::ImageBuf pixels(OIIO::ImageSpec(window, type));
    OIIO::ImageBufAlgo::zero(pixels);
    return pixels;
}

void set(OIIO::ImageBuf& pixels, int x, int y, std::vector<float> values) {
    pixels.setpixel(x, y, 0, values.data(), int(values.size()));
}

OIIO::ImageBuf one(float value) {
    OIIO::ImageBuf pixels = image({0, 4, 0, 3, 0, 1, 0, 3});
    set(pixels, 2, 1, {0, value, 0});
    return pixels;
}

TEST(NonfiniteMismatch, NumbersAreAlikeHoweverTheyDiffer) {
    EXPECT_EQ(find_nonfinite_mismatch(one(1), one(-1e38F)).pixels, 0U);
    EXPECT_EQ(find_nonfinite_mismatch(one(0), one(0)).pixels, 0U);
}

TEST(NonfiniteMismatch, TheSameKindIsAlike) {
    for (const float value : {kNan, kInf, -kInf})
        EXPECT_EQ(find_nonfinite_mismatch(one(value), one(value)).pixels, 0U) << value;
}

TEST(NonfiniteMismatch, EveryOtherPairOfKindsIsNot) {
    const float kinds[] = {0, kNan, kInf, -kInf};
    for (const float a : kinds) {
        for (const float b : kinds) {
            const bool same = a == b || (std::isnan(a) && std::isnan(b));
            const NonfiniteMismatch found = find_nonfinite_mismatch(one(a), one(b));
            EXPECT_EQ(found.pixels, same ? 0U : 1U) << a << " and " << b;
            if (!same) {
                EXPECT_EQ(found.x, 2);
                EXPECT_EQ(found.y, 1);
                EXPECT_EQ(found.channel, 1);
            }
        }
    }
}

TEST(NonfiniteMismatch, APixelCountsOnceAndTheFirstOneIsNamed) {
    const OIIO::ImageBuf numbers = image({0, 4, 0, 3, 0, 1, 0, 3});
    OIIO::ImageBuf many = one(kNan);
    set(many, 3, 1, {kNan, kNan, kNan});
    set(many, 0, 2, {0, 0, kInf});
    const NonfiniteMismatch found = find_nonfinite_mismatch(numbers, many);
    EXPECT_EQ(found.pixels, 3U);
    EXPECT_EQ(found.x, 2);
    EXPECT_EQ(found.y, 1);
}

TEST(NonfiniteMismatch, WhereAnImageHasNoPixelsOrChannelsItIsZero) {
    OIIO::ImageBuf wide = image({-2, 6, -1, 5, 0, 1, 0, 5});
    set(wide, -2, -1, {0, 0, 0, 0, kNan});
    set(wide, 5, 4, {kInf, 0, 0, 0, 0});
    const OIIO::ImageBuf small = image({0, 2, 0, 2, 0, 1, 0, 3});
    for (const NonfiniteMismatch& found :
         {find_nonfinite_mismatch(wide, small), find_nonfinite_mismatch(small, wide)}) {
        EXPECT_EQ(found.pixels, 2U);
        EXPECT_EQ(found.x, -2);
        EXPECT_EQ(found.y, -1);
        EXPECT_EQ(found.channel, 4);
    }
}

TEST(NonfiniteMismatch, ManyRowsAreLookedAtInParts) {
    const OIIO::ROI large(0, 1100, 10, 1610, 0, 1, 0, 4); // more values than are held at once
    OIIO::ImageBuf a = image(large), b = image(large);
    set(a, 7, 1609, {0, 0, 0, kNan});
    set(b, 1099, 10, {0, -kInf, 0, 0});
    const NonfiniteMismatch found = find_nonfinite_mismatch(a, b);
    EXPECT_EQ(found.pixels, 2U);
    EXPECT_EQ(found.x, 1099);
    EXPECT_EQ(found.y, 10);
    EXPECT_EQ(found.channel, 1);
}

TEST(NonfiniteMismatch, HalvesAndIntegers) {
    const OIIO::ROI window(0, 4, 0, 3, 0, 1, 0, 3);
    OIIO::ImageBuf half = image(window, OIIO::TypeHalf);
    set(half, 1, 0, {0, kNan, 0});
    EXPECT_EQ(find_nonfinite_mismatch(image(window, OIIO::TypeUInt8), half).pixels, 1U);
    EXPECT_EQ(
        find_nonfinite_mismatch(image(window, OIIO::TypeUInt8), image(window, OIIO::TypeUInt16))
            .pixels,
        0U);
}

OIIO::ImageBuf deep(int samples, float last) {
    OIIO::ImageSpec spec(3, 2, 2, OIIO::TypeFloat);
    spec.channelnames = {"A", "Z"};
    spec.deep = true;
    OIIO::ImageBuf pixels(spec);
    pixels.set_deep_samples(2, 1, 0, samples);
    for (int s = 0; s < samples; ++s)
        pixels.set_deep_value(2, 1, 0, 1, s, s + 1 < samples ? float(s) : last);
    return pixels;
}

TEST(NonfiniteMismatch, DeepSamplesAreValuesToo) {
    EXPECT_EQ(find_nonfinite_mismatch(deep(3, kNan), deep(3, kNan)).pixels, 0U);
    EXPECT_EQ(find_nonfinite_mismatch(deep(3, 1), deep(2, 5)).pixels, 0U);
    for (const NonfiniteMismatch& found :
         {find_nonfinite_mismatch(deep(3, kNan), deep(3, 1)),
          find_nonfinite_mismatch(deep(2, 1), deep(3, kInf)),
          find_nonfinite_mismatch(deep(3, kInf), deep(3, -kInf))}) {
        EXPECT_EQ(found.pixels, 1U);
        EXPECT_EQ(found.x, 2);
        EXPECT_EQ(found.y, 1);
        EXPECT_EQ(found.channel, 1);
    }
}

} // namespace
} // namespace tonetool::chain
