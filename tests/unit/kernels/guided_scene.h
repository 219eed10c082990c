// SPDX-License-Identifier: BSD-3-Clause
// Small images with G-buffers, the same on every machine and with every standard library.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "hdr_image.h"
#include "kernels/guided.h"

namespace tonetool::kernels {

/// A checkered floor and tilted walls under light with noise. Planes: value, position, normal,
/// albedo, range, footprint.
struct GuidedScene {
    enum Plane { kValue, kPosition, kNormal = 4, kAlbedo = 7, kRange = 10, kFootprint, kPlanes };

    int width, height;
    std::vector<float> plane[kPlanes];
    std::vector<uint8_t> background;

    GuidedScene(int w, int h, uint32_t seed) : width(w), height(h) {
        for (auto& p : plane)
            p.resize(size_t(w) * size_t(h));
        background.resize(size_t(w) * size_t(h));
        Uniform random(seed);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                set(x, y, random);
    }

    GuidePlanes view() const {
        GuidePlanes out;
        out.value = plane[kValue].data();
        for (int c = 0; c < 3; ++c) {
            out.position[c] = plane[kPosition + c].data();
            out.normal[c] = plane[kNormal + c].data();
            out.albedo[c] = plane[kAlbedo + c].data();
        }
        out.range = plane[kRange].data();
        out.footprint = plane[kFootprint].data();
        out.background = background.data();
        out.stride = out.width = width;
        out.height = height;
        return out;
    }

    size_t at(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }

private:
    void set(int x, int y, Uniform& random) {
        const size_t i = at(x, y);
        const int cell = (x / 13 + 2 * (y / 11)) % 4;
        const double depth = 4 + cell + 0.03 * x;
        const double p[3] = {(x - width / 2) * depth / 200, (y - height / 2) * depth / 200, depth};
        const double n[3] = {0.4 * cell - 0.6 + 0.1 * random(), 0.2 + 0.1 * random(), 0.7};
        for (int c = 0; c < 3; ++c) {
            plane[kPosition + c][i] = float(p[c]);
            plane[kNormal + c][i] = float(n[c] * (0.5 + random()));
            plane[kAlbedo + c][i] = float(0.15 * ((cell * 5 + c) % 4) + 0.1 * random());
        }
        const double light = std::exp(2 * std::sin(0.09 * x + 0.13 * y) + 0.7 * cell + random());
        plane[kValue][i] = float(light);
        plane[kRange][i] = float(std::log10(light));
        plane[kFootprint][i] = float(depth / 200);
    }
};

/// The same with everything in it that a filter could stumble over.
inline GuidedScene hard_scene(int width, int height, uint32_t seed) {
    GuidedScene scene(width, height, seed);
    const float inf = std::numeric_limits<float>::infinity(), nan = inf - inf;
    const float values[] = {nan, inf, -inf, -1, 0, 1e-40f, 1e-20f, 1e12f, 1e30f};
    const float others[] = {nan, inf, -inf, 0, 1e20f, 1e-30f};
    Uniform random(seed + 1);
    const auto pick = [&](size_t n) { return size_t(random() * double(n)); };
    for (size_t i = 0; i < scene.background.size(); ++i) {
        if (random() < 0.06)
            scene.plane[GuidedScene::kValue][i] = values[pick(9)];
        if (random() < 0.06)
            scene.plane[GuidedScene::kPosition + int(pick(10))][i] = others[pick(6)];
        if (random() < 0.03)
            scene.plane[GuidedScene::kRange][i] = others[pick(3)];
        scene.background[i] = random() < 0.1 || i % 97 < 9 ? uint8_t(1 + pick(255)) : 0;
    }
    return scene;
}

} // namespace tonetool::kernels
