// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_pictures.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sequence/report/bytes.h"
#include "sequence/report/encoded.h"
#include "sequence/report/reduced.h"
#include "sequence/report/scene_pixels.h"

namespace tonetool::sequence {
namespace {

using OIIO::ImageBuf;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

ImageBuf plain(int width, int height, int channels, float value) {
    ImageBuf image(OIIO::ImageSpec(width, height, channels, OIIO::TypeFloat));
    for (ImageBuf::Iterator<float> pixel(image); !pixel.done(); ++pixel)
        for (int c = 0; c < channels; ++c)
            pixel[c] = value;
    return image;
}

// A pair with one different pixel, and what HDR-FLIP says of it.
struct Compared {
    ImageBuf reference = plain(300, 200, 3, 0.2f), test = plain(300, 200, 3, 0.2f), error;
    FlipResult result;

    Compared() {
        const float white[3] = {9, 9, 9};
        test.setpixel(250, 40, white);
        HdrFlipOptions options;
        options.want_exposure_map = true;
        options.start_exposure = -2;
        options.stop_exposure = 2;
        error = ToneAlgo::hdr_flip(reference, test, options, &result);
    }
    PictureRequest request() const {
        PictureRequest request;
        request.reference = &reference;
        request.test = &test;
        request.error = &error;
        request.stops = &result.exposure_stops;
        request.exposures = result.summary.exposures;
        request.spots = {{250, 40}};
        return request;
    }
};

TEST(Reduced, TheMeanOfTheFinitePixels) {
    ImageBuf image = plain(4, 2, 3, 1);
    const float three[3] = {3, 5, 7}, broken[3] = {kNan, 1, 1};
    image.setpixel(0, 0, three);
    image.setpixel(2, 0, broken);
    const ImageBuf small = reduced_color(image, {}, image.roi(), {2, 1});
    EXPECT_FLOAT_EQ(small.getchannel(0, 0, 0, 0), 1.5f);
    EXPECT_FLOAT_EQ(small.getchannel(0, 0, 0, 2), 2.5f);
    EXPECT_FLOAT_EQ(small.getchannel(1, 0, 0, 0), 1.0f);
}

TEST(Reduced, WhatAnImageDoesNotCoverIsBlackAndASmallOneIsEnlarged) {
    const ImageBuf image = plain(2, 2, 3, 1);
    const OIIO::ROI beyond(0, 4, 0, 2, 0, 1, 0, 1);
    const ImageBuf same = reduced_color(image, {}, beyond, {4, 2});
    EXPECT_EQ(same.getchannel(1, 1, 0, 0), 1);
    EXPECT_EQ(same.getchannel(2, 1, 0, 0), 0);
    const ImageBuf large = reduced_color(image, {}, image.roi(), {8, 8});
    EXPECT_EQ(large.spec().width, 8);
    EXPECT_NEAR(large.getchannel(7, 7, 0, 1), 1, 1e-6);
}

TEST(Reduced, ASingleWrongPixelIsNotLostInASmallMap) {
    ImageBuf error = plain(1000, 500, 1, 0), stops = plain(1000, 500, 1, -3);
    const float one = 1, two = 2;
    error.setpixel(777, 333, &one);
    stops.setpixel(777, 333, &two);
    const ReducedMaps maps = reduced_maps(error, &stops, {100, 50});
    EXPECT_EQ(maps.error.getchannel(77, 33, 0, 0), 1);
    EXPECT_EQ(maps.stops.getchannel(77, 33, 0, 0), 2);
    EXPECT_EQ(maps.error.getchannel(76, 33, 0, 0), 0);
    EXPECT_EQ(maps.stops.getchannel(76, 33, 0, 0), -3);
}

TEST(Bytes, EndsAndMiddleOfTheTables) {
    ImageBuf light = plain(3, 1, 3, 0);
    const float grey[3] = {0.21404f, 0.21404f, 0.21404f}, one[3] = {1, 2, kNan};
    light.setpixel(1, 0, grey);
    light.setpixel(2, 0, one);
    const ImageBuf bytes = srgb_bytes(light);
    EXPECT_EQ(std::lround(bytes.getchannel(0, 0, 0, 0) * 255), 0);
    EXPECT_NEAR(bytes.getchannel(1, 0, 0, 0) * 255, 127.5, 1);
    EXPECT_EQ(std::lround(bytes.getchannel(2, 0, 0, 1) * 255), 255);
    EXPECT_EQ(std::lround(bytes.getchannel(2, 0, 0, 2) * 255), 0);
    ImageBuf map = plain(2, 1, 1, -4);
    const float high = 4;
    map.setpixel(1, 0, &high);
    const ImageBuf colors = colored_bytes(map, "viridis", -4, 4);
    EXPECT_NEAR(colors.getchannel(0, 0, 0, 2) * 255, 0x54, 2); // #440154, viridis' first
    EXPECT_NEAR(colors.getchannel(1, 0, 0, 0) * 255, 0xfd, 2); // #fde725, its last
    EXPECT_THROW(colored_bytes(map, "veridis"), std::runtime_error);
}

TEST(Encoded, APngComesBackAsItWas) {
    ImageBuf image(OIIO::ImageSpec(5, 3, 3, OIIO::TypeDesc::UINT8));
    for (ImageBuf::Iterator<unsigned char> pixel(image); !pixel.done(); ++pixel) {
        pixel[0] = float(pixel.x()) / 5;
        pixel[1] = float(pixel.y()) / 3;
        pixel[2] = 1;
    }
    const auto back = picture_of(data_uri(image, Encoding::Png));
    ASSERT_TRUE(back);
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 5; ++x)
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(back->getchannel(x, y, 0, c), image.getchannel(x, y, 0, c));
    }
    EXPECT_FALSE(picture_of("data:image/png;base64,AAAA"));
    EXPECT_FALSE(picture_of("no picture"));
}

