// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/colorimetry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "imagebuf/color/color_source.h"
#include "images.h"
#include "refusal.h"

namespace tonetool {
namespace {

using testing::HasSubstr;

// Published matrices (the ACES and ITU-R BT.2087 figures; AP0 and AP1 by Bradford from D60).
const struct {
    const char* name;
    float chromaticities[8];
    Matrix3 to_rec709;
} kSpaces[] = {
    {"acescg",
     {0.713f, 0.293f, 0.165f, 0.830f, 0.128f, 0.044f, 0.32168f, 0.33767f},
     {{{1.705051, -0.621792, -0.083259},
       {-0.130256, 1.140805, -0.010548},
       {-0.024003, -0.128969, 1.152972}}}},
    {"aces2065-1",
     {0.7347f, 0.2653f, 0.0f, 1.0f, 0.0001f, -0.077f, 0.32168f, 0.33767f},
     {{{2.521686, -1.134131, -0.387555},
       {-0.276480, 1.372719, -0.096239},
       {-0.015378, -0.152975, 1.168353}}}},
    {"rec2020",
     {0.708f, 0.292f, 0.170f, 0.797f, 0.131f, 0.046f, 0.3127f, 0.3290f},
     {{{1.660491, -0.587641, -0.072850},
       {-0.124550, 1.132900, -0.008349},
       {-0.018151, -0.100579, 1.118730}}}},
    {"p3-d65",
     {0.680f, 0.320f, 0.265f, 0.690f, 0.150f, 0.060f, 0.3127f, 0.3290f},
     {{{1.224940, -0.224940, 0.0}, {-0.042057, 1.042057, 0.0}, {-0.019638, -0.078636, 1.098274}}}}};

ImageSpec tagged(const std::string& tag, const float* chromaticities = nullptr,
                 OIIO::TypeDesc format = OIIO::TypeFloat) {
    ImageSpec spec = make_spec(2, 2, {"R", "G", "B"}, format);
    if (!tag.empty())
        spec.attribute("oiio:ColorSpace", tag);
    if (chromaticities)
        spec.attribute("chromaticities", OIIO::TypeDesc("float[8]"), chromaticities);
    return spec;
}

ColorSpace space_of(const ImageSpec& spec, const std::string& from = "") {
    return find_space(spec, from);
}

TEST(FindSpace, GivesThePublishedMatrices) {
    for (const auto& known : kSpaces)
        for (const ColorSpace& space :
             {space_of(tagged(""), known.name), space_of(tagged(known.name)),
              space_of(tagged("", known.chromaticities)),
              space_of(tagged("scene_linear", known.chromaticities))}) {
            EXPECT_EQ(space.name, known.name);
            EXPECT_FALSE(space.srgb_encoded);
            EXPECT_FALSE(space.is_rec709);
            for (size_t i = 0; i < 3; ++i)
                for (size_t j = 0; j < 3; ++j) // published with six or seven decimals
                    EXPECT_NEAR(space.to_rec709[i][j], known.to_rec709[i][j], 1e-6)
                        << known.name << " " << i << j;
        }
}

TEST(FindSpace, WhiteStaysWhite) {
    for (const auto& known : kSpaces) {
        const ColorSpace space = space_of(tagged(known.name));
        for (const auto& row : space.to_rec709) // doubles; the bound is what a float can show
            EXPECT_NEAR(row[0] + row[1] + row[2], 1.0, 1e-6) << known.name;
    }
}

TEST(FindSpace, ArbitraryPrimariesAreAdapted) {
    // Adobe RGB (1998) primaries with a D50 white.
    const float wide[8] = {0.64f, 0.33f, 0.21f, 0.71f, 0.15f, 0.06f, 0.3457f, 0.3585f};
    const ColorSpace space = space_of(tagged("", wide));
    EXPECT_EQ(space.name, "chromaticities");
    EXPECT_FALSE(space.is_rec709);
    for (const auto& row : space.to_rec709)
        EXPECT_NEAR(row[0] + row[1] + row[2], 1.0, 1e-6);
    EXPECT_GT(space.to_rec709[0][0], 1.2);
    EXPECT_LT(space.to_rec709[0][1], -0.2);
}

TEST(FindSpace, KnowsTheUsualSpellings) {
    const std::pair<const char*, const char*> cases[] = {{"lin_ap1", "acescg"},
                                                         {"ACEScg", "acescg"},
                                                         {"ACES - ACEScg", "acescg"},
                                                         {"lin_ap0_scene", "aces2065-1"},
                                                         {"Linear", "rec709"},
                                                         {"scene_linear", "rec709"},
                                                         {"lin_rec709", "rec709"},
                                                         {"Linear Rec.709 (sRGB)", "rec709"},
                                                         {"lin_rec2020", "rec2020"},
                                                         {"Linear P3-D65", "p3-d65"},
                                                         {"sRGB", "srgb"},
                                                         {"Utility - sRGB - Texture", "srgb"},
                                                         {"srgb_tx", "srgb"},
                                                         {"sRGB - Texture", "srgb"}};
    for (const auto& [spelling, name] : cases) {
        EXPECT_EQ(space_of(tagged(spelling)).name, name) << spelling;
        EXPECT_EQ(space_of(tagged(""), spelling).name, name) << spelling;
    }
}

TEST(FindSpace, DecidesWithoutTags) {
    EXPECT_EQ(space_of(tagged("")).name, "rec709");
    EXPECT_EQ(space_of(tagged("", nullptr, OIIO::TypeHalf)).name, "rec709");
    EXPECT_EQ(space_of(tagged("", nullptr, OIIO::TypeUInt8)).name, "srgb");
    EXPECT_EQ(space_of(tagged("", nullptr, OIIO::TypeUInt16)).name, "srgb");
}

TEST(FindSpace, FromWinsOverEveryTag) {
    EXPECT_EQ(space_of(tagged("acescg"), "rec709").name, "rec709");
    EXPECT_EQ(space_of(tagged("no such space"), "acescg").name, "acescg");
    EXPECT_EQ(space_of(tagged("lin_rec709", kSpaces[0].chromaticities), "rec2020").name, "rec2020");
    EXPECT_EQ(space_of(tagged("sRGB", nullptr, OIIO::TypeUInt8), "rec709").srgb_encoded, false);
}

TEST(FindSpace, SaysWhatIsWrong) {
    const float flat[8] = {0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3127f, 0.329f};
    const float no_white[8] = {0.64f, 0.33f, 0.3f, 0.6f, 0.15f, 0.06f, 0.3f, 0.0f};
    const struct {
        ImageSpec spec;
        const char* from;
        std::vector<const char*> words;
    } cases[] = {
        {tagged("my space"), "", {"\"my space\"", "from=", "acescg", "rec2020", "p3-d65", "srgb"}},
        // OpenImageIO's readers mean the camera curve by it.
        {tagged("Rec709"), "", {"\"Rec709\"", "from="}},
        {tagged(""), "agx", {"\"agx\"", "valid: rec709", "aces2065-1"}},
        {tagged("lin_rec2020", kSpaces[0].chromaticities), "", {"\"lin_rec2020\"", "from="}},
        {tagged("", flat), "", {"unusable chromaticities", "0.3", "from="}},
        {tagged("", no_white), "", {"unusable chromaticities"}}};
    for (const auto& c : cases) {
        const std::string error = refusal([&] { find_space(c.spec, c.from); });
        for (const char* word : c.words)
            EXPECT_THAT(error, HasSubstr(word));
    }
}

// XYZ are the light itself, whatever white the header names: no adaptation.
TEST(FindSpace, XyzIsNotAdapted) {
    for (const auto& [x, y] : {std::pair(1.0f / 3, 1.0f / 3), std::pair(0.3333f, 0.3334f)}) {
        const float axes[8] = {1, 0, 0, 1, 0, 0, x, y};
        const ColorSpace space = space_of(tagged("", axes));
        const Matrix3 expected = xyz_to_rec709();
        for (size_t i = 0; i < 3; ++i)
            for (size_t j = 0; j < 3; ++j) // the header's four decimals
                EXPECT_NEAR(space.to_rec709[i][j], expected[i][j], 2e-3);
        // Rec.709's white in XYZ is white.
        const double white[3] = {0.9504559, 1, 1.0890578};
        for (const auto& row : space.to_rec709)
            EXPECT_NEAR(row[0] * white[0] + row[1] * white[1] + row[2] * white[2], 1, 2e-3);
    }
}

TEST(FindSpace, PfmFilesHoldLight) {
    ImageSpec spec = tagged("Rec709");
    spec.attribute("pnm:bigendian", 0);
    EXPECT_EQ(space_of(spec).name, "rec709");
    EXPECT_FALSE(space_of(spec).encoded());
    EXPECT_EQ(space_of(tagged("Rec709", nullptr, OIIO::TypeUInt8)).name, "srgb");
}

TEST(FindSpace, AppliesTheGammaOfTheHeader) {
    ImageSpec png = tagged("sRGB", nullptr, OIIO::TypeUInt8);
    png.attribute("oiio:Gamma", 1.8f);
    for (const ImageSpec& spec : {png, tagged("GammaCorrected1.8"), tagged("Gamma1.8")}) {
        const ColorSpace space = space_of(spec);
        EXPECT_EQ(space.name, "gamma1.8");
        EXPECT_NEAR(space.light(0.5, 1), std::pow(0.5, 1.8), 1e-7); // 1.8 in float
        EXPECT_EQ(space_of(spec, "rec709").encoded(), false);
    }
    EXPECT_FLOAT_EQ(float(space_of(tagged(""), "gamma2.2").gamma), 2.2f);
    for (const char* name : {"g22_rec709_scene", "g22_rec709_display", "G22_Rec709"})
        EXPECT_DOUBLE_EQ(space_of(tagged(name)).gamma, 2.2) << name;
    for (const char* name : {"g22_adobergb_scene", "g2x_rec709_scene", "g22_rec709_other", "g22"})
        EXPECT_THROW((void)space_of(tagged(name)), Refusal) << name;
    png.attribute("oiio:Gamma", 1.0f);
    EXPECT_EQ(space_of(png).name, "rec709");
    // A space that was converted to, after which the old gamma stayed behind.
    png.attribute("oiio:Gamma", 1.8f);
    png.attribute("oiio:ColorSpace", "lin_rec709");
    EXPECT_EQ(space_of(png).name, "rec709");
    EXPECT_THROW(find_space(tagged("Gamma0.45"), ""), Refusal);
}

TEST(FindSpace, DividesTheExposureOut) {
    ImageSpec spec = tagged("linear");
    spec.attribute("hdr:exposure", 16.0f);
    EXPECT_EQ(space_of(spec).scale, 1.0 / 16);
    EXPECT_EQ(space_of(spec, "acescg").light(8, 1), 0.5);
    spec.attribute("hdr:exposure", -1.0f);
    EXPECT_EQ(space_of(spec).scale, 1);
}

// 0.5 of sRGB under half an alpha is read as 0.25.
TEST(FindPicture, IntegersAreDecodedBeforeTheyAreAssociated) {
    for (auto [format, expected] : {std::pair(OIIO::TypeUInt8, srgb_to_linear(0.5) / 2),
                                    std::pair(OIIO::TypeFloat, srgb_to_linear(0.25))}) {
        ImageSpec spec = make_spec(2, 2, {"R", "G", "B", "A"}, format);
        spec.attribute("oiio:ColorSpace", "sRGB");
        ColorChoice choice;
        ColorSpace space;
        find_picture(spec, {}, choice, space);
        EXPECT_NEAR(space.light(0.25, 0.5), expected, 1e-12);
        EXPECT_EQ(space.light(0.25, 1), srgb_to_linear(0.25));
        EXPECT_EQ(space.light(0.25, 0), srgb_to_linear(0.25));
    }
}

// OpenImageIO multiplies the colour of a Targa file by alpha to the power of its gamma.
TEST(FindPicture, TheReadersAlphaIsTakenBack) {
    ImageSpec spec = make_spec(2, 2, {"R", "G", "B", "A"}, OIIO::TypeUInt8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:Gamma", 1.8f);
    spec.attribute("targa:version", 2);
    const double read = 0.5 * std::pow(0.25, 1.8);
    for (auto [from, expected] :
         {std::pair("", std::pow(0.5, 1.8) * 0.25), std::pair("srgb", srgb_to_linear(0.5) * 0.25),
          std::pair("rec709", 0.5 * 0.25)}) {
        ColorChoice choice;
        ColorSpace space;
        find_picture(spec, {"", from}, choice, space);
        EXPECT_NEAR(space.light(read, 0.25), expected, 1e-7) << from; // 1.8 in float
    }
}

TEST(ColorTags, OfAnotherEncodingGo) {
    ImageSpec spec = tagged("sRGB", kSpaces[0].chromaticities);
    const unsigned char profile[4] = {1, 2, 3, 4};
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, 4), profile);
    spec.attribute("ICCProfile:profile_description", "test");
    spec.attribute("oiio:Gamma", 1.8f);
    spec.attribute("hdr:exposure", 2.0f);
    spec.attribute("Software", "renderer");
    ImageSpec same = spec;
    retag(spec, "lin_rec709");
    EXPECT_EQ(spec.extra_attribs.size(), 2U);
    EXPECT_EQ(spec.get_string_attribute("oiio:ColorSpace"), "lin_rec709");
    retag(same, "acescg", true);
    EXPECT_TRUE(same.find_attribute("chromaticities"));
}

TEST(ColorTags, ChromaticitiesAreThoseOfTheSpace) {
    for (const auto& known : kSpaces) {
        ImageSpec spec = tagged(known.name);
        state_chromaticities(spec);
        float found[8] = {};
        ASSERT_TRUE(spec.getattribute("chromaticities", OIIO::TypeDesc("float[8]"), found));
        for (size_t i = 0; i < 8; ++i)
            EXPECT_EQ(found[i], known.chromaticities[i]) << known.name;
    }
    // Those of another space, of the image that was converted.
    ImageSpec encoded = tagged("sRGB", kSpaces[0].chromaticities);
    state_chromaticities(encoded);
    EXPECT_FALSE(encoded.find_attribute("chromaticities"));
    ImageSpec untold = tagged("Linear", kSpaces[0].chromaticities);
    state_chromaticities(untold);
    EXPECT_EQ(space_of(untold).name, "acescg");
}

TEST(SrgbCurve, IsThatOfTheStandard) {
    const std::pair<double, double> cases[] = {
        {0, 0}, {0.04045, 0.04045 / 12.92}, {0.5, 0.214041140482}, {188.0 / 255, 0.502886458033},
        {1, 1}, {-0.1, -0.1 / 12.92}};
    for (const auto& [encoded, linear] : cases)
        EXPECT_NEAR(srgb_to_linear(encoded), linear, 1e-12); // twelve decimals are written
    for (double v = -0.5; v < 3; v += 0.001) // the standard's two constants meet within 4e-8
        EXPECT_NEAR(linear_to_srgb(srgb_to_linear(v)), v, 1e-6);
    for (double v = 0; v < 1; v += 0.001)
        EXPECT_LT(srgb_to_linear(v), srgb_to_linear(v + 0.001));
}

} // namespace
} // namespace tonetool
