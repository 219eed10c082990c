// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/attribute.h"

#include <OpenImageIO/imagebufalgo.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "files.h"
#include "imagebuf/attribute/attribute_tables.h"
#include "metrics/coverage.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A small render: two lights on a floor, with a box and a ball, ids, depth, an albedo.
struct Render {
    static constexpr int kWidth = 48, kHeight = 32;

    std::map<std::string, float> lights{{"key", 1.f}, {"fill", 0.25f}}; ///< by group, their power
    std::array<float, 3> ball_color{0.5f, 0.5f, 0.5f};
    int ball_x = 8;
    bool ball = true;
    std::string manifest_file; ///< instead of the header
    std::map<std::string, std::string> attributes;

    bool is_ball(int x, int y) const {
        return ball && x >= ball_x && x < ball_x + 10 && y >= 10 && y < 22;
    }
    static bool is_box(int x, int y) { return x >= 30 && x < 42 && y >= 6 && y < 26; }
    const char* object(int x, int y) const {
        return is_ball(x, y) ? "ball" : is_box(x, y) ? "box" : "floor";
    }
    std::string manifest() const {
        nlohmann::ordered_json json;
        for (const char* name : {"floor", "box", "ball", "hidden"})
            if (ball || std::strcmp(name, "ball") != 0)
                json[name] = OIIO::Strutil::fmt::format("{:08x}", metrics::cryptomatte_id(name));
        return json.dump();
    }

    ImageBuf image() const {
        std::vector<std::string> channels{"View.Combined.R", "View.Combined.G", "View.Combined.B"};
        for (const auto& [name, power] : lights)
            for (const char* c : {".R", ".G", ".B"})
                channels.push_back("View.Combined_" + name + c);
        for (const char* more : {"View.Depth.Z", "View.DiffCol.R", "View.DiffCol.G",
                                 "View.DiffCol.B", "View.CryptoObject00.r", "View.CryptoObject00.g",
                                 "View.CryptoObject00.b", "View.CryptoObject00.a"})
            channels.emplace_back(more);
        ImageSpec spec = make_spec(kWidth, kHeight, channels);
        const std::string start = "cryptomatte/1234567/";
        spec.attribute(start + "name", "View.CryptoObject");
        spec.attribute(start + "hash", "MurmurHash3_32");
        spec.attribute(start + "conversion", "uint32_to_float32");
        spec.attribute(manifest_file.empty() ? start + "manifest" : start + "manif_file",
                       manifest_file.empty() ? manifest() : manifest_file);
        for (const auto& [name, value] : attributes)
            spec.attribute(start + name, value);
        ImageBuf buf(spec);
        for (ImageBuf::Iterator<float> p(buf); !p.done(); ++p)
            paint(p);
        return buf;
    }

private:
    void paint(ImageBuf::Iterator<float>& p) const {
        const std::string name = object(p.x(), p.y());
        const std::array<float, 3> color =
            name == "ball" ? ball_color : std::array<float, 3>{0.8f, 0.7f, 0.6f};
        int c = 3;
        std::array<float, 3> sum{};
        for (const auto& [light, power] : lights)
            for (size_t k = 0; k < 3; ++k) {
                // Each light falls off to its own side.
                const int way = light == "key" ? p.x() : kWidth - p.x();
                const float value = power * color[k] * float(4 + way) / 32;
                p[c++] = value;
                sum[k] += value;
            }
        for (size_t k = 0; k < 3; ++k)
            p[int(k)] = sum[k];
        p[c++] = name == "ball" ? 3.f : name == "box" ? 4.f : 6.f;
        for (const float albedo : color)
            p[c++] = albedo;
        const uint32_t id = metrics::cryptomatte_id(name);
        float bits = 0;
        std::memcpy(&bits, &id, sizeof bits);
        p[c++] = bits;
        p[c] = 1;
    }
};

AttributeResult attributed(const ImageBuf& reference, const ImageBuf& test,
                           const AttributeOptions& options = {}, int nthreads = 1) {
    AttributeResult result;
    std::string error;
    EXPECT_TRUE(
        ToneAlgo::attribute(result, {&reference}, {&test}, error, options, nullptr, nthreads))
        << error;
    return result;
}
AttributeResult attributed(const Render& reference, const Render& test) {
    return attributed(reference.image(), test.image());
}