// What the page makes of a code.
double light_of(float code) {
    return std::exp2(kLogLow + double(code) * (kLogHigh - kLogLow));
}

TEST(Pictures, LogarithmsOfBothImagesMapsAndTheWorstPixelFromNear) {
    const Compared compared;
    const FramePictures pictures = draw_pictures(compared.request());
    EXPECT_EQ(pictures.first_stop, -2);
    EXPECT_EQ(pictures.last_stop, 2);
    EXPECT_EQ(pictures.width, 300);
    EXPECT_EQ(pictures.space, "rec709");
    EXPECT_EQ(pictures.start, compared.result.exposure_stops.getchannel(250, 40, 0, 0));
    for (const PairTexts& pair : {pictures.pictures, pictures.large}) {
        const auto reference = picture_of(pair.reference), test = picture_of(pair.test);
        ASSERT_TRUE(reference && test);
        EXPECT_NEAR(light_of(test->getchannel(20, 150, 0, 0)), 0.2, 0.02);
        EXPECT_NEAR(light_of(reference->getchannel(250, 40, 0, 0)), 0.2, 0.02);
        EXPECT_GT(light_of(test->getchannel(250, 40, 0, 0)), 3);
    }
    const auto error = picture_of(pictures.error);
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->getchannel(250, 40, 0, 0), compared.error.getchannel(250, 40, 0, 0), 0.05);
    ASSERT_EQ(pictures.spots.size(), 1U);
    const auto near = picture_of(pictures.spots[0].test);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->spec().width, 2 * kSpotRadius + 1);
    EXPECT_GT(near->getchannel(kSpotRadius, kSpotRadius, 0, 0),
              near->getchannel(kSpotRadius - 2, kSpotRadius, 0, 0) + 0.2f);
}

uint16_t half_at(const std::string& high, const std::string& low, int x, int y, int c) {
    const auto byte = [&](const std::string& uri) {
        return uint16_t(std::lround(picture_of(uri)->getchannel(x, y, 0, c) * 255));
    };
    return uint16_t(byte(high) << 8 | byte(low));
}

