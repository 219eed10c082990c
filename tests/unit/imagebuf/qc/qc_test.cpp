// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/qc.h"

#include <OpenImageIO/filesystem.h>
#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <limits>
#include <map>

#include "images.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

QcFacts facts_of(const std::vector<const ImageBuf*>& parts, int nthreads = 0) {
    QcFacts facts;
    std::string error;
    EXPECT_TRUE(ToneAlgo::qc_facts(facts, parts, error, {}, nthreads)) << error;
    return facts;
}

QcFacts facts_of(const ImageBuf& image, int nthreads = 0) {
    return facts_of(std::vector<const ImageBuf*>{&image}, nthreads);
}

std::string error_of(const ImageBuf& image, const QcOptions& options = {}) {
    QcFacts facts;
    std::string error;
    EXPECT_FALSE(ToneAlgo::qc_facts(facts, {&image}, error, options));
    return error;
}

void set(ImageBuf& image, int x, int y, int channel, float value) {
    std::vector<float> pixel(size_t(image.nchannels()));
    image.getpixel(x, y, pixel.data());
    pixel[size_t(channel)] = value;
    image.setpixel(x, y, pixel.data());
}

TEST(QcFacts, CountWhatIsNoColourAndWhere) {
    ImageBuf image = constant(make_spec(20, 10, {"R", "G", "B", "A", "Z"}), {1, 2, 3, 1, 5});
    set(image, 7, 2, 1, kNan);
    set(image, 4, 2, 0, kNan);
    set(image, 1, 8, 2, kInf);
    set(image, 0, 0, 2, -0.5f);
    set(image, 3, 3, 4, kInf);
    set(image, 5, 5, 3, 1.25f);
    set(image, 6, 5, 3, kNan);
    set(image, 8, 5, 3, -0.5f);
    const QcFacts facts = facts_of(image);
    ASSERT_EQ(facts.layers.size(), 2U);
    const QcLayer& picture = facts.layers[0];
    EXPECT_EQ(picture.kind, "picture");
    EXPECT_EQ(picture.nan.pixels, 3);
    EXPECT_EQ(picture.nan.first[0].x, 4); // by row, then column
    EXPECT_EQ(picture.nan.first[1].x, 7);
    EXPECT_EQ(picture.nan.first[2].x, 6); // its alpha
    EXPECT_EQ(picture.inf.first[0].y, 8);
    EXPECT_EQ(picture.negative.first[0].value, -0.5);
    EXPECT_EQ(picture.min, -0.5);
    EXPECT_EQ(picture.max, 3);
    EXPECT_EQ(picture.lit, 196);
    EXPECT_EQ(facts.layers[1].name, "Z");
    EXPECT_EQ(facts.layers[1].kind, "depth");
    EXPECT_EQ(facts.layers[1].inf.pixels, 1);
    EXPECT_EQ(facts.picture.alpha_high.first[0].value, 1.25);
    EXPECT_EQ(facts.picture.alpha_low.pixels, 1);
}

TEST(QcFacts, AColourAloneIsConstantAndBlackIsNotLit) {
    const QcFacts red = facts_of(constant(8, 8, {1, 0, 0}));
    EXPECT_TRUE(red.layers[0].constant);
    EXPECT_NEAR(red.layers[0].mean, 0.2126, 1e-12);
    EXPECT_EQ(facts_of(constant(8, 8, {0, 0, 0})).layers[0].lit, 0);
    EXPECT_FALSE(facts_of(noise(8, 8, 1)).layers[0].constant);
}

TEST(QcFacts, DoNotDependOnThreadsNorOnWhereThePixelsAre) {
    const std::string file =
        OIIO::Filesystem::unique_path(testing::TempDir() + "tonetool-qc-%%%%%%%%.exr");
    const ImageBuf image =
        noise(make_spec(301, 207, {"R", "G", "B", "C_key.R", "C_key.G", "C_key.B"}), 3);
    ASSERT_TRUE(image.write(file));
    const ImageBuf unread(file);
    const QcFacts one = facts_of(image, 1);
    for (const QcFacts& other : {facts_of(image, 4), facts_of(unread, 1), facts_of(unread, 3)}) {
        EXPECT_EQ(one.picture.hash, other.picture.hash);
        EXPECT_EQ(one.picture.thumbnail, other.picture.thumbnail);
        EXPECT_EQ(one.picture.peaks, other.picture.peaks);
        EXPECT_EQ(one.picture.group_difference, other.picture.group_difference);
        EXPECT_EQ(one.picture.spike_count, other.picture.spike_count);
        EXPECT_EQ(one.layers[0].mean, other.layers[0].mean);
        EXPECT_EQ(one.layers[1].mean, other.layers[1].mean);
    }
    std::filesystem::remove(file);
}

