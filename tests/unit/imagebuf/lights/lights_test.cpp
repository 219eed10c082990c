// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/lights.h"

#include <gmock/gmock.h>

#include "files.h"
#include "images.h"
#include "tonetool/cgtmo.h"
#include "tonetool/qc.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using ToneAlgo::light_index;
using ToneAlgo::panorama_stats;

constexpr const char* kGallery = TESTIMAGES_DIR "/gallery_ref.exr";

ImageBuf gallery() {
    ImageBuf image(kGallery);
    image.read(0, 0, true, OIIO::TypeFloat);
    return image;
}

TEST(LightIndex, IsThatOfTheGroupWithTheLargestLuminance) {
    const ImageBuf image = gallery();
    LightIndexSummary summary;
    const ImageBuf index = light_index(image, {}, {}, &summary);
    ASSERT_FALSE(index.has_error()) << index.geterror();
    EXPECT_THAT(index.spec().channelnames, ElementsAre("lightindex"));
    ASSERT_EQ(summary.groups.size(), 4u);
    const auto& spec = image.spec();
    int64_t counted = summary.unlit;
    for (const auto& group : summary.groups)
        counted += group.pixels;
    EXPECT_EQ(counted, spec.image_pixels());
    for (ImageBuf::ConstIterator<float> p(image); !p.done(); ++p) {
        double largest = 0;
        int at = -1;
        for (size_t g = 0; g < 4; ++g) {
            double l = 0;
            const double weights[3] = {0.2126, 0.7152, 0.0722};
            for (size_t c = 0; c < 3; ++c)
                l += weights[c] *
                     double(p[spec.channelindex(summary.groups[g].layer + "." + "RGB"[c])]);
            // A tie within the rounding of floats may fall either way.
            if (l > largest * (1 + 1e-6)) {
                largest = l;
                at = int(g);
            } else if (l > largest * (1 - 1e-6) && l > 0) {
                at = -2;
            }
        }
        if (at != -2)
            ASSERT_EQ(index.getchannel(p.x(), p.y(), 0, 0), float(at)) << p.x() << " " << p.y();
    }
}

TEST(LightIndex, DependsNeitherOnThreadsNorRegionsNorReading) {
    const ImageBuf image = gallery();
    const ImageBuf all = light_index(image, {}, {}, nullptr, {}, 1);
    EXPECT_EQ(largest_difference(all, light_index(image, {}, {}, nullptr, {}, 3)), 0);
    const UnreadFile file(kGallery);
    EXPECT_EQ(largest_difference(all, light_index(file.image)), 0);
    const ROI roi(10, 50, 20, 70);
    const ImageBuf part = light_index(image, {}, {}, nullptr, roi);
    EXPECT_EQ(part.roi().ybegin, 20);
    for (ImageBuf::ConstIterator<float> p(part); !p.done(); ++p)
        ASSERT_EQ(p[0], all.getchannel(p.x(), p.y(), 0, 0));
}

TEST(LightIndex, AddsGroupsUpAsQcDoes) {
    ImageSpec spec = make_spec(
        40, 30, {"R", "G", "B", "C_key.R", "C_key.G", "C_key.B", "C_env.R", "C_env.G", "C_env.B"});
    spec.attribute("oiio:ColorSpace", "acescg"); // its saturated colours are negative in Rec.709
    for (const ImageBuf& image :
         {gallery(), noise(spec, 7), constant(spec, {1, 1, 1, 1, 0, 0, 1, 1, 1})}) {
        LightIndexSummary summary;
        const ImageBuf index = light_index(image, {}, {}, &summary);
        ASSERT_FALSE(index.has_error()) << index.geterror();
        QcFacts facts;
        std::string error;
        ASSERT_TRUE(ToneAlgo::qc_facts(facts, {&image}, error)) << error;
        EXPECT_EQ(facts.picture.groups, int(summary.groups.size()));
        EXPECT_EQ(facts.picture.group_sum, summary.sum);
        EXPECT_EQ(facts.picture.group_difference, summary.difference);
    }
}

// Pixels that are no numbers are black: a group of nothing else does not make the others add up.
TEST(LightIndex, AGroupThatIsNotFiniteIsMissedInTheSum) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const ImageSpec spec = make_spec(
        16, 8,
        {"R", "G", "B", "C_key.R", "C_key.G", "C_key.B", "C_fill.R", "C_fill.G", "C_fill.B"});
    for (const std::vector<float>& key : {std::vector<float>{nan, nan, nan}, {0.9f, nan, 0.9f}}) {
        const ImageBuf image = constant(spec, {1, 1, 1, key[0], key[1], key[2], 0.1f, 0.1f, 0.1f});
        LightIndexSummary summary;
        ASSERT_FALSE(light_index(image, {}, {}, &summary).has_error());
        EXPECT_NEAR(summary.difference, 0.9, 1e-6);
        EXPECT_THAT(summary.warnings, Contains(HasSubstr("add up")));
    }
}

