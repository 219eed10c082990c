// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/view.h"

#include <gmock/gmock.h>

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "refusal.h"
#include "view_configs.h"

namespace tonetool {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kAces = "/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio";

std::string shared_dir() {
    const char* dir = std::getenv("SHARED_DIR");
    return dir ? dir : "";
}

class ViewTest : public testing::Test {
protected:
    ViewTest() {
        options.config = write_text(folder / "config.ocio", kConfig);
        unsetenv("OCIO");
    }

    void open(const std::string& from = "AP1") { transform.open(options, from, header); }
    std::string why(const std::string& from = "AP1") {
        return refusal([&] { open(from); });
    }
    std::vector<float> look(std::vector<float> rgb) {
        open();
        transform.apply(rgb.data(), ptrdiff_t(rgb.size() / 3));
        return rgb;
    }
    std::string light_error(const std::string& encoding = "", std::optional<double> peak = {}) {
        return refusal([&] { light.open({options, encoding, peak}); });
    }

    Folder folder;
    ViewOptions options;
    OIIO::ImageSpec header{4, 4, 3, OIIO::TypeFloat};
    ViewTransform transform;
    DisplayLight light;
};

TEST_F(ViewTest, DefaultsAreThoseOfTheConfiguration) {
    ASSERT_NO_THROW(open());
    EXPECT_EQ(transform.display(), "sRGB");
    EXPECT_EQ(transform.view(), "SDR");
}

TEST_F(ViewTest, NamesAreReportedAsTheConfigurationSpellsThem) {
    options.display = "srgb";
    options.view = "sdr";
    ASSERT_NO_THROW(open("scene_linear"));
    EXPECT_EQ(transform.display(), "sRGB");
    EXPECT_EQ(transform.view(), "SDR");
    EXPECT_EQ(transform.from(), "AP1");
    EXPECT_EQ(transform.space(), "sRGB");
}

TEST_F(ViewTest, EnvironmentNamesTheConfiguration) {
    setenv("OCIO", options.config.c_str(), 1);
    options.config.clear();
    options.view = "SDR";
    EXPECT_NO_THROW(open());
    setenv("OCIO", "/nowhere/config.ocio", 1);
    EXPECT_THAT(why(), AllOf(HasSubstr("/nowhere/config.ocio"), HasSubstr("OCIO"),
                             HasSubstr("does not exist")));
    unsetenv("OCIO");
    EXPECT_THAT(why(), AllOf(HasSubstr("no configuration"), HasSubstr("OCIO")));
}

TEST_F(ViewTest, BrokenConfigurationsAreErrors) {
    options.config = folder / "absent.ocio";
    EXPECT_THAT(why(), AllOf(HasSubstr("absent.ocio"), HasSubstr("does not exist")));
    options.config = folder / "";
    EXPECT_THAT(why(), HasSubstr("is not a file"));
    options.config = write_text(folder / "broken.ocio", "ocio_profile_version: 2\nroles: [a, }\n");
    EXPECT_THAT(why(), AllOf(HasSubstr("broken.ocio"), HasSubstr("yaml"), HasSubstr("line 2")));
    options.config = write_text(folder / "empty.ocio", "");
    EXPECT_THAT(why(), HasSubstr("empty.ocio"));
    options.config = write_text(folder / "bare.ocio", "ocio_profile_version: 2.1\n"
                                                      "roles: {default: raw}\n"
                                                      "colorspaces:\n"
                                                      "  - !<ColorSpace> {name: raw}\n");
    EXPECT_THAT(why(), HasSubstr("no displays"));
}

TEST_F(ViewTest, NewerProfilesAreErrorsThatSayWhatIsRead) {
    for (const char* version : {"2.9", "3"}) {
        std::string text = kConfig;
        text.replace(text.find("2.1"), 3, version);
        options.config = write_text(folder / "newer.ocio", text);
        EXPECT_THAT(why(), AllOf(HasSubstr(std::string("version ") + version),
                                 HasSubstr("reads versions up to")));
    }
}

TEST_F(ViewTest, NothingIsWrittenToStderr) {
    testing::internal::CaptureStderr();
    options.view = "SDR";
    EXPECT_NO_THROW(open());
    std::string text = kConfig;
    text.replace(text.find("default: AP0"), 12, "default: AP1");
    options.config = write_text(folder / "remarkable.ocio", text);
    EXPECT_NO_THROW(open());
    options.config = folder / "absent.ocio";
    EXPECT_THROW(open(), Refusal);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ViewTest, ContextVariablesThatNothingUsesAreErrors) {
    options.view = "SDR";
    options.context = {{"LTU", "a.spi1d"}};
    EXPECT_THAT(why(),
                AllOf(HasSubstr("unknown context variable \"LTU\""), HasSubstr("valid: LUT")));
    options.context = {{"LUT", "a.spi1d"}};
    EXPECT_NO_THROW(open());
    // Declared nowhere, but used; and used by the value of another.
    std::string text = kConfig;
    text.replace(text.find("search_path: \".\""), 16, "search_path: \"$LUTS/%TYPE%\"");
    options.config = write_text(folder / "used.ocio", text);
    options.context = {{"LUTS", "$ROOT/luts"}, {"TYPE", "film"}, {"ROOT", "/shows"}};
    EXPECT_NO_THROW(open());
    options.context = {{"LUTS", "luts"}, {"ROOT", "/shows"}};
    EXPECT_THAT(why(), HasSubstr("unknown context variable \"ROOT\""));
}

TEST_F(ViewTest, UnknownNamesAreErrorsThatListTheValidOnes) {
    options.display = "sRGBB";
    EXPECT_THAT(why(), AllOf(HasSubstr("unknown display \"sRGBB\""), HasSubstr("mean \"sRGB\""),
                             HasSubstr("valid: sRGB, Rec.1886, PQ")));
    options.display = "";
    options.view = "HDR 1000";
    EXPECT_THAT(why(), AllOf(HasSubstr("unknown view \"HDR 1000\""),
                             HasSubstr("valid: SDR, Film, Plain"), HasSubstr("display \"sRGB\"")));
    options.view = "SDR";
    EXPECT_THAT(why("AP2"),
                AllOf(HasSubstr("unknown colour space \"AP2\""), HasSubstr("AP0, AP1")));
    options.looks = "+warm, -cold";
    EXPECT_THAT(why(), AllOf(HasSubstr("unknown look \"cold\""), HasSubstr("warm, dim")));
    options.looks = " , ";
    EXPECT_THAT(why(), HasSubstr("no look"));
}

TEST_F(ViewTest, ViewOfAnAbsentColorSpaceIsAnError) {
    options.view = "Lost";
    EXPECT_THAT(why(), AllOf(HasSubstr("Lost"), HasSubstr("Nowhere"), HasSubstr("does not have")));
}

TEST_F(ViewTest, ViewOfAnAbsentFileIsAnError) {
    options.view = "Film";
    options.context = {{"LUT", "absent.spi1d"}};
    EXPECT_THAT(why(), AllOf(HasSubstr("Film"), HasSubstr("absent.spi1d")));
    options.context = {{"", "absent.spi1d"}};
    EXPECT_THAT(why(), HasSubstr("has no name"));
}

TEST_F(ViewTest, ContextVariablesChooseFiles) {
    write_text(folder / "half.spi1d", lut_text("0.5"));
    write_text(folder / "quarter.spi1d", lut_text("0.25"));
    options.view = "Film";
    options.context = {{"LUT", "half.spi1d"}};
    const std::vector<float> half = look({0.4f, 0.4f, 0.4f});
    options.context = {{"LUT", "quarter.spi1d"}};
    const std::vector<float> quarter = look({0.4f, 0.4f, 0.4f});
    EXPECT_NEAR(half[1], 0.2f, 1e-3f);
    EXPECT_NEAR(quarter[1], 0.1f, 1e-3f);
}

TEST_F(ViewTest, LooksChangePixels) {
    options.view = "Plain";
    const std::vector<float> grey(3, 0.25f);
    const std::vector<float> plain = look(grey);
    options.looks = "warm";
    const std::vector<float> warm = look(grey);
    EXPECT_GT(warm[0], plain[0] + 0.02f);
    EXPECT_LT(warm[2], plain[2] - 0.02f);
    options.view = "Warm";
    EXPECT_EQ(look(grey), warm) << "the view's own look is replaced by the same";
    options.looks = "";
    EXPECT_EQ(look(grey), warm) << "the view's own look";
    options.looks = "+warm, -warm";
    EXPECT_NEAR(look(grey)[0], plain[0], 1e-5f);
    options.looks = "-dim";
    EXPECT_NEAR(look(grey)[1], 0.735357f, 1e-4f) << "sRGB of 0.5";
    EXPECT_EQ(transform.view(), "Warm");
}

TEST_F(ViewTest, SpaceOfTheImageIsFound) {
    options.view = "SDR";
    header.attribute("oiio:ColorSpace", "lin_ap0");
    ASSERT_NO_THROW(open(""));
    EXPECT_EQ(transform.from(), "AP0");
    // The reader's word and the configuration's alias.
    header.attribute("oiio:ColorSpace", "Linear");
    ASSERT_NO_THROW(open(""));
    EXPECT_EQ(transform.from(), "AP1");
    // Chromaticities say more than "Linear".
    const float ap0[8] = {0.7347f, 0.2653f, 0, 1, 0.0001f, -0.077f, 0.32168f, 0.33767f};
    header.attribute("chromaticities", OIIO::TypeDesc("float[8]"), ap0);
    ASSERT_NO_THROW(open(""));
    EXPECT_EQ(transform.from(), "AP0");
}

TEST_F(ViewTest, ImageOfASpaceThatTheConfigurationLacksIsAnError) {
    options.view = "SDR";
    EXPECT_THAT(why(""), AllOf(HasSubstr("rec709"), HasSubstr("lin_rec709"), HasSubstr("from="),
                               HasSubstr("AP0, AP1")));
    header.attribute("oiio:ColorSpace", "nonsense");
    EXPECT_THAT(why(""),
                AllOf(HasSubstr("nonsense"), HasSubstr("AP0, AP1"), Not(HasSubstr("p3-d65"))));
}

std::vector<float> light_of(const kernels::ToneRows& rows, const std::vector<float>& grey,
                            float scale = 1) {
    std::vector<float> out[3];
    for (auto& plane : out)
        plane.resize(grey.size());
    const float* const in[3] = {grey.data(), grey.data(), grey.data()};
    float* const to[3] = {out[0].data(), out[1].data(), out[2].data()};
    rows(in, to, ptrdiff_t(grey.size()), scale);
    for (size_t i = 0; i < grey.size(); ++i) {
        EXPECT_NEAR(out[0][i], out[1][i], 2e-3f);
        EXPECT_NEAR(out[2][i], out[1][i], 2e-3f);
    }
    return out[1];
}

TEST_F(ViewTest, LightOfAPlainViewIsTheSceneClamped) {
    options.view = "Plain";
    for (const char* display : {"sRGB", "Rec.1886"}) {
        options.display = display;
        light.open({options, "", {}});
        EXPECT_EQ(light.name(), std::string(display) + "/Plain");
        const auto out = light_of(light.exact(), {0, 0.125f, 0.25f, 4, INFINITY}, 2);
        const float expected[] = {0, 0.25f, 0.5f, 1, 1};
        for (size_t i = 0; i < out.size(); ++i)
            EXPECT_NEAR(out[i], expected[i], 2e-5f) << display << i;
        EXPECT_NEAR(light.greys({4})[0], 4, 1e-3);
    }
}

TEST_F(ViewTest, LightDoesNotDependOnTheDisplay) {
    options.view = "SDR";
    const std::vector<float> grey = {0.01f, 0.18f, 1, 4, 100};
    options.display = "sRGB";
    light.open({options, "", {}});
    const auto srgb = light_of(light.exact(), grey);
    options.display = "Rec.1886";
    light.open({options, "", {}});
    const auto rec1886 = light_of(light.exact(), grey);
    for (size_t i = 0; i < grey.size(); ++i)
        EXPECT_NEAR(srgb[i], rec1886[i], 2e-5f);
    // Middle grey: 0.356 as sRGB (ACES, SDR video).
    EXPECT_NEAR(srgb[1], 0.104, 1e-3);
}

TEST_F(ViewTest, HighDynamicRangeNeedsAPeak) {
    options.display = "PQ";
    EXPECT_THAT(light_error(), AllOf(HasSubstr("high dynamic range"), HasSubstr("10000 cd/m2"),
                                     HasSubstr("peak=")));
    light.open({options, "", 1000.0});
    const double grey = light.greys({0.18})[0], white = light.greys({1e4})[0];
    EXPECT_NEAR(grey, 0.015, 5e-4) << "15 cd/m2 of 1000";
    EXPECT_NEAR(white, 1, 0.02);
    light.open({options, "", 500.0});
    EXPECT_NEAR(light.greys({0.18})[0], 2 * grey, 1e-5);
    EXPECT_THAT(light_error("", 0.0), AllOf(HasSubstr("peak is 0"), HasSubstr("1 to 10000")));
    EXPECT_THAT(light_error("", NAN), HasSubstr("peak is nan"));
}

TEST_F(ViewTest, SceneReferredViewsNeedAnEncoding) {
    options.config = write_text(folder / "old.ocio", kOldConfig);
    EXPECT_THAT(light_error(), AllOf(HasSubstr("gamma22"), HasSubstr("scene-referred"),
                                     HasSubstr("encoding="), HasSubstr("rec1886")));
    EXPECT_THAT(light_error("gamma"), AllOf(HasSubstr("unknown encoding \"gamma\""),
                                            HasSubstr("srgb, rec1886, gamma2.2")));
    light.open({options, "gamma2.2", {}});
    EXPECT_NEAR(light_of(light.exact(), {0.18f})[0], 0.18f, 1e-5f);
    light.open({options, "linear", {}});
    EXPECT_NEAR(light_of(light.exact(), {0.18f})[0], std::pow(0.18, 1 / 2.2), 1e-5);
    light.open({options, "rec1886", {}});
    EXPECT_NEAR(light_of(light.exact(), {0.18f})[0], std::pow(0.18, 2.4 / 2.2), 1e-5);
    light.open({options, "srgb", {}});
    const double code = std::pow(0.18, 1 / 2.2);
    EXPECT_NEAR(light_of(light.exact(), {0.18f})[0], std::pow((code + 0.055) / 1.055, 2.4), 1e-5);
}

TEST_F(ViewTest, LinearRec709MustBeInTheConfiguration) {
    std::string text = kOldConfig;
    text.replace(text.find("lin_srgb"), 8, "lin_ap1x");
    options.config = write_text(folder / "old.ocio", text);
    EXPECT_THAT(light_error("srgb"), AllOf(HasSubstr("linear Rec.709"), HasSubstr("lin_rec709"),
                                           HasSubstr("aces_interchange")));
}

// Without ../shared: on images of this repository's making.
ImageBuf colors(int width) {
    ImageBuf image(OIIO::ImageSpec(width, 8, 3, OIIO::TypeFloat));
    for (OIIO::ImageBuf::Iterator<float> p(image); !p.done(); ++p) {
        const double t = double(p.x()) / width, s = double(p.y()) / 8;
        p[0] = float(std::exp2(16 * t - 10));
        p[1] = float(std::exp2(10 * std::fmod(5 * t + s, 1.0) - 8));
        p[2] = float(std::exp2(9 * std::fmod(11 * t + s, 1.0) - 7));
    }
    return image;
}

// Largest difference to stock oiiotool, which is to run quietly.
double difference_to_oiiotool(const Folder& folder, const ViewOptions& options,
                              const std::string& input, const std::string& from) {
    // Its own name each time: OpenImageIO remembers files.
    static int calls = 0;
    const std::string output = folder / ("stock" + std::to_string(calls++) + ".exr");
    const std::string command = "oiiotool --colorconfig '" + options.config + "' '" + input +
                                "' --ch 0,1,2 '--ociodisplay:from=" + from + "' '" +
                                options.display + "' '" + options.view + "' -d float -o '" +
                                output + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    const ImageBuf stock = read_whole(output);
    const ImageBuf ours = OIIO::ImageBufAlgo::channels(read_whole(input), 3, {});
    EXPECT_EQ(stock.roi(), ours.roi());
    const size_t pixels = size_t(ours.spec().image_pixels());
    std::vector<float> a(3 * pixels), b(3 * pixels);
    EXPECT_TRUE(ours.get_pixels(ours.roi(), OIIO::TypeFloat, a.data()));
    EXPECT_TRUE(stock.get_pixels(ours.roi(), OIIO::TypeFloat, b.data()));
    ViewTransform transform;
    transform.open(options, from, ours.spec());
    transform.apply(a.data(), ptrdiff_t(pixels));
    double most = 0;
    for (size_t i = 0; i < a.size(); ++i)
        most = std::max(most, double(std::abs(a[i] - b[i])));
    return most;
}

bool has_oiiotool() {
    return std::system("oiiotool --version > /dev/null 2>&1") == 0;
}

TEST_F(ViewTest, EqualsStockOiiotool) {
    if (!has_oiiotool())
        GTEST_SKIP() << "no oiiotool";
    const std::string input = write_file(folder / "colors.exr", colors(256));
    // OpenImageIO 2.5 opens all colour spaces, that of the table which is not there, too.
    write_text(folder / "none.spi1d", lut_text("0.5"));
    for (const auto& [display, view] :
         {std::pair("sRGB", "SDR"), {"Rec.1886", "Plain"}, {"PQ", "HDR 1000"}, {"sRGB", "Warm"}}) {
        options.display = display;
        options.view = view;
        EXPECT_LT(difference_to_oiiotool(folder, options, input, "AP1"), 1e-5) << display << view;
    }
}

TEST_F(ViewTest, EqualsStockOiiotoolOnScenes) {
    if (!has_oiiotool())
        GTEST_SKIP() << "no oiiotool";
    options.config = shared_dir() + kAces;
    if (!OIIO::Filesystem::exists(options.config))
        GTEST_SKIP() << "no " << options.config;
    options.display = "sRGB - Display";
    options.view = "ACES 1.0 - SDR Video";
    for (const char* scene : {"nightstreet", "gallery", "cornell"}) {
        const std::string input = shared_dir() + "/scenes/" + scene + "/ref.exr";
        EXPECT_LT(difference_to_oiiotool(folder, options, input, "lin_rec709"), 1e-5) << scene;
    }
}

} // namespace
} // namespace tonetool
