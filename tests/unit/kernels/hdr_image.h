// SPDX-License-Identifier: BSD-3-Clause
// Small HDR pictures for tests, the same on every machine and with every standard library.
#pragma once

#include <cmath>
#include <cstdint>
#include <ostream>
#include <random>
#include <vector>

#include "kernels/views.h"

namespace tonetool::kernels {

struct HdrImage {
    int width = 0, height = 0;
    std::vector<float> plane[3];

    HdrImage(int w, int h) : width(w), height(h) {
        for (auto& p : plane)
            p.assign(size_t(w) * size_t(h), 0.0f);
    }
    size_t size() const { return plane[0].size(); }
    ConstRgb view() const {
        return {{plane[0].data(), plane[1].data(), plane[2].data()}, width, width, height};
    }
};

/// Uniform in [0,1); std::uniform_real_distribution differs between libraries.
class Uniform {
public:
    explicit Uniform(uint32_t seed) : m_engine(seed) {}
    double operator()() { return double(m_engine()) / 4294967296.0; }

private:
    std::mt19937 m_engine;
};

enum class Content { Noise, Gradient, Patches };

inline std::ostream& operator<<(std::ostream& out, Content content) {
    const char* names[] = {"noise", "gradient", "patches"};
    return out << names[int(content)];
}

/// Noise: twelve stops of it; gradient: smooth over eight stops; patches: flat blocks of 4 x 4.
inline HdrImage make_image(Content content, int width, int height, uint32_t seed) {
    HdrImage image(width, height);
    Uniform random(seed);
    const double phase = random();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                double stops = 12 * random() - 6;
                if (content == Content::Gradient)
                    stops = 4 * std::sin(0.11 * x + 0.07 * y + c + 6 * phase);
                if (content == Content::Patches)
                    stops = (x / 4 * 7 + y / 4 * 5 + c * 3 + int(13 * phase)) % 11 - 5;
                image.plane[c][size_t(y) * size_t(width) + size_t(x)] = float(std::exp2(stops));
            }
    return image;
}

/// Every value times a random factor within 1 +- amount / 2.
inline HdrImage disturbed(HdrImage image, double amount, uint32_t seed) {
    Uniform random(seed);
    for (auto& p : image.plane)
        for (float& v : p)
            v = float(double(v) * (1 + amount * (random() - 0.5)));
    return image;
}

} // namespace tonetool::kernels
