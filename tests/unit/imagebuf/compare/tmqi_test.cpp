// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/tmqi.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "images.h"
#include "tonetool/display.h"

namespace tonetool {
namespace {

using testing::Contains;
using testing::HasSubstr;
using ToneAlgo::tmqi;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A picture of an image: light over (light + 0.5), sRGB-encoded and tagged.
ImageBuf shown(const ImageBuf& hdr) {
    ImageBuf linear = hdr, out;
    for (ImageBuf::Iterator<float> p(linear); !p.done(); ++p)
        for (int c = 0; c < 3; ++c)
            p[c] = p[c] / (p[c] + 0.5f);
    EXPECT_TRUE(ToneAlgo::encode_srgb(out, linear));
    return out;
}

class Tmqi : public testing::Test {
protected:
    const ImageBuf m_hdr = noise(60, 40, 1), m_ldr = shown(m_hdr);
    TmqiSummary m_summary;
};

TEST_F(Tmqi, ScoresAndAnnotates) {
    const auto map = tmqi(m_hdr, m_ldr, {}, &m_summary);
    ASSERT_FALSE(map.has_error()) << map.geterror();
    const TmqiScore& s = m_summary.score;
    EXPECT_NEAR(s.q, 0.8012 * std::pow(s.s, 0.3046) + 0.1988 * std::pow(s.n, 0.7088), 1e-15);
    EXPECT_GT(s.s, 0.5);
    EXPECT_EQ(map.nchannels(), 1);
    EXPECT_EQ(map.roi().width(), 60);
    double sum = 0;
    for (const float v : values(map))
        sum += double(v);
    EXPECT_NEAR(sum / 2400, s.scales[0], 1e-7); // the map is float
    EXPECT_EQ(map.spec().get_float_attribute("TMQI:Q"), float(s.q));
    EXPECT_EQ(map.spec().get_float_attribute("TMQI:S5"), float(s.scales[4]));
    EXPECT_EQ(map.spec().get_string_attribute("TMQI:ldrSpace"), "srgb");
    EXPECT_TRUE(m_summary.warnings.empty());
    EXPECT_EQ(ToneAlgo::tmqi_quantity(s, "N"), s.n);
    EXPECT_FALSE(ToneAlgo::tmqi_quantity(s, "n"));
}

TEST_F(Tmqi, TakesEncodedValuesAsTheyAreAndEncodesLinearOnes) {
    auto spec = make_spec(22, 22, {"R", "G", "B"});
    const auto hdr = noise(spec, 1);
    spec.attribute("oiio:ColorSpace", "sRGB");
    tmqi(hdr, constant(spec, {0.5f, 0.25f, 1}), {}, &m_summary);
    const double encoded = 255 * (0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722);
    EXPECT_NEAR(m_summary.score.mean, encoded, 1e-4); // decoded and encoded in float
    tmqi(hdr, constant(22, 22, {0.2140411f, 0.0508761f, 7}), {}, &m_summary);
    EXPECT_NEAR(m_summary.score.mean, encoded, 1e-4);
    EXPECT_EQ(m_summary.score.deviation, 0);
    EXPECT_EQ(m_summary.score.n, 0);
}

TEST_F(Tmqi, ThreadsDoNotChangeABit) {
    const auto hdr = noise(300, 500, 1), ldr = shown(hdr);
    TmqiSummary many;
    const auto map = tmqi(hdr, ldr, {}, &m_summary, 1);
    for (int n : {2, 3, 0}) {
        EXPECT_EQ(values(map), values(tmqi(hdr, ldr, {}, &many, n)));
        EXPECT_EQ(m_summary.score.q, many.score.q);
        EXPECT_EQ(m_summary.score.scales, many.score.scales);
    }
}

TEST_F(Tmqi, HolesAreCountedAndHaveNoStructure) {
    const auto map = tmqi(with_pixel(m_hdr, 7, 8, {kNan, 1, 1}),
                          with_pixel(m_ldr, 30, 20, {INFINITY, 0, 0}), {}, &m_summary);
    ASSERT_FALSE(map.has_error()) << map.geterror();
    EXPECT_EQ(pixel_of(map, 7, 8)[0], 0.0f);
    EXPECT_EQ(pixel_of(map, 30, 20)[0], 0.0f);
    EXPECT_EQ(m_summary.hdr.nonfinite, 1);
    EXPECT_EQ(m_summary.ldr.nonfinite, 1);
    EXPECT_THAT(m_summary.warnings, Contains(HasSubstr("of the HDR image are NaN or Inf")));
    EXPECT_THAT(m_summary.warnings, Contains(HasSubstr("of the display image are NaN or Inf")));
    EXPECT_THAT(tmqi(m_hdr, constant(60, 40, {kNan, 0, 0})).geterror(),
                HasSubstr("the display image has no finite pixel"));
}

TEST_F(Tmqi, UncoveredPixelsAreWarnings) {
    auto spec = make_spec(50, 40, {"R", "G", "B"});
    spec.full_width = 60;
    spec.full_height = 40;
    const auto map = tmqi(m_hdr, noise(spec, 3), {}, &m_summary);
    EXPECT_EQ(m_summary.ldr.uncovered, 400);
    EXPECT_EQ(pixel_of(map, 55, 20)[0], 0.0f);
    EXPECT_THAT(m_summary.warnings, Contains(HasSubstr("the display image's data window")));
}

TEST_F(Tmqi, CropTakesTheCommonWindow) {
    const auto small = noise(30, 40, 3);
    EXPECT_THAT(tmqi(m_hdr, small).geterror(), HasSubstr("display window"));
    TmqiOptions options;
    options.crop = true;
    EXPECT_EQ(tmqi(m_hdr, small, options).roi().width(), 30);
}

TEST_F(Tmqi, WhatCannotBeScoredIsAnError) {
    const auto flat = constant(60, 40, {0.5f, 0.5f, 0.5f});
    EXPECT_THAT(tmqi(flat, m_ldr).geterror(), HasSubstr("tmqi: the HDR image's luminance is 0.5"));
    EXPECT_FALSE(tmqi(m_hdr, flat, {}, &m_summary).has_error());
    const auto low = noise(60, 10, 1);
    EXPECT_THAT(tmqi(low, low).geterror(), HasSubstr("60x10 pixels are compared: needs 11"));
    const auto least = noise(11, 11, 1);
    EXPECT_FALSE(tmqi(least, shown(least)).has_error());
    TmqiOptions options;
    options.memory = 1 << 20;
    EXPECT_THAT(tmqi(m_hdr, m_ldr, options).geterror(), HasSubstr("memory is 1M: needs at least"));
    options.memory = uint64_t(200) << 20;
    EXPECT_FALSE(tmqi(m_hdr, m_ldr, options).has_error());
    options = {};
    options.ldr.layer = "nosuch";
    EXPECT_THAT(tmqi(m_hdr, m_ldr, options).geterror(), HasSubstr("display image"));
    EXPECT_THAT(tmqi(ImageBuf(), m_ldr).geterror(), HasSubstr("HDR image: is not initialized"));
}

TEST_F(Tmqi, APreparedMapIsFilledInPlace) {
    ImageBuf dst(make_spec(60, 40, {"Y"}));
    const void* pixels = dst.localpixels();
    ASSERT_TRUE(tmqi(dst, m_hdr, m_ldr));
    EXPECT_EQ(dst.localpixels(), pixels);
    EXPECT_EQ(values(dst), values(tmqi(m_hdr, m_ldr)));
    EXPECT_TRUE(dst.spec().find_attribute("TMQI:Q"));
}

} // namespace
} // namespace tonetool