std::string refused(const ImageBuf& reference, const ImageBuf& test,
                    const AttributeOptions& options = {}) {
    AttributeResult result;
    std::string error;
    EXPECT_FALSE(ToneAlgo::attribute(result, {&reference}, {&test}, error, options));
    return error;
}

template <class Rows>
std::map<std::string, std::string> findings(const Rows& rows) {
    std::map<std::string, std::string> found;
    for (const auto& row : rows)
        if (!row.finding.empty())
            found[row.name] = row.finding;
    return found;
}
using Found = std::map<std::string, std::string>;

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
    ErrorMeter meter(input, {}, 0, 1);
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

// ---- manifests

// Warnings about a manifest, and the names that the table has.
struct Told {
    std::vector<std::string> warnings, names;
};
Told told(const Render& render, const std::string& folder = "") {
    ImageBuf image = render.image();
    const UnreadFile file(folder.empty() ? "" : write_file(folder + "/a.exr", image));
    const ImageBuf& used = folder.empty() ? image : file.image;
    const AttributeResult result = attributed(used, used);
    Told told{result.warnings, {}};
    if (!result.mattes.empty())
        for (const AttributedMatte& matte : result.mattes[0].mattes)
            told.names.push_back(matte.name);
    std::sort(told.names.begin(), told.names.end());
    return told;
}

std::vector<std::string> unnamed() {
    std::vector<std::string> names;
    for (const char* name : {"ball", "box", "floor"})
        names.push_back(OIIO::Strutil::fmt::format("<{:08x}>", metrics::cryptomatte_id(name)));
    std::sort(names.begin(), names.end());
    return names;
}

TEST(Manifests, InTheHeaderOrBesideTheFile) {
    EXPECT_THAT(told(Render()).names, ElementsAre("ball", "box", "floor"));
    const Folder folder;
    std::filesystem::create_directory(folder / "manifests");
    std::ofstream(folder / "manifests/a.json") << Render().manifest();
    Render beside;
    beside.manifest_file = "manifests/a.json";
    const Told good = told(beside, folder / "");
    EXPECT_THAT(good.names, ElementsAre("ball", "box", "floor"));
    EXPECT_THAT(good.warnings, IsEmpty());
}

TEST(Manifests, PathsThatLeaveTheFolderAreRefused) {
    const Folder folder;
    std::filesystem::create_directory(folder / "images");
    std::ofstream(folder / "a.json") << Render().manifest();
    Render render;
    for (const std::string& path :
         {std::string("../a.json"), folder / "a.json", std::string("x/../../a.json"),
          std::string("..\\a.json"), std::string("../../../../etc/passwd")}) {
        render.manifest_file = path;
        const Told result = told(render, folder / "images");
        EXPECT_EQ(result.names, unnamed()) << path;
        ASSERT_EQ(result.warnings.size(), 2u) << path; // of each side
        EXPECT_THAT(result.warnings[0], HasSubstr("must lie in the folder of the image"));
    }
    render.manifest_file = "nothing.json";
    EXPECT_THAT(told(render, folder / "images").warnings[0], HasSubstr("is no file"));
    ASSERT_EQ(mkfifo((folder / "images/pipe").c_str(), 0600), 0);
    render.manifest_file = "pipe"; // would wait for ever
    EXPECT_THAT(told(render, folder / "images").warnings[0], HasSubstr("is no file"));
}

TEST(Manifests, WhatIsNoManifestLeavesNamesUnknown) {
    Render render;
    for (const char* text : {"{", "[]", "[\"a\"]", "{\"a\": 1}", "{\"a\": {\"b\": \"1\"}}",
                             "{\"a\": [\"1\"]}", "null", "\"a\"", "{\"a\": \"0\"", "\xff\xfe"}) {
        render.attributes["manifest"] = text;
        const Told result = told(render);
        EXPECT_EQ(result.names, unnamed()) << text;
        ASSERT_FALSE(result.warnings.empty()) << text;
        EXPECT_THAT(result.warnings[0], HasSubstr("no JSON object of names and ids")) << text;
    }
    render.attributes["manifest"] = std::string(200000, '[');
    EXPECT_EQ(told(render).names, unnamed());
}

