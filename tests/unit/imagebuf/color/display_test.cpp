// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/display.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "images.h"

namespace tonetool {
namespace {

using testing::HasSubstr;
using ToneAlgo::color_map;
using ToneAlgo::encode_srgb;

ImageBuf row(const std::vector<float>& map) {
    ImageBuf image(make_spec(int(map.size()), 1, {"Y"}));
    image.set_pixels(image.roi(), OIIO::TypeFloat, map.data());
    return image;
}

TEST(ColorMap, ShowsTheColorsThatMapsAreKnownFor) {
    const struct {
        const char* map;
        float value;
        int rgb[3];
    } cases[] = {{"magma", 0.0f, {0, 0, 4}},        {"magma", 0.5f, {183, 55, 121}},
                 {"magma", 1.0f, {252, 253, 191}},  {"viridis", 0.0f, {68, 1, 84}},
                 {"viridis", 0.5f, {33, 145, 140}}, {"viridis", 1.0f, {253, 231, 37}}};
    for (const auto& c : cases) {
        ImageBuf out;
        ASSERT_TRUE(color_map(out, row({c.value}), c.map)) << out.geterror();
        const auto rgb = pixel_of(out, 0, 0);
        for (size_t i = 0; i < 3; ++i) // OpenImageIO interpolates a table of 17 entries
            EXPECT_NEAR(rgb[i] * 255, c.rgb[i], 2) << c.map << " " << c.value << " channel " << i;
        EXPECT_EQ(out.spec().get_string_attribute("oiio:ColorSpace"), "sRGB");
    }
}

TEST(ColorMap, ClampsAndTreatsNanAs0) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const std::string& name : ToneAlgo::color_maps()) {
        ImageBuf out;
        ASSERT_TRUE(color_map(out, row({0, -5, nan, 1, 7}), name)) << out.geterror();
        EXPECT_EQ(pixel_of(out, 0, 0), pixel_of(out, 1, 0)) << name;
        EXPECT_EQ(pixel_of(out, 0, 0), pixel_of(out, 2, 0)) << name;
        EXPECT_EQ(pixel_of(out, 3, 0), pixel_of(out, 4, 0)) << name;
        EXPECT_NE(pixel_of(out, 0, 0), pixel_of(out, 3, 0)) << name;
    }
}

TEST(ColorMap, OfTriplesIsEncodedLinearLight) {
    ImageBuf out;
    ASSERT_TRUE(color_map(out, row({0, 0.5f, 1}), std::vector<float>{0, 0, 0, 1, 0.5f, 0.25f}));
    EXPECT_EQ(pixel_of(out, 0, 0), (std::vector<float>{0, 0, 0}));
    // 0.5, 0.25 and 0.125 sRGB-encoded; floats
    EXPECT_NEAR(pixel_of(out, 1, 0)[0], 0.735357, 1e-6);
    EXPECT_NEAR(pixel_of(out, 1, 0)[1], 0.537099, 1e-6);
    EXPECT_NEAR(pixel_of(out, 1, 0)[2], 0.388573, 1e-6);
    EXPECT_NEAR(pixel_of(out, 2, 0)[0], 1.0, 1e-6);
}

TEST(ColorMap, KeepsWindowsAndChannelAndRegion) {
    auto spec = make_spec(8, 6, {"a", "b"});
    spec.x = 3;
    spec.y = -2;
    spec.full_width = 20;
    const auto src = constant(spec, {0.0f, 1.0f});
    ImageBuf out, part;
    ASSERT_TRUE(color_map(out, src, "magma", 1));
    EXPECT_EQ(out.roi(), ROI(3, 11, -2, 4, 0, 1, 0, 3));
    EXPECT_EQ(out.roi_full().width(), 20);
    EXPECT_NEAR(pixel_of(out, 3, -2)[1] * 255, 253, 2);
    ASSERT_TRUE(color_map(part, src, "magma", 1, ROI(5, 7, 0, 3)));
    EXPECT_EQ(part.roi(), ROI(5, 7, 0, 3, 0, 1, 0, 3));
    EXPECT_EQ(pixel_of(part, 6, 2), pixel_of(out, 6, 2));
}

TEST(ColorMap, SaysWhatIsWrong) {
    ImageBuf out;
    EXPECT_FALSE(color_map(out, row({0}), "jet"));
    EXPECT_THAT(out.geterror(), HasSubstr("unknown colour map \"jet\"; valid: magma, viridis"));
    EXPECT_FALSE(color_map(out, row({0}), "magma", 1));
    EXPECT_THAT(out.geterror(), HasSubstr("needs channel 1"));
    EXPECT_FALSE(color_map(out, row({0}), "magma", -1));
    EXPECT_THAT(out.geterror(), HasSubstr("needs channel -1"));
    EXPECT_FALSE(color_map(out, ImageBuf(), "magma"));
    EXPECT_THAT(out.geterror(), HasSubstr("color_map: "));
    EXPECT_FALSE(color_map(out, ImageBuf(TESTIMAGES_DIR "/deep.exr"), "magma"));
    EXPECT_THAT(out.geterror(), HasSubstr("color_map: "));
    for (const auto& triples : {std::vector<float>{}, {1, 2, 3}, {1, 2, 3, 4, 5}, {1, 2, 3, 4}}) {
        EXPECT_FALSE(color_map(out, row({0}), triples));
        EXPECT_THAT(out.geterror(), HasSubstr(std::to_string(triples.size()) + " numbers"));
    }
}

TEST(EncodeSrgb, EncodesAndClampsAllButAlpha) {
    const auto src = constant(make_spec(3, 2, {"R", "G", "B", "A"}), {0.214041f, -1, 7, 0.5f});
    ImageBuf out;
    ASSERT_TRUE(encode_srgb(out, src));
    const auto p = pixel_of(out, 2, 1);
    EXPECT_NEAR(p[0], 0.5, 1e-6); // six decimals are written above
    EXPECT_EQ(p[1], 0.0f);
    EXPECT_EQ(p[2], 1.0f);
    EXPECT_EQ(p[3], 0.5f);
    EXPECT_EQ(out.spec().get_string_attribute("oiio:ColorSpace"), "sRGB");
    EXPECT_FALSE(encode_srgb(out, ImageBuf()));
    EXPECT_THAT(out.geterror(), HasSubstr("encode_srgb: "));
}

TEST(ColorMap, InfinityIsTheBrightest) {
    ImageBuf out;
    ASSERT_TRUE(color_map(out, row({1, std::numeric_limits<float>::infinity()}), "magma"));
    EXPECT_EQ(pixel_of(out, 0, 0), pixel_of(out, 1, 0));
}

TEST(EncodeSrgb, RefusesDeepImages) {
    auto spec = make_spec(2, 2, {"R", "G", "B"});
    spec.deep = true;
    const ImageBuf deep(spec);
    ImageBuf out;
    EXPECT_FALSE(encode_srgb(out, deep));
    EXPECT_THAT(out.geterror(), HasSubstr("deep"));
    EXPECT_FALSE(color_map(out, deep, "magma"));
    EXPECT_THAT(out.geterror(), HasSubstr("deep"));
}

} // namespace
} // namespace tonetool