TEST(Pictures, NumbersAroundTheWorstPixelAndOfAllOfThem) {
    const Compared compared;
    PictureRequest request = compared.request();
    request.exact = PictureRequest::Exact::All;
    const FramePictures pictures = draw_pictures(request);
    ASSERT_TRUE(pictures.near && pictures.exact);
    EXPECT_EQ(pictures.near->x, 300 - kNearSide);
    EXPECT_EQ(pictures.near->y, 0);
    EXPECT_EQ(pictures.near->width, kNearSide);
    EXPECT_EQ(pictures.near->height, 200);
    EXPECT_EQ(pictures.exact->columns, 300);
    const NumberTexts& test = pictures.near->test;
    EXPECT_EQ(half_value(half_at(test.high, test.low, 250 - pictures.near->x, 40, 1)), 9);
    // 0.2 as a half is 1.5996 / 8, whose mantissa is rounded to 7 bits here.
    EXPECT_NEAR(half_value(half_at(test.high, test.low, 3, 4, 2)), 0.2, 0.2 / 256);
    const NumberTexts& all = pictures.exact->test;
    EXPECT_EQ(half_value(half_at(all.high, all.low, 250, 40, 0)), 9);
    const double error = compared.error.getchannel(250, 40, 0, 0);
    const auto map = picture_of(pictures.near->error);
    ASSERT_TRUE(map);
    const int x = 250 - pictures.near->x;
    const auto high = std::lround(map->getchannel(x, 40, 0, 0) * 255),
               low = std::lround(map->getchannel(x, 40, 0, 1) * 255);
    EXPECT_NEAR(half_value(uint16_t(high << 8 | low)), error, error / 200);
    request.exact = PictureRequest::Exact::No;
    request.large = false;
    const FramePictures less = draw_pictures(request);
    EXPECT_FALSE(less.exact);
    EXPECT_EQ(large_json(less), "");
    EXPECT_FALSE(less.pictures.test.empty());
}

TEST(Pictures, ASingleImageHasNoReferenceAndItsMiddleFromNear) {
    const Compared compared;
    PictureRequest request;
    request.test = &compared.test;
    const FramePictures pictures = draw_pictures(request);
    EXPECT_TRUE(pictures.pictures.reference.empty());
    EXPECT_FALSE(pictures.pictures.test.empty());
    EXPECT_TRUE(pictures.error.empty());
    EXPECT_FALSE(pictures.small_test.empty());
    EXPECT_EQ(pictures.near->x, 150 - kNearSide / 2);
    EXPECT_TRUE(nlohmann::json::parse(full_json(pictures))["near"]["reference"].is_null());
}

TEST(Pictures, AlphaIsANumberWhereItIsTheSameEverywhere) {
    ImageBuf image = plain(40, 30, 4, 1);
    image.specmod().channelnames = {"R", "G", "B", "A"};
    image.specmod().alpha_channel = 3;
    PictureRequest request;
    request.test = &image;
    FramePictures pictures = draw_pictures(request);
    EXPECT_EQ(pictures.near->test.one_alpha, 1.0);
    EXPECT_TRUE(pictures.alpha.test.empty());
    const float clear[4] = {0, 0, 0, 0.25f};
    image.setpixel(7, 8, clear);
    pictures = draw_pictures(request);
    EXPECT_FALSE(pictures.near->test.one_alpha);
    const auto alpha = picture_of(pictures.near->test.alpha);
    ASSERT_TRUE(alpha);
    const auto high = std::lround(alpha->getchannel(7, 8, 0, 0) * 255),
               low = std::lround(alpha->getchannel(7, 8, 0, 1) * 255);
    EXPECT_EQ(half_value(uint16_t(high << 8 | low)), 0.25);
    EXPECT_FALSE(pictures.alpha.test.empty());
}

