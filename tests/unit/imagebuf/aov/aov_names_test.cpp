// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/aov_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tonetool {
namespace {

TEST(AovNames, TellDataFromLight) {
    const struct {
        AovKind kind;
        std::vector<const char*> names;
    } cases[] = {{AovKind::Position,
                  {"P", "__Pworld", "worldPosition", "VRayWorldPosition", "Pref", "wpos",
                   "FinalImageMyMaterialWorldPosition", "P_cam"}},
                 {AovKind::Normal,
                  {"N", "Ns", "bumpNormals", "VRayNormals", "Denoising Normal", "denoise_normal",
                   "Geometric normal", "N_world", "N_filtered", "nrm"}},
                 {AovKind::Albedo,
                  {"albedo", "DiffCol", "Diffuse Color", "VRayDiffuseFilter", "GlossCol",
                   "diffuse_albedo", "denoise_albedo", "baseColor", "specular_albedo"}},
                 {AovKind::Depth,
                  {"Z", "depth", "VRayZDepth", "FinalImagePWWorldDepth", "zfiltered", "Mist",
                   "Z_raw", "Denoising Depth", "distance"}},
                 {AovKind::Motion, {"Vector", "motionVectors", "velocity", "MotionVec"}},
                 {AovKind::Id,
                  {"CryptoObject00", "crypto_asset", "object id", "IndexOB", "MultiMatte",
                   "ActorHitProxyMask00"}},
                 {AovKind::Coordinates, {"UV", "st", "uv_map"}},
                 {AovKind::Statistic, {"normal_variance", "mse", "sampleCount"}},
                 {AovKind::Light,
                  {"Combined", "C", "rgba_key", "diffuse", "diffuse_direct", "specular",
                   "normalized_beauty", "Emit", "background", "C_key", "reflection", "N_key"}}};
    for (const auto& c : cases)
        for (const char* name : c.names)
            EXPECT_EQ(plural_of(kind_of_layer(name)), std::string(plural_of(c.kind))) << name;
}

// What guides a tone mapper is no picture, by whatever name.
TEST(AovNames, EveryGuideIsData) {
    for (const AovKind kind :
         {AovKind::Position, AovKind::Normal, AovKind::Albedo, AovKind::Depth}) {
        EXPECT_FALSE(guide_passes(kind).empty());
        for (const std::string& pass : guide_passes(kind))
            if (pass != "diffuse") // V-Ray's, light elsewhere
                EXPECT_EQ(kind_of_layer(pass), kind) << pass;
    }
    EXPECT_TRUE(guide_passes(AovKind::Motion).empty());
}

} // namespace
} // namespace tonetool
