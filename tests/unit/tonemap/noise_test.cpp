// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "guided_scene.h"
#include "kernels/noise_rows.h"
#include "schedules.h"
#include "target.h"

namespace tonetool::tonemap {
namespace {

using kernels::GuidedScene;
using kernels::GuidePlanes;

// Normals of unit length, which noise rows take them for, and the logarithm of the light.
GuidedScene flat_scene(int width, int height, uint32_t seed) {
    GuidedScene scene(width, height, seed);
    kernels::Uniform random(seed + 1);
    for (size_t i = 0; i < scene.background.size(); ++i) {
        const bool left = int(i) % width < width / 2;
        for (int c = 0; c < 3; ++c) {
            scene.plane[GuidedScene::kNormal + c][i] = c == 2 ? 1.0f : 0.0f;
            // On the right, no two pixels are of one colour.
            scene.plane[GuidedScene::kAlbedo + c][i] = left ? 0.5f : float(random());
        }
        scene.plane[GuidedScene::kValue][i] = float(0.1 * random());
    }
    return scene;
}

GuidePlanes view_of(const GuidedScene& scene) {
    GuidePlanes out = scene.view();
    out.range = nullptr;
    return out;
}

std::vector<float> noise_of(const GuidePlanes& image, const kernels::ParallelFor& parallel) {
    std::vector<float> out(size_t(image.width) * size_t(image.height));
    noise_plane(image, out.data(), parallel);
    return out;
}

// Straight from the definition; NaN where less than 2 % of the box is flat.
double exactly(const GuidePlanes& image, int x, int y) {
    double flat = 0, square = 0;
    for (int dy = -8; dy <= 8; ++dy)
        for (int dx = -8; dx <= 8; ++dx) {
            const auto share =
                kernels::noise_reference(image, std::clamp(x + dx, 0, image.width - 1),
                                         std::clamp(y + dy, 0, image.height - 1));
            flat += share.flat;
            square += share.square;
        }
    return flat > 0.02 * 17 * 17 ? 0.8 * square / flat : std::nan("");
}

TEST(Noise, IsTheVarianceOfFlatPixelsInABox) {
    for (const auto& [w, h] : {std::pair{61, 40}, {1, 1}, {5, 3}, {40, 1}, {3, 150}}) {
        const GuidedScene scene = flat_scene(w, h, 1);
        const GuidePlanes image = view_of(scene);
        kernels::on_every_target([&, w = w, h = h] {
            const auto noise = noise_of(image, kernels::in_order());
            int without = 0;
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x) {
                    const double exact = exactly(image, x, y);
                    const auto ours = double(noise[size_t(y * w + x)]);
                    without += std::isnan(exact);
                    ASSERT_EQ(std::isnan(ours), std::isnan(exact)) << x << " " << y;
                    if (!std::isnan(exact))
                        ASSERT_NEAR(ours, exact, 1e-5 * exact) << x << " " << y;
                }
            if (w == 61)
                EXPECT_GT(without, 0);
        });
    }
}

TEST(Noise, IsThatOfTheLight) {
    GuidedScene scene = flat_scene(400, 300, 2);
    kernels::Uniform random(9);
    for (float& v : scene.plane[GuidedScene::kValue])
        v = float(0.05 * (random() - 0.5)); // of variance 0.0025 / 12
    const auto noise = noise_of(view_of(scene), kernels::in_order());
    double sum = 0;
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 180; ++x)
            sum += double(noise[size_t(y * 400 + x)]);
    EXPECT_NEAR(sum / (300 * 180), 0.0025 / 12, 0.02 * 0.0025 / 12);
}

TEST(Noise, DoesNotDependOnTheSchedule) {
    const GuidedScene scene = kernels::hard_scene(130, 500, 3);
    const GuidePlanes image = view_of(scene);
    const auto bits = [](std::vector<float> plane) {
        std::replace_if(
            plane.begin(), plane.end(), [](float v) { return std::isnan(v); }, -1.0f);
        return plane;
    };
    const auto expected = bits(noise_of(image, kernels::in_order()));
    EXPECT_EQ(bits(noise_of(image, kernels::backwards())), expected);
    EXPECT_EQ(bits(noise_of(image, kernels::on_threads(3))), expected);
}

} // namespace
} // namespace tonetool::tonemap