TEST(ScenePixels, ColoursBecomeRec709AndWhatIsNoNumberStaysSo) {
    ImageBuf image = plain(2, 1, 3, 0);
    const float red[3] = {1, 0, 0}, broken[3] = {kNan, -1, 2};
    image.setpixel(0, 0, red);
    image.setpixel(1, 0, broken);
    const ScenePixels stored = scene_pixels(image, {}, image.roi());
    EXPECT_EQ(half_value(stored.color[0]), 1);
    EXPECT_TRUE(std::isnan(half_value(stored.color[3])));
    EXPECT_EQ(half_value(stored.color[4]), -1);
    image.specmod().attribute("oiio:ColorSpace", "acescg");
    const ScenePixels converted = scene_pixels(image, {}, image.roi());
    EXPECT_NEAR(half_value(converted.color[0]), 1.705, 0.003); // AP1 to Rec.709, D60 to D65
    EXPECT_EQ(half_value(converted.color[1]), 0);              // -0.13
    EXPECT_TRUE(std::isnan(half_value(converted.color[3])));
    EXPECT_TRUE(stored.alpha.empty());
}

TEST(ScenePixels, MantissasAreRoundedAndNothingElse) {
    for (uint32_t half = 0; half < 65536; ++half) {
        std::vector<uint16_t> one{uint16_t(half)};
        shorten(one);
        const float before = half_value(uint16_t(half)), after = half_value(one[0]);
        if (!std::isfinite(before)) {
            EXPECT_EQ(one[0], half);
            continue;
        }
        EXPECT_TRUE(std::isfinite(after)) << half;
        EXPECT_EQ(std::signbit(before), std::signbit(after));
        // Half a step of 7 bits; the numbers below 2^-14 have a step of their own.
        EXPECT_NEAR(after, before, std::max(std::abs(before) / 256, std::ldexp(1.0f, -22))) << half;
    }
}

TEST(ScenePixels, LogarithmsAreFromATenthOfAPercentTo256) {
    ScenePixels pixels;
    pixels.width = 2;
    pixels.height = 1;
    pixels.color = {0, 0x3c00, 0xbc00, 0x7bff, 0x7e00, 0x1400}; // 0, 1, -1, 65504, NaN, 2^-10
    const ImageBuf codes = log_codes(pixels);
    std::vector<int> found;
    for (int x = 0; x < 2; ++x)
        for (int c = 0; c < 3; ++c)
            found.push_back(int(std::lround(codes.getchannel(x, 0, 0, c) * 255)));
    EXPECT_EQ(found, (std::vector<int>{0, 142, 0, 255, 0, 0})); // 10 / 18 of 255 is 141.7
}

TEST(Pictures, ThumbnailsAloneWhereThatIsAskedFor) {
    const Compared compared;
    PictureRequest request = compared.request();
    request.full = false;
    const FramePictures pictures = draw_pictures(request);
    EXPECT_EQ(full_json(pictures), "");
    EXPECT_EQ(large_json(pictures), "");
    EXPECT_EQ(exact_json(pictures), "");
    const auto small = picture_of(pictures.small_test);
    ASSERT_TRUE(small);
    EXPECT_EQ(small->spec().width, kThumbnailSide);
    EXPECT_FALSE(nlohmann::json::parse(small_json(pictures))["error"].get<std::string>().empty());
}

TEST(Pictures, APixelThatIsNotFiniteIsMagentaFromNear) {
    Compared compared;
    const float broken[3] = {kNan, 0, 0};
    compared.test.setpixel(250, 40, broken);
    const FramePictures pictures = draw_pictures(compared.request());
    const auto near = picture_of(pictures.spots.at(0).test);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->getchannel(kSpotRadius, kSpotRadius, 0, 0), 1);
    EXPECT_EQ(near->getchannel(kSpotRadius, kSpotRadius, 0, 1), 0);
    EXPECT_EQ(near->getchannel(kSpotRadius, kSpotRadius, 0, 2), 1);
    EXPECT_LT(near->getchannel(0, 0, 0, 2), 1);
}

TEST(Pictures, ABlackImageAndOneWithoutColour) {
    const ImageBuf black = plain(40, 30, 3, 0), depth = plain(40, 30, 1, 1);
    PictureRequest request;
    request.test = &black;
    EXPECT_EQ(draw_pictures(request).start, 0);
    ImageBuf z = depth;
    z.specmod().channelnames = {"Z"};
    request.test = &z;
    EXPECT_THROW(draw_pictures(request), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