TEST(QcFacts, ThumbnailsHaveTheLuminanceOfTheDisplayWindow) {
    ImageSpec spec = make_spec(64, 36, {"R", "G", "B"});
    spec.full_width = 128; // the right half has no pixel
    const QcFacts facts = facts_of(constant(spec, {0.25f, 0.25f, 0.25f}));
    EXPECT_EQ(facts.picture.thumbnail[0], -2000);
    EXPECT_EQ(facts.picture.thumbnail[15], -2000);
    EXPECT_EQ(facts.picture.thumbnail[16], QcPicture::kDark);
    EXPECT_THAT(facts.parts[0].data, ElementsAre(0, 0, 64, 36));
    EXPECT_THAT(facts.parts[0].display, ElementsAre(0, 0, 128, 36));
}

TEST(QcFacts, ASpikeIsAloneInItsSurroundings) {
    ImageBuf image = constant(40, 30, {0.5f, 0.5f, 0.5f});
    set(image, 9, 7, 2, 100); // a blue one
    set(image, 10, 7, 2, 60); // beside it: still one spike
    set(image, 20, 20, 0, 3); // not 8 times as large
    for (int y = 0; y < 30; ++y)
        set(image, 30, y, 1, 200); // a line
    const QcPicture picture = facts_of(image).picture;
    ASSERT_EQ(picture.spike_count, 1);
    EXPECT_EQ(picture.spikes[0].x, 9);
    EXPECT_EQ(picture.spikes[0].y, 7);
    EXPECT_EQ(picture.spikes[0].value, 100);
    EXPECT_EQ(picture.spikes[0].around, 0.5);
}

TEST(QcFacts, LightGroupsAddUpWhereThePictureIsNotClamped) {
    ImageBuf image = constant(make_spec(32, 32,
                                        {"R", "G", "B", "C_key.R", "C_key.G", "C_key.B", "C_rim.R",
                                         "C_rim.G", "C_rim.B"}),
                              {1, 1, 1, 0.75f, 0.75f, 0.75f, 0.25f, 0.25f, 0.25f});
    EXPECT_EQ(facts_of(image).picture.groups, 2);
    EXPECT_EQ(facts_of(image).picture.group_difference, 0);
    for (int c = 0; c < 3; ++c) {
        set(image, 5, 5, c, 4); // as far as this picture goes: clamped
        set(image, 5, 5, 3 + c, 70);
    }
    EXPECT_EQ(facts_of(image).picture.group_difference, 0);
    for (int c = 0; c < 3; ++c)
        set(image, 6, 9, 6 + c, 0);
    const QcPicture picture = facts_of(image).picture;
    EXPECT_NEAR(picture.group_difference, 0.25 / 1023, 1e-15);
    EXPECT_NEAR(picture.group_sum, 1 - 0.25 / 1023, 1e-15);
    EXPECT_EQ(picture.group_worst.x, 6);
    EXPECT_EQ(picture.group_worst.y, 9);
}

TEST(QcFacts, PartsAreOneImageWhoseChannelsBearTheirNames) {
    ImageBuf beauty = constant(16, 8, {1, 1, 1});
    ImageBuf group = constant(make_spec(16, 8, {"R", "G", "B"}), {1, 1, 1});
    group.specmod().attribute("oiio:subimagename", "C_key");
    ImageBuf depth = constant(make_spec(16, 8, {"Z"}), {7});
    depth.specmod().attribute("oiio:subimagename", "depth");
    const QcFacts facts = facts_of({&beauty, &group, &depth});
    ASSERT_EQ(facts.layers.size(), 3U);
    EXPECT_EQ(facts.layers[0].kind, "picture");
    EXPECT_EQ(facts.layers[1].kind, "light");
    EXPECT_EQ(facts.layers[2].kind, "depth");
    EXPECT_EQ(facts.layers[2].max, 7);
    EXPECT_EQ(facts.channels[3].first, "C_key.R");
    EXPECT_EQ(facts.picture.groups, 1);
    EXPECT_EQ(facts.picture.group_difference, 0);
}

