// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include "imagebuf/aov/gbuffer.h"
#include "images.h"
#include "refusal.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Names = std::vector<std::string>;

// "P:XYZ" is P.X, P.Y, P.Z; a name without a colon is a channel.
Names channels(const Names& layers) {
    Names out;
    for (const std::string& layer : layers) {
        const auto colon = layer.find(':');
        if (colon == std::string::npos)
            out.push_back(layer);
        else
            for (const char c : layer.substr(colon + 1))
                out.push_back(layer.substr(0, colon) + "." + c);
    }
    return out;
}

ImageSpec spec_of(const Names& layers) {
    return make_spec(4, 4, channels(layers));
}

std::string name_of(const std::optional<GuideChannels>& guide) {
    return guide ? guide->layer : "-";
}

GBufferNames found(const ImageSpec& spec, const GuideOptions& options = {}) {
    return find_gbuffer(spec, options);
}

Names found_names(const ImageSpec& spec, const GuideOptions& options = {}) {
    const GBufferNames n = found(spec, options);
    return {name_of(n.position), name_of(n.normal), name_of(n.albedo), name_of(n.depth)};
}

std::string failure(const ImageSpec& spec, const GuideOptions& options) {
    return refusal([&] { find_gbuffer(spec, options); });
}

struct Case {
    const char* renderer;
    Names layers;
    Names guides; // position, normal, albedo, depth
};

