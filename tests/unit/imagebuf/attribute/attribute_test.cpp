// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/attribute.h"

#include <OpenImageIO/imagebufalgo.h>
#include <gmock/gmock.h>

#include <functional>

#include "attribute/small_render.h"
#include "imagebuf/attribute/attribute_tables.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const AttributedLight& light_of(const AttributeResult& result, const std::string& name) {
    for (const AttributedLight& light : result.lights)
        if (light.name == name)
            return light;
    throw std::runtime_error("no light " + name);
}

TEST(Attribute, TheSameTwice) {
    const AttributeResult result = attributed(Render(), Render());
    EXPECT_THAT(ToneAlgo::attribute_findings(result), IsEmpty());
    EXPECT_EQ(result.mean, 0);
    ASSERT_EQ(result.lights.size(), 3u);
    ASSERT_EQ(result.mattes.size(), 1u);
    EXPECT_EQ(result.mattes[0].mattes.size(), 3u);
    EXPECT_THAT(result.warnings, IsEmpty());
    EXPECT_THAT(result.manifest_only, IsEmpty());
    EXPECT_EQ(light_of(result, "key").gain, 1);
    EXPECT_EQ(light_of(result, "key").gain_error, 0);
    EXPECT_FALSE(light_of(result, kLightRest).gain);
}

TEST(Attribute, ALightThatIsOffWeakerStrongerNew) {
    Render off, weak, strong, more;
    off.lights.erase("key");
    weak.lights["key"] = 0.5f;
    strong.lights["key"] = 1.5f;
    more.lights["rim"] = 0.5f;
    EXPECT_EQ(findings(attributed(Render(), off).lights), Found({{"key", "off"}}));
    EXPECT_EQ(findings(attributed(Render(), weak).lights), Found({{"key", "weaker"}}));
    EXPECT_EQ(findings(attributed(Render(), strong).lights), Found({{"key", "stronger"}}));
    const AttributeResult with_more = attributed(Render(), more);
    EXPECT_EQ(findings(with_more.lights), Found({{"rim", "new"}}));
    EXPECT_FALSE(light_of(with_more, "rim").gain);
    EXPECT_EQ(with_more.lights.front().name, "rim"); // findings first
}

TEST(Attribute, WhoIsReplacedTakesTheErrorAway) {
    Render off;
    off.lights.erase("key");
    const AttributeResult result = attributed(Render(), off);
    EXPECT_GT(result.mean, 0.05);
    EXPECT_EQ(light_of(result, "key").mean_replaced, 0); // to the bit
    EXPECT_EQ(light_of(result, "key").explains, 1);
    EXPECT_NEAR(*light_of(result, "key").mean_alone, result.mean, 1e-6);
    EXPECT_NEAR(light_of(result, "fill").explains, 0, 1e-6);
    EXPECT_NEAR(*light_of(result, "fill").mean_alone, 0, 1e-6);
    EXPECT_THAT(ToneAlgo::attribute_findings(result),
                ElementsAre("light key: off, explains 100 % of the error"));
}

TEST(Attribute, WithoutWhatEachDoesAlone) {
    Render weak;
    weak.lights["key"] = 0.5f;
    AttributeOptions options;
    options.alone = false;
    const AttributeResult all = attributed(Render(), weak),
                          some = attributed(Render().image(), weak.image(), options);
    EXPECT_FALSE(light_of(some, "key").mean_alone);
    EXPECT_EQ(light_of(some, "key").mean_replaced, light_of(all, "key").mean_replaced);
}

// Every metric has its own mean, and a light that explains all of it.
TEST(Attribute, OfEachMetric) {
    Render off;
    off.lights.erase("key");
    std::vector<std::string> metrics = ToneAlgo::error_metrics();
    metrics.insert(metrics.end(), {"ldrflip", "hdrflip"});
    std::map<double, std::string> means;
    for (const std::string& metric : metrics) {
        AttributeOptions options;
        options.metric = metric;
        const AttributeResult result = attributed(Render().image(), off.image(), options);
        EXPECT_EQ(light_of(result, "key").explains, 1) << metric;
        means[result.mean] = metric;
    }
    EXPECT_EQ(means.size(), metrics.size() - 1); // psnr has the map of mse
}