TEST(LightIndex, SaysWhatIsWrong) {
    const ImageBuf plain = noise(8, 8, 1);
    EXPECT_THAT(light_index(plain).geterror(), HasSubstr("light_index: no light groups"));
    LightOptions options;
    options.groups = {"kee"};
    EXPECT_THAT(light_index(gallery(), options).geterror(), HasSubstr("did you mean \"key\""));
    options = {};
    options.table = "nowhere.csv";
    EXPECT_THAT(light_index(gallery(), options).geterror(), HasSubstr("no such file"));
    EXPECT_THAT(light_index(gallery(), {}, {}, nullptr, ROI(900, 901, 0, 1)).geterror(),
                HasSubstr("no pixel"));
    EXPECT_THAT(light_index(ImageBuf("nowhere.exr")).geterror(), HasSubstr("nowhere.exr"));
}

TEST(PanoramaStats, WeighTexelsByTheirSolidAngle) {
    // The upper quarter of the rows covers (1 - cos 45) / 2 of the sphere.
    ImageBuf image = constant(8, 4, {1, 1, 1});
    for (int x = 0; x < 8; ++x)
        image = with_pixel(image, x, 0, {9, 9, 9});
    PanoramaStats stats;
    std::string error;
    ASSERT_TRUE(panorama_stats(stats, image, error)) << error;
    const double share = (1 - std::sqrt(0.5)) / 2;
    EXPECT_NEAR(stats.mean, 1 + 8 * share, 1e-5);
    EXPECT_NEAR(stats.geometric, std::pow(9, share), 1e-5);
    EXPECT_NEAR(stats.harmonic, 1 / (1 - share + share / 9), 1e-5);
    EXPECT_NEAR(stats.median, 1, 1e-6);
    EXPECT_NEAR(stats.max, 9, 1e-5);
    ASSERT_TRUE(panorama_stats(stats, image, error, {{}, "none"})) << error;
    EXPECT_NEAR(stats.mean, 3, 1e-5);
}

TEST(PanoramaStats, DependNeitherOnThreadsNorReading) {
    PanoramaStats one, many;
    std::string error;
    const std::string file = TESTIMAGES_DIR "/gallery_pano.exr";
    ImageBuf image(file);
    image.read(0, 0, true, OIIO::TypeFloat);
    ASSERT_TRUE(panorama_stats(one, image, error, {}, 1)) << error;
    ASSERT_TRUE(panorama_stats(many, ImageBuf(file), error, {}, 3)) << error;
    EXPECT_EQ(one.geometric, many.geometric);
    EXPECT_EQ(one.harmonic, many.harmonic);
    EXPECT_EQ(one.mean, many.mean);
    EXPECT_EQ(one.median, many.median);
    EXPECT_EQ(one.layer, "ViewLayer.Combined");
    EXPECT_FALSE(panorama_stats(one, noise(7, 4, 1), error));
    EXPECT_THAT(error, HasSubstr("7 x 4"));
    EXPECT_FALSE(panorama_stats(one, ImageBuf("nowhere.exr"), error));
}

TEST(CgTmo, TellsWhereItsLuminancesComeFrom) {
    CgTmoOptions options;
    options.filter = "none";
    options.lights.table = TESTIMAGES_DIR "/gallery_lights.json";
    options.env = TESTIMAGES_DIR "/gallery_pano.exr";
    CgTmoSummary summary;
    const ImageBuf out = ToneAlgo::cg_tmo(gallery(), options, &summary);
    ASSERT_FALSE(out.has_error()) << out.geterror();
    EXPECT_EQ(summary.maximum_from, "lights");
    EXPECT_EQ(summary.maximum_light, "key");
    EXPECT_NEAR(summary.maximum, 0.2126 * 100 + 0.7152 * 97 + 0.0722 * 92, 1e-3);
    EXPECT_EQ(summary.adaptation_from, "env");
    EXPECT_EQ(out.spec().get_string_attribute("tonemap:maximum_light"), "key");
    EXPECT_EQ(out.spec().get_string_attribute("tonemap:adaptation_from"), "env");
}

} // namespace
} // namespace tonetool
