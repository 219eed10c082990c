// SPDX-License-Identifier: BSD-3-Clause
// Synthetic renders: a scene and the noise of a path tracer, whose every bit is known. The script
// make_bias_goldens.py makes the same pictures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/views.h"
#include "metrics/bias.h"
#include "schedules.h"

namespace tonetool::metrics {

struct RenderOptions {
    double noise = 1;     ///< 0: converged
    int power = 1;        ///< of a uniform number: 4 is skewed as noise of a path tracer is
    double fireflies = 0; ///< part of the pixels
    double gain = 1;
    double corner = 1; ///< gain of the 24 pixels wide square at the upper left
    double smooth = 0; ///< weight of the right neighbour's noise
    double level = 0;  ///< added light without noise
    int shift = 0;     ///< of the edges, to the right
    bool black_half = false;
    double wave = 0; ///< amplitude of added light, up and down over 64 columns
};

struct Render {
    int width = 0, height = 0;
    std::vector<float> plane[3];

    Render(int w, int h, uint64_t seed, const RenderOptions& options = {}) : width(w), height(h) {
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x)
                    plane[c].push_back(float(value(x, y, c, seed, options)));
    }

    kernels::ConstRgb view() const {
        return {{plane[0].data(), plane[1].data(), plane[2].data()}, width, width, height, 0};
    }
    float& at(int c, int x, int y) { return plane[c][size_t(y) * size_t(width) + size_t(x)]; }

    /// Every value as `change` makes it.
    template <class Change>
    Render changed(const Change& change) const {
        Render out = *this;
        for (auto& values : out.plane)
            for (float& v : values)
                v = change(v);
        return out;
    }

private:
    // SplitMix64 of the place, as a number from 0 to 1.
    static double uniform(int x, int y, int c, uint64_t seed) {
        uint64_t z = ((seed * 8192 + uint64_t(y)) * 8192 + uint64_t(x)) * 4 + uint64_t(c);
        z = (z + 1) * 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return double((z ^ (z >> 31)) >> 40) * 0x1p-24;
    }
    // Mean 1.
    static double noise(int x, int y, int c, uint64_t seed, const RenderOptions& o) {
        const double u = uniform(x, y, c, seed);
        double v = u;
        for (int i = 1; i < o.power; ++i)
            v = v * u;
        double n = 1 + o.noise * (v * (o.power + 1) - 1);
        if (o.fireflies > 0 && uniform(x, y, 3, seed) < o.fireflies)
            n = n + 30;
        return n;
    }
    // Levels are multiples of 1/1024; stripes are texture.
    double value(int x, int y, int c, uint64_t seed, const RenderOptions& o) const {
        if (o.black_half && 2 * x < width)
            return o.level;
        const double base = (double(32 + 8 * (x / 8 % 8) * (c + 1)) + double(y / 16 % 4)) / 1024;
        const double edge = (x + 8 - o.shift) / 4 % 4 == 0 ? 2 : 1;
        double n = noise(x, y, c, seed, o);
        if (o.smooth > 0)
            n = n * (1 - o.smooth) + noise(x + 1, y, c, seed, o) * o.smooth;
        const double gain = x < 24 && y < 24 ? o.gain * o.corner : o.gain;
        const int phase = x % 64;
        const double wave = phase < 32 ? 15.5 - phase : phase - 47.5;
        return base * edge * n * gain + o.level + o.wave * wave / 16;
    }
};

inline BiasSide side_of(const std::vector<Render>& seeds) {
    BiasSide side(seeds.front().width, seeds.front().height);
    for (const Render& seed : seeds)
        side.add(seed.view(), kernels::in_order());
    return side;
}

inline BiasResult check_pair(const Render& reference, const Render& test,
                             const BiasTest& options = {}) {
    return bias_check(BiasSide(reference.view()), BiasSide(test.view()), options,
                      kernels::in_order());
}

// A map as planes; where it has two channels the third is 0.
inline std::array<std::vector<float>, 3> planes_of(const BiasResult& result, BiasMap map,
                                                   const kernels::ParallelFor& parallel) {
    const auto channels = size_t(bias_map_channels(map));
    const auto pixels = size_t(result.width) * size_t(result.height);
    std::vector<float> values(pixels * channels);
    bias_map(result, map, values.data(), int(channels), parallel);
    std::array<std::vector<float>, 3> planes;
    for (size_t i = 0; i < values.size(); ++i)
        planes[i % channels].push_back(values[i]);
    for (size_t c = channels; c < planes.size(); ++c)
        planes[c].assign(pixels, 0.0f);
    return planes;
}

} // namespace tonetool::metrics