// All groups and the rest from the reference make the reference, to the bit.
TEST(Attribute, AllReplacedIsTheReference) {
    Render other;
    other.lights = {{"key", 0.37f}, {"fill", 0.61f}};
    const ImageBuf a = Render().image(), b = other.image();
    AttributeInput input;
    input.open({&a}, {&b}, {}, {});
    input.read(1);
    const AttributeOptions options; // the meter keeps a reference
    ErrorMeter meter(input, options, 0, 1);
    for (const size_t side : {size_t(0), size_t(1)}) {
        std::vector<float> rgb;
        exchange_lights(input, side, {0, 1, 2}, rgb);
        EXPECT_EQ(rgb, input.picture()[1 - side]);
    }
    const auto all = [&](std::vector<float>& rgb) { exchange_lights(input, 1, {0, 1, 2}, rgb); };
    EXPECT_THAT(meter.means({all}), ElementsAre(0));
}

TEST(Attribute, ObjectsAreJudgedUnderTheReferencesLight) {
    Render weak;
    weak.lights["key"] = 0.5f;
    const AttributeResult result = attributed(Render(), weak);
    EXPECT_THAT(findings(result.mattes[0].mattes), IsEmpty());
    for (const AttributedMatte& matte : result.mattes[0].mattes)
        EXPECT_NEAR(matte.gain[0], 1, 1e-5) << matte.name;
}

TEST(Attribute, AnotherColourUnderAWeakerLight) {
    Render both;
    both.lights["key"] = 0.5f;
    both.ball_color = {0.6f, 0.5f, 0.4f};
    const AttributeResult result = attributed(Render(), both);
    EXPECT_EQ(findings(result.lights), Found({{"key", "weaker"}}));
    EXPECT_EQ(findings(result.mattes[0].mattes), Found({{"ball", "other colour"}}));
}

TEST(Attribute, AnObjectThatMoved) {
    Render moved;
    moved.ball_x = 14;
    const AttributeResult result = attributed(Render(), moved);
    EXPECT_EQ(findings(result.mattes[0].mattes),
              Found({{"ball", "moved or reshaped"}, {"floor", "uncovered or hidden"}}));
    EXPECT_EQ(findings(result.layers), Found({{"View.Depth", "changed"}}));
    EXPECT_EQ(result.layers[0].changed, 144);
    EXPECT_THAT(result.layers[0].most_under,
                ElementsAre(std::pair("floor", 0.5), std::pair("ball", 0.5)));
    double mass = 0;
    for (const AttributedMatte& matte : result.mattes[0].mattes)
        mass += matte.mass;
    EXPECT_NEAR(mass, 1, 1e-9);
    EXPECT_THAT(ToneAlgo::attribute_findings(result),
                testing::Contains(HasSubstr("object ball: moved or reshaped (+6.0, +0.0 pixels)")));
}

TEST(Attribute, AnObjectThatIsGoneIsInOneManifestAlone) {
    Render gone;
    gone.ball = false;
    const AttributeResult result = attributed(Render(), gone), back = attributed(gone, Render());
    EXPECT_EQ(findings(result.mattes[0].mattes).at("ball"), "missing");
    EXPECT_EQ(findings(back.mattes[0].mattes).at("ball"), "new");
    ASSERT_EQ(result.manifest_only.size(), 1u);
    EXPECT_EQ(result.manifest_only[0].type, "View.CryptoObject");
    EXPECT_THAT(result.manifest_only[0].reference, ElementsAre("ball"));
    EXPECT_THAT(back.manifest_only[0].test, ElementsAre("ball"));
    // What one side gains the other loses.
    for (const AttributedMatte& a : result.mattes[0].mattes)
        for (const AttributedMatte& b : back.mattes[0].mattes)
            if (a.name == b.name) {
                EXPECT_EQ(a.gained, b.lost) << a.name;
                EXPECT_EQ(a.lost, b.gained) << a.name;
            }
}