const std::vector<Case> kCases = {
    {"Blender up to 4",
     {"ViewLayer.Combined:RGBA", "ViewLayer.Combined_key:RGB", "ViewLayer.Depth:Z",
      "ViewLayer.Mist:Z", "ViewLayer.DiffCol:RGB", "ViewLayer.GlossCol:RGB", "ViewLayer.Normal:XYZ",
      "ViewLayer.Position:XYZ", "ViewLayer.Vector:XYZW", "ViewLayer.UV:UVA", "ViewLayer.IndexOB:X",
      "ViewLayer.CryptoObject00:rgba"},
     {"ViewLayer.Position", "ViewLayer.Normal", "ViewLayer.DiffCol", "ViewLayer.Depth"}},
    {"Blender, for the denoiser only",
     {"View Layer.Combined:RGBA", "View Layer.Denoising Normal:XYZ",
      "View Layer.Denoising Albedo:RGB", "View Layer.Denoising Depth:Z"},
     {"-", "View Layer.Denoising Normal", "View Layer.Denoising Albedo",
      "View Layer.Denoising Depth"}},
    {"Blender, both kinds",
     {"V.Denoising Normal:XYZ", "V.Denoising Albedo:RGB", "V.Normal:XYZ", "V.DiffCol:RGB"},
     {"-", "V.Normal", "V.DiffCol", "-"}},
    {"Blender 5",
     {"ViewLayer.Combined:RGBA", "ViewLayer.Diffuse Color:RGB", "ViewLayer.Diffuse Direct:RGB",
      "ViewLayer.Depth:Z", "ViewLayer.Normal:XYZ", "ViewLayer.Position:XYZ",
      "ViewLayer.Material Index:X"},
     {"ViewLayer.Position", "ViewLayer.Normal", "ViewLayer.Diffuse Color", "ViewLayer.Depth"}},
    {"Blender, a second view layer called by number",
     {"ViewLayer.001.Combined:RGBA", "ViewLayer.001.Position:XYZ", "ViewLayer.001.Depth:Z"},
     {"ViewLayer.001.Position", "-", "-", "ViewLayer.001.Depth"}},
    {"Arnold",
     {"R", "G", "B", "A", "Z", "N:XYZ", "P:XYZ", "Pref:XYZ", "albedo:RGB", "diffuse:RGB",
      "RGBA_key:RGBA", "motionvector:RGB", "crypto_object00:RGBA"},
     {"P", "N", "albedo", "Z"}},
    {"Arnold, colours for vectors",
     {"RGBA:RGBA", "P:RGB", "N:RGB", "diffuse_albedo:RGB", "Z"},
     {"P", "N", "diffuse_albedo", "Z"}},
    {"Arnold, lower case", {"r", "g", "b", "p:xyz", "n:xyz", "z"}, {"p", "n", "-", "z"}},
    {"RenderMan",
     {"Ci:rgb", "a", "P:XYZ", "__Pworld:XYZ", "Nn:XYZ", "__Nworld:XYZ", "albedo:RGB",
      "albedo_var:RGB", "normal_var:XYZ", "__depth", "zfiltered"},
     {"__Pworld", "__Nworld", "albedo", "__depth"}},
    {"V-Ray",
     {"R", "G", "B", "A", "VRayWorldPosition:RGB", "VRayNormals:XYZ", "VRayBumpNormals:XYZ",
      "VRayDiffuseFilter:RGB", "VRayZDepth"},
     {"VRayWorldPosition", "VRayBumpNormals", "VRayDiffuseFilter", "VRayZDepth"}},
    {"V-Ray, short names",
     {"R", "G", "B", "normals:XYZ", "diffuse:RGB", "LightSelect_key:RGB"},
     {"-", "normals", "diffuse", "-"}},
    {"Karma",
     {"C:RGBA", "P:XYZ", "N:XYZ", "albedo:RGB", "Pz", "C_Key:RGB"},
     {"P", "N", "albedo", "Pz"}},
    {"Redshift",
     {"R", "G", "B", "WorldPosition:XYZ", "Normals:XYZ", "BumpNormals:XYZ", "DiffuseFilter:RGB",
      "DiffuseLighting:RGB", "Depth:Z", "MotionVectors:RG"},
     {"WorldPosition", "BumpNormals", "DiffuseFilter", "Depth"}},
    {"Octane",
     {"Beauty:RGBA", "Position:XYZ", "Geometric normal:XYZ", "Smooth normal:XYZ",
      "Shading normal:XYZ", "Diffuse filter (info):RGB", "Denoise albedo:RGB", "Z-depth:RGB"},
     {"Position", "Shading normal", "Diffuse filter (info)", "Z-depth"}},
    {"pbrt-v4 of 2021",
     {"R", "G", "B", "Px", "Py", "Pz", "dzdx", "dzdy", "Nx", "Ny", "Nz", "Nsx", "Nsy", "Nsz",
      "Albedo:RGB", "Variance:RGB"},
     {"P", "Ns", "Albedo", "-"}},
    {"pbrt-v4",
     {"R", "G", "B", "Albedo:RGB", "P:XYZ", "dzdx", "dzdy", "N:XYZ", "Ns:XYZ", "u", "v"},
     {"P", "Ns", "Albedo", "-"}},
    {"Mitsuba",
     {"R", "G", "B", "pos:XYZ", "geo_normal:XYZ", "sh_normal:XYZ", "albedo:RGB", "dd.y:T",
      "shape_index:I"},
     {"pos", "sh_normal", "albedo", "dd.y"}},
    {"Unreal",
     {"R", "G", "B", "A", "FinalImageMovieRenderQueue_WorldDepth:RGBA",
      "FinalImageMyMaterialWorldNormal:RGB", "FinalImageBaseColor:RGB", "ActorHitProxyMask00:RGBA"},
     {"-", "FinalImageMyMaterialWorldNormal", "FinalImageBaseColor",
      "FinalImageMovieRenderQueue_WorldDepth"}},
    {"Unreal, the older depth",
     {"R", "G", "B", "FinalImagePWWorldDepth:R"},
     {"-", "-", "-", "FinalImagePWWorldDepth"}},
    {"OIDN", {"color:RGB", "alb:RGB", "nrm:XYZ"}, {"-", "nrm", "alb", "-"}},
    {"MoonRay",
     {"R", "G", "B", "P:XYZ", "N:XYZ", "albedo:RGB", "depth"},
     {"P", "N", "albedo", "depth"}},
    {"Z among the colours", {"beauty:RGBAZ"}, {"-", "-", "-", "beauty"}},
    {"colours only", {"R", "G", "B", "A"}, {"-", "-", "-", "-"}},
    {"what only sounds like it",
     {"R", "G", "B", "Pref:XYZ", "ObjectPosition:XYZ", "motion:XYZ", "diffuse:RGB", "Mist:Z",
      "normal_var:XYZ", "albedo_mse:RGB", "P:XY"},
     {"-", "-", "-", "-"}},
};

TEST(FindGBuffer, KnowsTheNamesOfRenderers) {
    for (const Case& c : kCases)
        EXPECT_EQ(found_names(spec_of(c.layers)), c.guides) << c.renderer;
}

TEST(FindGBuffer, KnowsTheChannels) {
    const auto names = found(spec_of({"Pz", "Px", "Py", "Z", "albedo:BGR", "R", "G", "B"}));
    EXPECT_THAT(names.position->channel, ElementsAre(1, 2, 0));
    EXPECT_THAT(names.albedo->channel, ElementsAre(6, 5, 4));
    EXPECT_EQ(names.depth->channel[0], 3);
    EXPECT_TRUE(names.any());
    EXPECT_FALSE(found(spec_of({"R", "G", "B"})).any());
    EXPECT_FALSE(found(ImageSpec()).any());
}

