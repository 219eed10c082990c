// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "guided_scene.h"
#include "schedules.h"

namespace tonetool::tonemap {
namespace {

using kernels::GuidedScene;
using kernels::GuidePlanes;

std::vector<float> footprints_of(const GuidePlanes& image, double step = 0,
                                 const kernels::ParallelFor& parallel = kernels::in_order()) {
    std::vector<float> out(size_t(image.width) * size_t(image.height));
    footprints(image, step, out.data(), parallel);
    return out;
}

// A plane seen straight on, pixels `dx` and `dy` apart.
GuidedScene wall(int width, int height, float dx, float dy) {
    GuidedScene scene(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            scene.plane[1][scene.at(x, y)] = dx * float(x);
            scene.plane[2][scene.at(x, y)] = dy * float(y);
            scene.plane[3][scene.at(x, y)] = 5;
        }
    return scene;
}

TEST(Footprints, OfAWallAreItsPixels) {
    const GuidedScene scene = wall(30, 20, 0.25f, 0.0625f);
    for (float f : footprints_of(scene.view()))
        EXPECT_FLOAT_EQ(f, 0.125f);
}

TEST(Footprints, OfARowAreItsSteps) {
    for (float f : footprints_of(wall(9, 1, 0.5f, 7).view()))
        EXPECT_FLOAT_EQ(f, 0.5f);
    for (float f : footprints_of(wall(1, 9, 7, 0.5f).view()))
        EXPECT_FLOAT_EQ(f, 0.5f);
    EXPECT_EQ(footprints_of(wall(1, 1, 1, 1).view())[0], 0) << "nothing is known";
}

// On both sides of a silhouette it is that of the surface.
TEST(Footprints, DoNotSeeSilhouettes) {
    GuidedScene scene = wall(40, 30, 0.25f, 0.25f);
    for (int y = 0; y < 30; ++y)
        for (int x = 17; x < 40; ++x)
            for (int p : {1, 2, 3})
                scene.plane[p][scene.at(x, y)] *= 100;
    const auto f = footprints_of(scene.view());
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            EXPECT_NEAR(double(f[scene.at(x, y)]), x < 17 ? 0.25 : 25, 1e-4) << x << " " << y;
}

// A pixel wide: steps to the neighbours are the distance of the things, not the pixel.
TEST(Footprints, OfLonePixelsAreNearTheMedian) {
    GuidedScene scene = wall(20, 20, 0.25f, 0.25f);
    scene.plane[3][scene.at(9, 9)] = 1000;
    const auto f = footprints_of(scene.view());
    EXPECT_FLOAT_EQ(f[scene.at(9, 9)], 1);
    EXPECT_FLOAT_EQ(f[scene.at(10, 9)], 0.25f);
}

TEST(Footprints, PassOverBackgroundAndBadPositions) {
    GuidedScene scene = wall(20, 20, 0.25f, 0.25f);
    const float bad[] = {std::numeric_limits<float>::quiet_NaN(), INFINITY, 1e30f};
    for (int i = 0; i < 3; ++i)
        scene.plane[1 + i][scene.at(4 + 3 * i, 8)] = bad[i];
    scene.background[scene.at(14, 14)] = 1;
    // Alone among background: what is known around it is taken.
    for (int y = 14; y < 17; ++y)
        for (int x = 1; x < 4; ++x)
            scene.background[scene.at(x, y)] = x != 2 || y != 15;
    const auto f = footprints_of(scene.view());
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) {
            const size_t i = scene.at(x, y);
            const bool surface = !scene.background[i] && !(y == 8 && (x == 4 || x == 7 || x == 10));
            EXPECT_FLOAT_EQ(f[i], surface ? 0.25f : 0) << x << " " << y;
        }
}

TEST(Footprints, AreAtLeastTheRoundingOfPositions) {
    GuidedScene scene = wall(20, 10, 0.25f, 0.25f);
    for (float& z : scene.plane[3])
        z = 3000;
    for (float f : footprints_of(scene.view(), kHalfStep))
        EXPECT_FLOAT_EQ(f, 3000.0f / 1024);
    for (float f : footprints_of(scene.view(), kFloatStep))
        EXPECT_FLOAT_EQ(f, 0.25f);
}

TEST(Footprints, ScaleWithTheScene) {
    GuidedScene scene = kernels::hard_scene(60, 40, 3);
    const auto before = footprints_of(scene.view(), kFloatStep);
    for (int p : {1, 2, 3})
        for (float& v : scene.plane[p])
            v = std::abs(v) < 1e10f ? v * 64 : v;
    const auto after = footprints_of(scene.view(), kFloatStep);
    for (size_t i = 0; i < before.size(); ++i)
        EXPECT_FLOAT_EQ(after[i], before[i] * 64);
}

// The clamp by counting is the clamp by the median itself.
TEST(Footprints, AreWithinTheSpreadOfTheirMedian) {
    GuidedScene scene(50, 40, 4);
    kernels::Uniform random(5);
    for (int p : {1, 2, 3})
        for (float& v : scene.plane[p])
            v *= float(1 + 3 * random() * random() * random());
    for (auto& b : scene.background)
        b = random() < 0.2;
    const auto f = footprints_of(scene.view());
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 50; ++x)
            if (!scene.background[scene.at(x, y)]) {
                EXPECT_GT(f[scene.at(x, y)], 0);
                EXPECT_LT(f[scene.at(x, y)], 100);
            }
}

TEST(Footprints, DoNotDependOnTheSchedule) {
    const GuidedScene scene = kernels::hard_scene(70, 50, 6);
    const auto expected = footprints_of(scene.view());
    EXPECT_EQ(footprints_of(scene.view(), 0, kernels::backwards()), expected);
    EXPECT_EQ(footprints_of(scene.view(), 0, kernels::on_threads(3)), expected);
}

TEST(MedianFootprint, IsOfWhatIsKnown) {
    const std::vector<float> plane = {0, 3, 1, 0, 2, 9, 0, 4};
    EXPECT_EQ(median_footprint(plane.data(), 4, 2), 3);
    EXPECT_EQ(median_footprint(plane.data(), 1, 1), 0);
}

} // namespace
} // namespace tonetool::tonemap
