// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_pictures.h"

#include <gmock/gmock.h>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "sequence/report/bytes.h"
#include "sequence/report/encoded.h"
#include "sequence/report/reduced.h"

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

TEST(Pictures, BothImagesAtFiveExposuresMapsAndTheWorstPixelFromNear) {
    const Compared compared;
    const FramePictures pictures = draw_pictures(compared.request());
    ASSERT_EQ(compared.result.summary.exposures.size(), 4U);
    ASSERT_EQ(pictures.exposures.size(), 4U);
    EXPECT_EQ(pictures.exposures.front().stops, -2);
    EXPECT_EQ(pictures.exposures.back().stops, 2);
    EXPECT_EQ(pictures.first_stop, -2);
    EXPECT_EQ(pictures.width, 300);
    const auto reference = picture_of(pictures.exposures[1].reference);
    const auto test = picture_of(pictures.exposures[1].test);
    ASSERT_TRUE(reference && test);
    EXPECT_GT(test->getchannel(250, 40, 0, 0), reference->getchannel(250, 40, 0, 0) + 0.2f);
    EXPECT_NEAR(test->getchannel(20, 150, 0, 0), reference->getchannel(20, 150, 0, 0), 0.02f);
    ASSERT_EQ(pictures.spots.size(), 1U);
    const auto near = picture_of(pictures.spots[0].test);
    ASSERT_TRUE(near);
    EXPECT_EQ(near->spec().width, 2 * kSpotRadius + 1);
    EXPECT_GT(near->getchannel(kSpotRadius, kSpotRadius, 0, 0),
              near->getchannel(kSpotRadius - 2, kSpotRadius, 0, 0) + 0.2f);
}

TEST(Pictures, ASingleImageHasNoReferenceAndChoosesItsOwnExposures) {
    const Compared compared;
    PictureRequest request;
    request.test = &compared.test;
    const FramePictures pictures = draw_pictures(request);
    EXPECT_GE(pictures.exposures.size(), 2U);
    EXPECT_LE(pictures.exposures.size(), kMostExposures);
    EXPECT_TRUE(pictures.exposures[0].reference.empty());
    EXPECT_TRUE(pictures.error.empty());
    EXPECT_FALSE(pictures.small_test.empty());
}

TEST(Pictures, ThumbnailsAloneWhereThatIsAskedFor) {
    const Compared compared;
    PictureRequest request = compared.request();
    request.full = false;
    const FramePictures pictures = draw_pictures(request);
    EXPECT_TRUE(pictures.exposures.empty());
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
    EXPECT_EQ(draw_pictures(request).exposures.size(), 1U);
    ImageBuf z = depth;
    z.specmod().channelnames = {"Z"};
    request.test = &z;
    EXPECT_THROW(draw_pictures(request), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
