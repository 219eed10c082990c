// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/attributes.h"

#include <gmock/gmock.h>

#include "text/error.h"

namespace tonetool::chain {
namespace {

using testing::HasSubstr;

TEST(Attributes, TakeTheTypeThatTheValueLooksLike) {
    OIIO::ImageSpec spec(1, 1, 3);
    set_attribute(spec, "whole", "3", OIIO::TypeUnknown);
    set_attribute(spec, "number", "0.5", OIIO::TypeUnknown);
    set_attribute(spec, "text", "half past three", OIIO::TypeUnknown);
    EXPECT_EQ(spec.find_attribute("whole")->type(), OIIO::TypeInt);
    EXPECT_EQ(spec.find_attribute("number")->type(), OIIO::TypeFloat);
    EXPECT_EQ(spec.get_string_attribute("text"), "half past three");
    set_attribute(spec, "text", "", OIIO::TypeUnknown);
    EXPECT_EQ(spec.find_attribute("text"), nullptr);
}

TEST(Attributes, TimeCodesAndRationalsArePacked) {
    OIIO::ImageSpec spec(1, 1, 3);
    set_attribute(spec, "smpte:TimeCode", "01:02:03:14", OIIO::TypeTimeCode);
    set_attribute(spec, "FramesPerSecond", "24000/1001", OIIO::TypeRational);
    const auto shown = [&](const char* name) {
        return OIIO::ImageSpec::metadata_val(*spec.find_attribute(name), true);
    };
    EXPECT_THAT(shown("smpte:TimeCode"), HasSubstr("01:02:03:14"));
    EXPECT_THAT(shown("FramesPerSecond"), HasSubstr("24000/1001"));
}

TEST(Attributes, KeywordsAreThereOnce) {
    OIIO::ImageSpec spec(1, 1, 3);
    for (const char* word : {"night", "street", "night"})
        add_keyword(spec, word);
    EXPECT_EQ(spec.get_string_attribute("Keywords"), "night; street");
}

TEST(Attributes, ProfilesThatCannotBeReadAreErrors) {
    OIIO::ImageSpec spec(1, 1, 3);
    EXPECT_THROW(read_icc_profile(spec, TESTIMAGES_DIR "/nosuch.icc"), CommandError);
    EXPECT_THROW(write_icc_profile(spec, "unwritten.icc"), CommandError);
}

TEST(Attributes, ExpressionsSeeTheHeaderAndThePixels) {
    OIIO::ImageSpec spec(4, 2, 2, OIIO::TypeFloat);
    spec.x = 3;
    spec.attribute("shot", "a010");
    OIIO::ImageBuf pixels(spec);
    pixels.setpixel(3, 0, 0, std::vector<float>{2, -1}.data());
    const ImagePtr image = Image::created("dir/top.exr", std::move(pixels));
    EXPECT_EQ(attribute_text(*image, "geom"), "4x2+3+0");
    EXPECT_EQ(attribute_text(*image, "MAXCOLOR"), "2,0");
    EXPECT_EQ(attribute_text(*image, "MINCOLOR"), "0,-1");
    EXPECT_EQ(attribute_text(*image, "shot"), "a010");
    EXPECT_EQ(attribute_text(*image, "file_extension"), ".exr");
    EXPECT_THAT(*attribute_text(*image, "STATS"), HasSubstr("Stats Max: 2.000000 0.000000"));
    EXPECT_FALSE(attribute_text(*image, "nosuch"));
}

} // namespace
} // namespace tonetool::chain