TEST(Manifests, IdsAreLookedAt) {
    Render render;
    render.attributes["manifest"] = R"({"ball": "no id", "floor": "123456789", "box": ""})";
    EXPECT_THAT(told(render).warnings[0], HasSubstr("3 id(s) that are no hexadecimal numbers"));
    render.attributes["manifest"] =
        OIIO::Strutil::fmt::format(R"({{"cube": "{:08x}"}})", metrics::cryptomatte_id("box"));
    const Told other = told(render);
    EXPECT_THAT(other.names, testing::Contains("cube")); // what the file says, with a warning
    EXPECT_THAT(other.warnings[0], HasSubstr("1 name(s) another id than their hash, first "
                                             "\"cube\""));
    // Of a name that is there twice the last counts.
    render.attributes["manifest"] = OIIO::Strutil::fmt::format(
        R"({{"box": "00000001", "box": "{:08x}"}})", metrics::cryptomatte_id("box"));
    EXPECT_THAT(told(render).names, testing::Contains("box"));
}

TEST(Manifests, AMillionNames) {
    std::string text = "{";
    for (int i = 0; i < 1000000; ++i)
        text += "\"n" + std::to_string(i % 900000) + "\":\"" +
                OIIO::Strutil::fmt::format("{:08x}", i) + "\",";
    text += Render().manifest().substr(1);
    Render render;
    render.attributes["manifest"] = text;
    const ImageBuf many = render.image(), few = Render().image();
    const auto begin = std::chrono::steady_clock::now();
    const AttributeResult result = attributed(few, many);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
    ASSERT_EQ(result.manifest_only.size(), 1u);
    EXPECT_EQ(result.manifest_only[0].test.size(), 1000u);
    EXPECT_THAT(result.warnings,
                testing::Contains(HasSubstr("900000 name(s) of View.CryptoObject are in one")));
}

TEST(Manifests, OtherHashesAreNotLookedAt) {
    for (const char* name : {"hash", "conversion"}) {
        Render render;
        render.attributes[name] = "other";
        const Told result = told(render);
        EXPECT_THAT(result.names, IsEmpty());
        EXPECT_THAT(result.warnings[0], HasSubstr("View.CryptoObject is not looked at"));
    }
}

// ---- goldens

std::string shared_folder(const std::string& name) {
    const char* dir = std::getenv("SHARED_DIR");
    const std::string folder = std::string(dir ? dir : "") + "/" + name;
    return dir && std::filesystem::exists(folder) ? folder : "";
}

#define SHARED_OR_SKIP(variable, name)                                                             \
    const std::string variable = shared_folder(name);                                              \
    if (variable.empty())                                                                          \
    GTEST_SKIP() << "no " name " below SHARED_DIR"

TEST(AttributeGoldens, EveryOddityOfCryptomatte) {
    SHARED_OR_SKIP(folder, "golden/suites/tiny");
    const UnreadFile reference(folder + "/ref.exr"), test(folder + "/test.exr"),
        map(folder + "/map.exr");
    AttributeResult result;
    std::string error;
    ASSERT_TRUE(
        ToneAlgo::attribute(result, {&reference.image}, {&test.image}, error, {}, &map.image))
        << error;
    EXPECT_THAT(result.warnings, IsEmpty());
    const auto expected = nlohmann::json::parse(std::ifstream(folder + "/expected.json"));
    ASSERT_EQ(result.mattes.size(), 1u);
    EXPECT_EQ(result.mattes[0].mattes.size(), expected.size());
    double mass = 0;
    for (const AttributedMatte& row : result.mattes[0].mattes) {
        ASSERT_TRUE(expected.contains(row.name)) << row.name;
        const auto& wanted = expected[row.name];
        EXPECT_NEAR(row.pixels_reference, wanted["pixels_reference"].get<double>(), 1e-6);
        EXPECT_NEAR(row.pixels_test, wanted["pixels_test"].get<double>(), 1e-6);
        EXPECT_NEAR(row.mass, wanted["mass"].get<double>(), 1e-6) << row.name;
        mass += row.mass;
    }
    EXPECT_NEAR(mass, 1, 1e-9);
}

} // namespace
} // namespace tonetool
