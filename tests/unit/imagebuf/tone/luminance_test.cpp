// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/luminance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "images.h"

namespace tonetool {
namespace {

using testing::HasSubstr;
using ToneAlgo::exposure;
using ToneAlgo::luminance_stats;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr double kFloat = 4e-7; // a luminance is a float of six roundings

TEST(LuminanceStats, CountAndMeasure) {
    auto image = constant(10, 1, {0, 0, 0});
    for (int x = 0; x < 5; ++x) {
        const auto v = float(x + 1);
        image = with_pixel(image, x, 0, {v, v, v});
    }
    image = with_pixel(image, 5, 0, {kNan, 1, 1});
    image = with_pixel(image, 6, 0, {1, kInf, 1});
    image = with_pixel(image, 7, 0, {-1, -1, 10});
    LuminanceStats s;
    std::string error;
    ASSERT_TRUE(luminance_stats(s, image, error)) << error;
    EXPECT_EQ(s.pixels, 10);
    EXPECT_EQ(s.nonfinite, 2);
    EXPECT_EQ(s.negative, 1);
    EXPECT_EQ(s.black, 2);
    EXPECT_NEAR(s.max, 5, 5 * kFloat);
    EXPECT_EQ(s.min, 0);
    EXPECT_NEAR(s.mean, (15 + 0.722) / 8, 5 * kFloat);
    EXPECT_NEAR(s.median, 2, 2 * kFloat) << "0 0 0.722 1 2 3 4 5: the upper one";
    EXPECT_NEAR(s.median_lit, 3, 3 * kFloat);
    EXPECT_NEAR(s.log_average, std::pow(120 * 0.722, 1.0 / 6), 5 * kFloat);
    EXPECT_EQ(s.space, "rec709");
}

TEST(LuminanceStats, LookAtTheRegion) {
    const auto image = noise(30, 20, 1);
    const ROI roi(5, 20, 10, 40);
    LuminanceStats s;
    std::string error;
    ASSERT_TRUE(luminance_stats(s, image, error, {}, roi)) << error;
    EXPECT_EQ(s.pixels, 150);
    double largest = 0;
    for (int y = 10; y < 20; ++y)
        for (int x = 5; x < 20; ++x) {
            const auto p = pixel_of(image, x, y);
            largest = std::max(largest, 0.2126 * double(p[0]) + 0.7152 * double(p[1]) +
                                            0.0722 * double(p[2]));
        }
    EXPECT_NEAR(s.max, largest, largest * kFloat);
}

TEST(LuminanceStats, ThreadsDoNotChangeABit) {
    const auto image = noise(50, 200, 2);
    LuminanceStats one, many;
    std::string error;
    ASSERT_TRUE(luminance_stats(one, image, error, {}, {}, 1)) << error;
    for (int n : {2, 3, 8}) {
        ASSERT_TRUE(luminance_stats(many, image, error, {}, {}, n)) << error;
        EXPECT_EQ(one.mean, many.mean);
        EXPECT_EQ(one.log_average, many.log_average);
        EXPECT_EQ(one.median, many.median);
    }
}

TEST(LuminanceStats, SayWhatIsWrong) {
    LuminanceStats s;
    const struct {
        ImageBuf image;
        PixelOptions options;
        ROI roi;
        const char* words;
    } cases[] = {{ImageBuf(), {}, {}, "not initialized"},
                 {ImageBuf("no/such/file.exr"), {}, {}, "no/such/file.exr"},
                 {ImageBuf(TESTIMAGES_DIR "/deep.exr"), {}, {}, "deep images"},
                 {noise(make_spec(2, 2, {"U", "V"}), 1), {}, {}, "needs R,G,B"},
                 {constant(2, 2, {kNan, 0, 0}), {}, {}, "no finite pixel"},
                 {noise(4, 4, 1), {}, ROI(8, 9, 0, 1), "holds no pixel"},
                 {noise(4, 4, 1), {"diffuse", ""}, {}, "\"diffuse\""},
                 {noise(4, 4, 1), {"", "agx"}, {}, "\"agx\""}};
    for (const auto& c : cases) {
        std::string error;
        EXPECT_FALSE(luminance_stats(s, c.image, error, c.options, c.roi)) << c.words;
        EXPECT_THAT(error, HasSubstr(c.words));
    }
}

TEST(Exposure, ScalesTheColorAlone) {
    const auto image = noise(make_spec(9, 5, {"A", "B", "Z", "G", "R"}), 3);
    for (double stops : {-3.0, 0.0, 1.0, 7.0}) {
        const auto out = exposure(image, stops);
        ASSERT_FALSE(out.has_error()) << out.geterror();
        const auto a = values(image), b = values(out);
        for (size_t i = 0; i < a.size(); ++i) {
            const bool color = i % 5 == 1 || i % 5 == 3 || i % 5 == 4;
            EXPECT_EQ(b[i], color ? a[i] * float(std::exp2(stops)) : a[i]);
        }
        EXPECT_EQ(out.spec().channelnames, image.spec().channelnames);
    }
}

TEST(Exposure, WorksInPlaceAndLeavesNonFiniteAlone) {
    auto image = with_pixel(noise(5, 5, 4), 2, 2, {kNan, kInf, -kInf});
    const auto before = image;
    ASSERT_TRUE(exposure(image, image, 2.0)) << image.geterror();
    EXPECT_EQ(pixel_of(image, 0, 0)[1], 4 * pixel_of(before, 0, 0)[1]);
    const auto p = pixel_of(image, 2, 2);
    EXPECT_TRUE(std::isnan(p[0]));
    EXPECT_EQ(p[1], kInf);
    EXPECT_EQ(p[2], -kInf);
}

TEST(Exposure, ScalesTheChosenLayerAlone) {
    const auto image = constant(
        make_spec(2, 2, {"beauty.R", "beauty.G", "beauty.B", "emit.R", "emit.G", "emit.B"}),
        {1, 2, 3, 4, 5, 6});
    PixelOptions options;
    options.layer = "emit";
    EXPECT_EQ(pixel_of(exposure(image, 1, options), 1, 1),
              (std::vector<float>{1, 2, 3, 8, 10, 12}));
    EXPECT_EQ(pixel_of(exposure(image, 1), 1, 1), (std::vector<float>{2, 4, 6, 4, 5, 6}));
}

TEST(Exposure, SaysWhatIsWrong) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const ImageBuf bytes(make_spec(4, 4, {"R", "G", "B"}, OIIO::TypeUInt8));
    const struct {
        ImageBuf image;
        double stops;
        const char* words;
    } cases[] = {{noise(4, 4, 1), 127, "exposure is 127"},
                 {noise(4, 4, 1), -126.5, "-126.5"},
                 {noise(4, 4, 1), nan, "exposure is nan"},
                 {bytes, 1, "display-encoded (srgb)"},
                 {ImageBuf(), 1, "not initialized"},
                 {ImageBuf(TESTIMAGES_DIR "/deep.exr"), 1, "deep images"},
                 {noise(make_spec(2, 2, {"U", "V"}), 1), 1, "needs R,G,B"}};
    for (const auto& c : cases) {
        ImageBuf dst;
        EXPECT_FALSE(exposure(dst, c.image, c.stops)) << c.words;
        const std::string error = dst.geterror();
        EXPECT_THAT(error, HasSubstr(c.words));
        EXPECT_THAT(error, HasSubstr("exposure: "));
        EXPECT_TRUE(exposure(c.image, c.stops).has_error());
    }
    PixelOptions linear;
    linear.from = "rec709";
    EXPECT_FALSE(exposure(bytes, 1, linear).has_error());
}

TEST(Exposure, OfAHalfDoesNotOverflow) {
    const auto half = constant(1, 1, {1000, 1, 1}).copy(OIIO::TypeHalf);
    ImageBuf out;
    ASSERT_TRUE(exposure(out, half, 10.0)) << out.geterror();
    EXPECT_EQ(pixel_of(out, 0, 0)[0], 1000.0f * 1024.0f);
}

} // namespace
} // namespace tonetool