TEST(QcFacts, FilesOfDataHaveLayersAndNoPicture) {
    const std::vector<std::vector<std::string>> files = {
        {"Z"}, {"N.X", "N.Y", "N.Z"}, {"albedo.R", "albedo.G", "albedo.B"}, {"objectid"}};
    for (const auto& channels : files) {
        ImageBuf image =
            constant(make_spec(8, 4, channels), std::vector<float>(channels.size(), 1));
        set(image, 3, 2, 0, kNan);
        const QcFacts facts = facts_of(image);
        ASSERT_EQ(facts.layers.size(), 1U);
        EXPECT_NE(facts.layers[0].kind, "picture");
        EXPECT_EQ(facts.layers[0].nan.pixels, 1);
        EXPECT_EQ(facts.layers[0].lit, 31);
        EXPECT_EQ(facts.picture.hash.size(), 32U);
        EXPECT_EQ(facts.picture.spike_count, 0);
        EXPECT_EQ(facts.picture.thumbnail.size(), size_t(QcPicture::kWide * QcPicture::kHigh));
    }
}

TEST(QcFacts, OneChannelIsAGreyPicture) {
    ImageBuf image = constant(make_spec(32, 18, {"Y", "Z"}), {0.5f, 9});
    set(image, 3, 2, 0, kInf);
    const QcFacts facts = facts_of(image);
    ASSERT_EQ(facts.layers.size(), 2U);
    EXPECT_EQ(facts.layers[0].kind, "picture");
    EXPECT_EQ(facts.layers[0].inf.pixels, 1);
    EXPECT_EQ(facts.layers[0].max, 0.5);
    EXPECT_EQ(facts.layers[1].kind, "depth");
    EXPECT_EQ(facts.picture.thumbnail[0], -1000);
}

TEST(QcFacts, CountLitPixelsThatAlphaHides) {
    ImageBuf image = constant(make_spec(8, 4, {"R", "G", "B", "A"}), {1, 0, 0, 0});
    set(image, 0, 0, 0, 0);
    set(image, 5, 1, 3, 1);
    const QcFacts facts = facts_of(image);
    EXPECT_EQ(facts.picture.lit, 31);
    EXPECT_EQ(facts.picture.unseen.pixels, 30);
    EXPECT_EQ(facts.picture.unseen.first[0].x, 1);
}

TEST(QcFacts, APlaceOfOneColourIsARectangle) {
    ImageBuf image = noise(make_spec(64, 48, {"R", "G", "B", "A", "Z"}), 3);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x) {
            set(image, x, y, 3, y < 12 ? 0.0f : 1.0f);
            set(image, x, y, 4, y < 24 ? 5.0f : 1e10f);
        }
    const auto fill = [&](int left, int top, float value) {
        for (int y = top; y < top + 10; ++y)
            for (int x = left; x < left + 16; ++x)
                for (int c = 0; c < 3; ++c)
                    set(image, x, y, c, value);
    };
    fill(20, 8, kNan);
    fill(48, 30, 0.25f);
    for (const int threads : {1, 3}) {
        const QcPicture picture = facts_of(image, threads).picture;
        ASSERT_EQ(picture.rectangles.size(), 2U);
        const QcRectangle &bad = picture.rectangles[0], &sky = picture.rectangles[1];
        EXPECT_THAT((std::vector<int>{bad.x, bad.y, bad.width, bad.height}),
                    ElementsAre(20, 8, 16, 10));
        EXPECT_TRUE(std::isnan(bad.color[1]));
        EXPECT_FALSE(bad.background);
        EXPECT_THAT(sky.color, ElementsAre(0.25f, 0.25f, 0.25f));
        EXPECT_TRUE(sky.background);
        // Rows 30 to 39 at the right: the parts of 1.5 rows that hold them; row 39 shares one.
        EXPECT_THAT(std::vector<int>(picture.borders.right.begin() + 19,
                                     picture.borders.right.begin() + 28),
                    ElementsAre(0, 100, 100, 100, 100, 100, 100, 50, 0));
        EXPECT_THAT(picture.borders.left, testing::Each(0));
        EXPECT_EQ(picture.alpha_clear, 0.25);
        EXPECT_EQ(picture.alpha_mean, 0.75);
    }
}

