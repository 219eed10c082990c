// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "images.h"
#include "tonetool/pixels.h"

namespace tonetool {
namespace {

using Names = std::vector<std::string>;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using ToneAlgo::find_color;

const Names kBlender = {
    "ViewLayer.Combined.R",       "ViewLayer.Combined.G",       "ViewLayer.Combined.B",
    "ViewLayer.Combined.A",       "ViewLayer.Depth.Z",          "ViewLayer.Normal.X",
    "ViewLayer.Normal.Y",         "ViewLayer.Normal.Z",         "ViewLayer.DiffCol.R",
    "ViewLayer.DiffCol.G",        "ViewLayer.DiffCol.B",        "ViewLayer.Emit.R",
    "ViewLayer.Emit.G",           "ViewLayer.Emit.B",           "ViewLayer.CryptoObject00.r",
    "ViewLayer.CryptoObject00.g", "ViewLayer.CryptoObject00.b", "ViewLayer.CryptoObject00.a"};

Names rgb_of(const std::string& layer) {
    return {layer + ".R", layer + ".G", layer + ".B"};
}

Names join(const std::vector<Names>& parts) {
    Names out;
    for (const Names& part : parts)
        out.insert(out.end(), part.begin(), part.end());
    return out;
}

struct Chosen {
    Names channels;
    std::string asked;
    int r, g, b, a;
    std::string layer;
};

TEST(FindColor, FindsTheColor) {
    const Chosen cases[] = {
        {{"R", "G", "B"}, "", 0, 1, 2, -1, ""},
        {{"R", "G", "B", "A"}, "", 0, 1, 2, 3, ""},
        {{"A", "B", "G", "R"}, "", 3, 2, 1, 0, ""},
        {{"r", "g", "b"}, "", 0, 1, 2, -1, ""},
        {{"Z", "B", "X", "R", "G"}, "", 3, 4, 1, -1, ""},
        {{"red", "green", "blue", "alpha"}, "", 0, 1, 2, 3, ""},
        {join({rgb_of("albedo"), {"R", "G", "B"}, rgb_of("beauty")}), "", 3, 4, 5, -1, ""},
        {kBlender, "", 0, 1, 2, 3, "ViewLayer.Combined"},
        {join({rgb_of("N"), rgb_of("rgba")}), "", 3, 4, 5, -1, "rgba"},
        {join({rgb_of("diffuse"), rgb_of("C")}), "", 3, 4, 5, -1, "C"},
        {join({rgb_of("diffuse"), rgb_of("Ci")}), "", 3, 4, 5, -1, "Ci"},
        {join({rgb_of("specular"), rgb_of("beauty")}), "", 3, 4, 5, -1, "beauty"},
        {join({rgb_of("specular"), rgb_of("Final Image")}), "", 3, 4, 5, -1, "Final Image"},
        {rgb_of("render"), "", 0, 1, 2, -1, "render"},
        {kBlender, "ViewLayer.Emit", 11, 12, 13, -1, "ViewLayer.Emit"},
        {kBlender, "viewlayer.EMIT", 11, 12, 13, -1, "ViewLayer.Emit"},
        {kBlender, "Emit", 11, 12, 13, -1, "ViewLayer.Emit"},
        {kBlender, "diffcol", 8, 9, 10, -1, "ViewLayer.DiffCol"},
        {kBlender, "ViewLayer.CryptoObject00", 14, 15, 16, 17, "ViewLayer.CryptoObject00"},
        {join({rgb_of("key"), rgb_of("Key")}), "Key", 3, 4, 5, -1, "Key"},
        {join({rgb_of("x"), {"R", "G", "B"}}), "R,G,B", 3, 4, 5, -1, ""}};
    for (const Chosen& c : cases) {
        SCOPED_TRACE(testing::PrintToString(c.channels) + " " + c.asked);
        ColorChoice choice;
        std::string error;
        PixelOptions options;
        options.layer = c.asked;
        ASSERT_TRUE(find_color(make_spec(4, 4, c.channels), options, choice, error)) << error;
        EXPECT_THAT((std::vector<int>{choice.r, choice.g, choice.b, choice.a}),
                    ElementsAre(c.r, c.g, c.b, c.a));
        EXPECT_EQ(choice.layer, c.layer);
        EXPECT_EQ(choice.space, "rec709");
        EXPECT_FALSE(choice.display_encoded);
    }
}

TEST(FindColor, SaysWhatThereIsInstead) {
    const struct {
        Names channels;
        std::string asked;
        Names words;
    } cases[] = {
        {join({rgb_of("a.Combined"), rgb_of("b.Combined")}),
         "",
         {"2 layers", "a.Combined", "b.Combined", "layer="}},
        {join({rgb_of("beauty"), rgb_of("rgba")}), "", {"2 layers", "beauty", "rgba"}},
        {join({rgb_of("albedo"), rgb_of("N")}), "", {"albedo", "N", "layer="}},
        {join({rgb_of("diffuse"), rgb_of("specular")}), "", {"diffuse", "specular", "layer="}},
        // What is left over when the data is known is not obviously the beauty.
        {join({rgb_of("albedo"), rgb_of("shadow")}), "", {"albedo", "shadow", "layer="}},
        {rgb_of("albedo"), "", {"albedo", "layer="}},
        {{"R", "G", "B", "red", "green", "blue"}, "", {"two spellings", "red"}},
        {{"R", "G", "B"}, "_", {"\"_\"", "R,G,B"}},
        {{"Z"}, "", {"\"Z\", the only layer, holds depths", "layer=Z"}},
        {{"uv.U"}, "", {"holds coordinates", "layer=uv"}},
        {rgb_of("bumpnormals"),
         "",
         {"\"bumpnormals\", the only layer, holds normals", "layer=bumpnormals"}},
        {rgb_of("VRayZDepth"), "", {"holds depths", "layer=VRayZDepth"}},
        {rgb_of("Denoise_Albedo"), "", {"holds albedo"}},
        {{"Y", "RY", "BY"}, "", {"needs R,G,B", "3 channel"}},
        {{"X", "Y", "Z"}, "", {"needs R,G,B"}},
        {{"R", "G"}, "", {"needs R,G,B", "2 channel", "R, G"}},
        {{"Z", "N.X", "N.Y", "N.Z"}, "", {"needs R,G,B", "4 channel", "N.X"}},
        {kBlender, "Combined2", {"\"Combined2\"", "ViewLayer.Combined", "ViewLayer.Emit"}},
        {{"Y"}, "beauty", {"\"beauty\"", "none"}},
        {join({rgb_of("a.emit"), rgb_of("b.Emit")}), "emit", {"2 layers", "a.emit", "b.Emit"}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(testing::PrintToString(c.channels) + " " + c.asked);
        ColorChoice choice;
        std::string error;
        PixelOptions options;
        options.layer = c.asked;
        EXPECT_FALSE(find_color(make_spec(4, 4, c.channels), options, choice, error));
        for (const std::string& word : c.words)
            EXPECT_THAT(error, HasSubstr(word));
    }
}

// One channel stands for all three.
TEST(FindColor, OneChannelIsGrey) {
    const Chosen cases[] = {{{"Y"}, "", 0, 0, 0, -1, ""},
                            {{"Y", "A"}, "", 0, 0, 0, 1, ""},
                            {{"R"}, "", 0, 0, 0, -1, ""},
                            {{"A"}, "", 0, 0, 0, -1, ""},
                            {{"Y", "Z"}, "", 0, 0, 0, -1, ""},
                            {{"N.X", "N.Y", "N.Z", "Y"}, "", 3, 3, 3, -1, ""},
                            {{"matte"}, "", 0, 0, 0, -1, "matte"},
                            {{"C.Y", "C.A"}, "", 0, 0, 0, 1, "C"},
                            {{"Z"}, "Z", 0, 0, 0, -1, "Z"},
                            {{"R", "G", "B", "depth.Z"}, "depth", 3, 3, 3, -1, "depth"},
                            {{"R", "G", "B", "mask"}, "MASK", 3, 3, 3, -1, "mask"}};
    for (const Chosen& c : cases) {
        SCOPED_TRACE(testing::PrintToString(c.channels) + " " + c.asked);
        ColorChoice choice;
        std::string error;
        PixelOptions options;
        options.layer = c.asked;
        ASSERT_TRUE(find_color(make_spec(4, 4, c.channels), options, choice, error)) << error;
        EXPECT_THAT((std::vector<int>{choice.r, choice.g, choice.b, choice.a}),
                    ElementsAre(c.r, c.g, c.b, c.a));
        EXPECT_EQ(choice.layer, c.layer);
        EXPECT_TRUE(choice.grey());
    }
}

// Plain R, G, B of a part that is called as data are.
TEST(FindColor, APartOfDataIsNoPicture) {
    for (const char* part : {"N", "albedo", "worldPosition", "left.depth", "crypto_object00"}) {
        ImageSpec spec = make_spec(4, 4, {"R", "G", "B"});
        spec.attribute("oiio:subimagename", part);
        ColorChoice choice;
        std::string error;
        EXPECT_FALSE(find_color(spec, {}, choice, error)) << part;
        EXPECT_THAT(error, HasSubstr(std::string("layer=") + part));
        PixelOptions options;
        options.layer = part;
        EXPECT_TRUE(find_color(spec, options, choice, error)) << error;
    }
    ImageSpec spec = make_spec(4, 4, {"R", "G", "B"});
    spec.attribute("oiio:subimagename", "rgba_left");
    ColorChoice choice;
    std::string error;
    EXPECT_TRUE(find_color(spec, {}, choice, error)) << error;
}

TEST(FindColor, ManyChannelsAreNotAllListed) {
    Names names;
    for (int i = 0; i < 40; ++i)
        names.push_back("x" + std::to_string(i) + ".V");
    ColorChoice choice;
    std::string error;
    EXPECT_FALSE(find_color(make_spec(4, 4, names), {}, choice, error));
    EXPECT_THAT(error, HasSubstr("and 24 more"));
    EXPECT_THAT(error, testing::Not(HasSubstr("x39.V")));
}

TEST(FindColor, IntegersAreDisplayEncoded) {
    for (auto format : {OIIO::TypeUInt8, OIIO::TypeUInt16}) {
        ColorChoice choice;
        std::string error;
        ASSERT_TRUE(find_color(make_spec(4, 4, {"R", "G", "B"}, format), {}, choice, error));
        EXPECT_EQ(choice.space, "srgb");
        EXPECT_TRUE(choice.display_encoded);
    }
}

TEST(ColorLayers, ListsEveryLayerWithColor) {
    EXPECT_THAT(ToneAlgo::color_layers(make_spec(1, 1, kBlender)),
                ElementsAre("ViewLayer.Combined", "ViewLayer.DiffCol", "ViewLayer.Emit",
                            "ViewLayer.CryptoObject00"));
    EXPECT_THAT(ToneAlgo::color_layers(make_spec(1, 1, {"A", "B", "G", "R"})),
                ElementsAre("R,G,B"));
    EXPECT_THAT(ToneAlgo::color_layers(make_spec(1, 1, {"Y"})), IsEmpty());
}

} // namespace
} // namespace tonetool