TEST(Attribute, AnAlbedoIsToldByItsLight) {
    ImageBuf test = Render().image();
    for (ImageBuf::Iterator<float> p(test); !p.done(); ++p)
        for (int c = 10; c < 13; ++c)
            p[c] = p[c] * 0.8f;
    const AttributeResult darker = attributed(Render().image(), test);
    EXPECT_EQ(findings(darker.layers), Found({{"View.DiffCol", "weaker"}}));
    for (const AttributedLayer& layer : darker.layers)
        if (layer.name == "View.DiffCol") {
            EXPECT_NEAR(*layer.gain, 0.8, 1e-6);
            EXPECT_EQ(layer.unit, "SMAPE");
            EXPECT_GT(layer.mean, 0.1);
        }
}

TEST(Attribute, ThreadsAndMemoryChangeNoBit) {
    Render other;
    other.lights["key"] = 0.7f;
    other.ball_x = 12;
    const ImageBuf a = Render().image(), b = other.image();
    AttributeOptions little;
    little.memory = 300 << 10; // one test at a time
    const AttributeResult one = attributed(a, b, {}, 1);
    for (const AttributeResult& same : {attributed(a, b, {}, 4), attributed(a, b, little, 3)}) {
        EXPECT_EQ(same.mean, one.mean);
        for (size_t i = 0; i < one.lights.size(); ++i) {
            EXPECT_EQ(same.lights[i].mean_replaced, one.lights[i].mean_replaced);
            EXPECT_EQ(same.lights[i].mean_alone, one.lights[i].mean_alone);
            EXPECT_EQ(same.lights[i].gain, one.lights[i].gain);
        }
        for (size_t i = 0; i < one.mattes[0].mattes.size(); ++i) {
            EXPECT_EQ(same.mattes[0].mattes[i].mass, one.mattes[0].mattes[i].mass);
            EXPECT_EQ(same.mattes[0].mattes[i].gain, one.mattes[0].mattes[i].gain);
        }
        EXPECT_EQ(same.layers[0].mean, one.layers[0].mean);
    }
    little.memory = 10 << 10;
    EXPECT_THAT(refused(a, b, little), HasSubstr("the layers of both images need"));
}

TEST(Attribute, AMapThatIsThereIsTaken) {
    Render moved;
    moved.ball_x = 14;
    const ImageBuf a = Render().image(), b = moved.image();
    const ImageBuf map = constant(make_spec(Render::kWidth, Render::kHeight, {"Y"}), {0.25f});
    AttributeResult result;
    std::string error;
    ASSERT_TRUE(ToneAlgo::attribute(result, {&a}, {&b}, error, {}, &map));
    EXPECT_EQ(result.mean, 0.25);
    for (const AttributedMatte& matte : result.mattes[0].mattes) {
        EXPECT_NEAR(matte.mass,
                    (matte.pixels_reference + matte.pixels_test) / 2 /
                        (Render::kWidth * Render::kHeight),
                    1e-12);
        EXPECT_NEAR(matte.mean, 0.25, 1e-12);
    }
}

TEST(Attribute, WhatOneSideLacks) {
    Render plain;
    plain.lights.clear();
    const AttributeResult result = attributed(Render(), plain);
    EXPECT_THAT(result.lights, IsEmpty());
    EXPECT_THAT(result.warnings, ElementsAre("the test has no light groups, so lights are not "
                                             "told"));
    const ImageBuf bare = constant(Render::kWidth, Render::kHeight, {0.5f, 0.5f, 0.5f});
    const AttributeResult least = attributed(bare, bare);
    EXPECT_THAT(least.lights, IsEmpty());
    EXPECT_THAT(least.mattes, IsEmpty());
    EXPECT_THAT(least.layers, IsEmpty());
    EXPECT_THAT(least.warnings, ElementsAre(HasSubstr("so nothing can be told")));
}