TEST(QcFacts, ValuesThatRepeat) {
    ImageBuf image = noise(make_spec(64, 48, {"R", "G", "B"}), 3);
    EXPECT_THAT(facts_of(image).picture.pairs, ElementsAre(0, 0));
    EXPECT_EQ(facts_of(image).picture.distinct, 1000);
    for (int y = 0; y < 48; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c)
                set(image, x, y, c, 0.1f + 0.01f * float(x / 2));
    for (const int threads : {1, 3}) {
        const QcPicture picture = facts_of(image, threads).picture;
        EXPECT_THAT(picture.pairs, ElementsAre(1, 0));
        EXPECT_EQ(picture.distinct, 32);
        EXPECT_EQ(picture.greens, 64 * 48);
    }
}

TEST(QcFacts, LayersWithoutNoiseHaveAHash) {
    const std::vector<std::string> channels = {
        "R",   "G",   "B",      "depth.Z",  "P.X",      "P.Y",      "P.Z",       "N.X",
        "N.Y", "N.Z", "mist.Z", "vector.X", "vector.Y", "vector.Z", "objectid.X"};
    ImageBuf image = noise(make_spec(20, 12, channels), 4);
    const auto hashes = [&](int threads) {
        std::map<std::string, std::string> found;
        for (const QcLayer& layer : facts_of(image, threads).layers)
            if (!layer.hash.empty())
                found[layer.kind] = layer.hash;
        return found;
    };
    const auto before = hashes(1);
    EXPECT_THAT(before, testing::UnorderedElementsAre(testing::Key("depth"), testing::Key("id"),
                                                      testing::Key("position")));
    EXPECT_EQ(hashes(3), before);
    set(image, 19, 11, 6, 2);
    const auto after = hashes(1);
    EXPECT_NE(after.at("position"), before.at("position"));
    EXPECT_EQ(after.at("depth"), before.at("depth"));
}

TEST(QcFacts, LongMetadataAreKeptByTheirHash) {
    ImageBuf image = constant(4, 4, {1, 1, 1});
    image.specmod().attribute("manifest", std::string(5000, 'x'));
    image.specmod().attribute("Software", "renderer");
    const QcPart part = facts_of(image).parts[0];
    EXPECT_EQ(part.metadata.at("Software"), "renderer");
    EXPECT_THAT(part.metadata.at("manifest"), HasSubstr("5000 characters, SHA-1 "));
}

TEST(QcFacts, SayWhyThereAreNone) {
    EXPECT_THAT(error_of(constant(make_spec(4, 4, {"a.R", "a.G", "a.B", "b.R", "b.G", "b.B"}),
                                  {1, 1, 1, 1, 1, 1})),
                HasSubstr("layer="));
    QcOptions no_such;
    no_such.pixels.layer = "beauty";
    EXPECT_THAT(error_of(constant(make_spec(4, 4, {"Z"}), {1}), no_such), HasSubstr("beauty"));
    QcOptions options;
    options.groups = {"ky"};
    EXPECT_THAT(error_of(constant(make_spec(4, 4, {"R", "G", "B", "C_key.R", "C_key.G", "C_key.B"}),
                                  {1, 1, 1, 1, 1, 1}),
                         options),
                HasSubstr("\"ky\"; did you mean \"key\""));
    EXPECT_THAT(error_of(ImageBuf("no_such.exr")), HasSubstr("no_such.exr"));
    QcFacts facts;
    std::string error;
    EXPECT_FALSE(ToneAlgo::qc_facts(facts, {}, error));
    EXPECT_THAT(error, HasSubstr("no image"));
}

} // namespace
} // namespace tonetool
