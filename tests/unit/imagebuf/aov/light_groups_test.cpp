// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/light_groups.h"

#include <gmock/gmock.h>

#include "files.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using Names = std::vector<std::string>;

ImageSpec spec_of(const Names& layers) {
    Names channels;
    for (const std::string& layer : layers)
        for (const char* c : {"R", "G", "B"})
            channels.push_back(layer.empty() ? c : layer + "." + c);
    return make_spec(4, 4, channels);
}

struct Case {
    const char* renderer;
    std::string beauty;
    Names layers, groups;
};

TEST(LightGroups, KnowsTheNamesOfRenderers) {
    const std::vector<Case> cases = {
        {"Blender",
         "V.Combined",
         {"V.Combined", "V.Combined_key", "V.Combined_neon.C", "W.Combined_key", "V.DiffCol"},
         {"key"}},
        {"Arnold",
         "",
         {"", "RGBA_key", "RGBA_default", "RGBA_denoise", "diffuse_direct_key", "crypto_object00"},
         {"key", "default"}},
        {"Karma", "C", {"C", "C_Key", "C_Fill", "C_albedo", "C_crypto"}, {"Key", "Fill"}},
        {"RenderMan", "Ci", {"Ci", "beauty_key", "beauty_fill_var"}, {"key"}},
        {"V-Ray", "", {"", "VRayLightSelect_key", "VRayLightSelect rim"}, {"key", "rim"}},
        {"Redshift", "beauty", {"beauty", "beauty_other", "Depth_key"}, {"other"}},
        {"Octane", "Beauty", {"Beauty", "Light ID 1", "Light ID 2"}, {"1", "2"}},
        {"dots", "RGBA", {"RGBA", "RGBA.key"}, {"key"}},
        {"a beauty of its own", "final", {"final", "final_a1", "RGBA_key"}, {"a1"}},
        {"two families", "", {"", "RGBA_key", "light_key"}, {"key"}},
        {"eyes", "V.Combined.left", {"V.Combined_key.left", "V.Combined_key.right"}, {"key"}},
        {"stereo parts", "", {"", "rgba_right", "rgba_left"}, {}},
        {"stereo layers", "C", {"C", "C_L", "C_R", "C.right", "C_lft"}, {}},
        {"stereo and groups", "", {"", "rgba_left", "rgba_key"}, {"key"}},
        {"data", "", {"", "RGBA_N", "RGBA_depth", "RGBA_uv", "RGBA_motionvectors"}, {}},
        {"none", "", {"", "albedo", "combined", "lighting"}, {}},
    };
    for (const Case& c : cases) {
        Names names;
        for (const LightGroup& group : find_light_groups(spec_of(c.layers), c.beauty))
            names.push_back(group.name);
        EXPECT_EQ(names, c.groups) << c.renderer;
    }
}

TEST(LightGroups, OfARenderedScene) {
    const UnreadFile file(TESTIMAGES_DIR "/gallery_ref.exr");
    const ImageSpec& spec = file.image.spec();
    Names names;
    for (const LightGroup& group : find_light_groups(spec, "ViewLayer.Combined")) {
        names.push_back(group.name);
        EXPECT_EQ(group.layer, "ViewLayer.Combined_" + group.name);
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(std::string(spec.channel_name(group.channel[c])),
                      group.layer + "." + "RGB"[c]);
    }
    EXPECT_THAT(names, ElementsAre("cool", "env", "key", "warm"));
}

} // namespace
} // namespace tonetool