TEST(FindGBuffer, DiffuseIsAlbedoInAFileOfVRayOnly) {
    auto spec = spec_of({"R", "G", "B", "diffuse:RGB"});
    EXPECT_EQ(name_of(found(spec).albedo), "-");
    spec.attribute("Software", "V-Ray 6");
    EXPECT_EQ(name_of(found(spec).albedo), "diffuse");
    spec.attribute("Software", "Arnold");
    spec.attribute("vrayInfo/camera", "cam");
    EXPECT_EQ(name_of(found(spec).albedo), "diffuse");
}

TEST(FindGBuffer, ThePartOfAFileMayHaveTheName) {
    auto spec = make_spec(4, 4, {"X", "Y", "Z"});
    EXPECT_EQ(name_of(found(spec).position), "-");
    spec.attribute("oiio:subimagename", "rgba.P");
    EXPECT_EQ(name_of(found(spec).position), "rgba.P");
    EXPECT_EQ(name_of(found(spec).depth), "-");
    auto depth = make_spec(4, 4, {"Z"});
    depth.attribute("oiio:subimagename", "beauty");
    EXPECT_EQ(name_of(found(depth).depth), "Z");
}

TEST(FindGBuffer, GuidesComeFromOneViewLayer) {
    const auto spec = spec_of({"Far.Combined:RGBA", "Far.Depth:Z", "Near.Combined:RGBA",
                               "Near.Depth:Z", "Near.Position:XYZ"});
    const auto names = found(spec);
    EXPECT_EQ(name_of(names.depth), "Near.Depth") << "the one with more guides";
    EXPECT_THAT(names.notes, ElementsAre("2 view layers have guides; those of \"Near\" are taken"));
    GuideOptions options;
    options.beauty = "Far.Combined";
    EXPECT_EQ(found_names(spec, options), (Names{"-", "-", "-", "Far.Depth"}));
    EXPECT_THAT(found(spec, options).notes, IsEmpty());
    options.depth = "depth";
    EXPECT_EQ(name_of(found(spec, options).depth), "Far.Depth");
    options.beauty = "Sky.Combined";
    EXPECT_EQ(name_of(found(spec, options).depth), "Near.Depth") << "no guide beside the picture";
    const auto twins = spec_of({"diff-col:RGB", "Diff Col:RGB"});
    GuideOptions albedo;
    albedo.albedo = "diffcol";
    EXPECT_EQ(failure(twins, albedo),
              "albedo layer \"diffcol\" could be one of diff-col, Diff Col; pass one of them");
}

TEST(FindGBuffer, EyesOfAStereoPairAreApart) {
    const auto spec = spec_of({"V.Combined.left:RGBA", "V.Combined.right:RGBA",
                               "V.Position.left:XYZ", "V.Position.right:XYZ"});
    GuideOptions options;
    options.beauty = "V.Combined.right";
    EXPECT_EQ(name_of(found(spec, options).position), "V.Position.right");
}

TEST(FindGBuffer, SaysWhichOfTwoIsTaken) {
    const auto names = found(spec_of({"R", "G", "B", "N:XYZ", "n:XYZ"}));
    EXPECT_EQ(name_of(names.normal), "N");
    EXPECT_THAT(names.notes, ElementsAre("normal could be one of N, n; the first is taken"));
}

TEST(FindGBuffer, TakesWhatTheUserNames) {
    const auto spec = spec_of({"V.Combined:RGBA", "V.Pref:XYZ", "V.Position:XYZ", "V.Normal:XYZ",
                               "V.DiffCol:RGB", "V.GlossCol:RGB", "V.Depth:Z", "V.Mist:Z"});
    GuideOptions options;
    options.position = "V.Pref";
    options.normal = "none";
    options.albedo = "glosscol";
    options.depth = "v.mist";
    EXPECT_EQ(found_names(spec, options), (Names{"V.Pref", "-", "V.GlossCol", "V.Mist"}));
    GuideOptions z;
    z.depth = "Z";
    EXPECT_EQ(name_of(found(spec_of({"R", "G", "B", "Z", "depth"}), z).depth), "Z");
}

TEST(FindGBuffer, AnUnknownLayerListsThoseThereAre) {
    const auto spec = spec_of({"R", "G", "B", "P:XYZ", "N:XYZ", "Z"});
    GuideOptions options;
    options.normal = "Nn";
    EXPECT_EQ(failure(spec, options),
              "unknown normal layer \"Nn\"; did you mean \"N\"? valid: R,G,B, P, N");
    options.normal = "Z";
    EXPECT_THAT(failure(spec, options), HasSubstr("unknown normal layer \"Z\"")) << "one channel";
    GuideOptions depth;
    depth.depth = "Pref";
    EXPECT_EQ(failure(spec, depth), "unknown depth layer \"Pref\"; valid: Z");
    EXPECT_EQ(failure(spec_of({"R"}), options), "unknown normal layer \"Z\"; there are none");
}

} // namespace
} // namespace tonetool