// Rows of tables as texts, to compare all of them.
std::vector<std::string> texts(const AttributeResult& result) {
    std::vector<std::string> texts;
    using OIIO::Strutil::fmt::format;
    for (const AttributedLight& l : result.lights)
        texts.push_back(format("{} {} {} {}", l.name, l.finding, l.mean_replaced, *l.mean_alone));
    for (const AttributedMatte& m : result.mattes.at(0).mattes)
        texts.push_back(format("{} {} {} {} {}", m.name, m.finding, m.mass, m.gain[1], m.changed));
    for (const AttributedLayer& l : result.layers)
        texts.push_back(format("{} {} {} {} {}", l.name, l.finding, l.mean, l.max, l.changed));
    return texts;
}

// Each with what it needs, as renderers write them: names of parts in the names of channels.
TEST(Attribute, LayersInPartsOfTheirOwn) {
    Render moved;
    moved.ball_x = 14;
    moved.lights["key"] = 0.5f;
    const ImageBuf a = Render().image(), b = moved.image();
    std::vector<ImageBuf> parts[2];
    for (const ImageBuf* whole : {&a, &b})
        for (const auto& [begin, end] : {std::pair(0, 3), {3, 9}, {9, 13}, {13, 17}}) {
            std::vector<int> channels;
            for (int c = begin; c < end; ++c)
                channels.push_back(c);
            parts[whole == &b].push_back(
                OIIO::ImageBufAlgo::channels(*whole, int(channels.size()), channels));
        }
    std::vector<const ImageBuf*> sides[2];
    for (size_t side = 0; side < 2; ++side)
        for (const ImageBuf& part : parts[side])
            sides[side].push_back(&part);
    AttributeResult result;
    std::string error;
    ASSERT_TRUE(ToneAlgo::attribute(result, sides[0], sides[1], error)) << error;
    EXPECT_EQ(texts(result), texts(attributed(a, b)));
    EXPECT_EQ(result.lights.front().finding, "weaker");
}

TEST(Attribute, WhereThePixelsLieIsNoMatter) {
    Render moved;
    moved.ball_x = 14;
    ImageBuf a = Render().image(), b = moved.image();
    const std::vector<std::string> there = texts(attributed(a, b));
    for (ImageBuf* image : {&a, &b}) {
        image->set_origin(-5, 7);
        image->set_full(-5, -5 + Render::kWidth, 7, 7 + Render::kHeight, 0, 1);
    }
    EXPECT_EQ(texts(attributed(a, b)), there);
}

TEST(Attribute, OtherDisplayWindowsAreRefusedOrCropped) {
    const ImageBuf a = Render().image();
    ImageBuf b = Render().image();
    b.set_full(0, 30, 0, Render::kHeight, 0, 1);
    EXPECT_THAT(refused(a, b), HasSubstr("display window"));
    AttributeOptions options;
    options.size = SizePolicy::Crop;
    const AttributeResult result = attributed(a, b, options);
    double pixels = 0;
    for (const AttributedMatte& matte : result.mattes[0].mattes)
        pixels += matte.pixels_reference;
    EXPECT_EQ(pixels, 30 * Render::kHeight);
}

TEST(Attribute, WhatIsRefused) {
    const ImageBuf a = Render().image();
    AttributeOptions options;
    options.size = SizePolicy::Resize;
    EXPECT_THAT(refused(a, a, options), HasSubstr("resized have no ids"));
    options = {};
    options.metric = "flip";
    EXPECT_THAT(refused(a, a, options), HasSubstr("unknown metric \"flip\""));
    const Folder folder;
    const UnreadFile half(write_file(folder / "half.exr", a, {OIIO::TypeHalf}));
    EXPECT_THAT(refused(a, half.image), HasSubstr("been through half, which destroys them"));
    for (const char* lossy : {"pxr24", "dwaa", "b44"}) {
        const UnreadFile file(
            write_file(folder / (std::string(lossy) + ".exr"), a, {OIIO::TypeFloat, lossy}));
        EXPECT_THAT(refused(a, file.image), HasSubstr(std::string("been through ") + lossy));
    }
}

} // namespace
} // namespace tonetool
