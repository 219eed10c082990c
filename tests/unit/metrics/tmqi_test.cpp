// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/tmqi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "schedules.h"

namespace tonetool::metrics {
namespace {

using kernels::backwards;
using kernels::in_order;
using kernels::on_threads;
using kernels::ParallelFor;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct Picture {
    int width, height;
    std::vector<float> hdr, ldr;

    Picture(int w, int h) : width(w), height(h), hdr(size_t(w) * size_t(h)), ldr(hdr.size()) {}
    size_t at(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
};

struct Scored {
    TmqiScore score;
    std::vector<float> map;
};

Scored scored(const Picture& p, const ParallelFor& parallel = in_order()) {
    Scored out;
    out.map.assign(p.hdr.size(), kNan);
    const auto range = light_range(p.hdr.data(), p.width, p.height, parallel);
    out.score =
        tmqi({p.hdr.data(), p.ldr.data(), p.width, p.height}, range, out.map.data(), parallel);
    return out;
}

// Light of eight octaves and 0; the picture is its logarithm, disturbed.
Picture noise(int width, int height) {
    Picture p(width, height);
    std::mt19937 random(5);
    for (size_t i = 0; i < p.hdr.size(); ++i) {
        const double u = double(random()) * 0x1p-32, v = double(random()) * 0x1p-32;
        p.hdr[i] = i == 7 ? 0.0f : float(std::exp2(8 * u - 4));
        p.ldr[i] = float(255 * (0.8 * u + 0.2 * v));
    }
    return p;
}

bool is_finite(const Scored& s) {
    for (const float v : s.map)
        if (!std::isfinite(v))
            return false;
    return std::isfinite(s.score.q) && std::isfinite(s.score.s) && std::isfinite(s.score.n);
}

TEST(Tmqi, NaturalnessIs1AtItsModes) {
    Picture p(33, 22);
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const int i = (y % 11) * 11 + x % 11; // 60 above, 60 below, one at the mean
            const double deviation = i == 60 ? 0 : i < 60 ? 17.487 : -17.487;
            p.ldr[p.at(x, y)] = float(115.94 + deviation);
            p.hdr[p.at(x, y)] = float(x);
        }
    const TmqiScore s = scored(p).score;
    EXPECT_NEAR(s.mean, 115.94, 1e-5) << "floats";
    EXPECT_NEAR(s.deviation, 17.487, 1e-5);
    EXPECT_NEAR(s.n, 1, 1e-8);
    EXPECT_NEAR(s.q, 0.8012 * std::pow(s.s, 0.3046) + 0.1988, 1e-8);
}

TEST(Tmqi, BlocksBeyondThePictureAreBlack) {
    Picture p(12, 11);
    std::fill(p.ldr.begin(), p.ldr.end(), 100.0f);
    p.hdr[0] = 1;
    // The second block has 11 pixels of 100 and 110 of 0.
    const double mean = 1100.0 / 121;
    const double deviation =
        std::sqrt((11 * (100 - mean) * (100 - mean) + 110 * mean * mean) / 120);
    EXPECT_NEAR(scored(p).score.deviation, deviation / 2, 1e-10);
}

TEST(Tmqi, AnAffineCopyKeepsTheStructure) {
    Picture p = noise(70, 50);
    const auto range = light_range(p.hdr.data(), p.width, p.height, in_order());
    for (size_t i = 0; i < p.hdr.size(); ++i)
        p.ldr[i] = float(255 * (double(p.hdr[i]) - range.low) / (range.high - range.low));
    const Scored s = scored(p);
    EXPECT_GT(s.score.s, 0.999);
    EXPECT_LE(s.score.s, 1.0);
    for (const float v : s.map)
        EXPECT_GT(v, 0.99f);
}

TEST(Tmqi, AnInvertedCopyHasNoStructureAndIsNoNan) {
    Picture p = noise(70, 50);
    const auto range = light_range(p.hdr.data(), p.width, p.height, in_order());
    for (size_t i = 0; i < p.hdr.size(); ++i)
        p.ldr[i] = float(255 * (range.high - double(p.hdr[i])) / (range.high - range.low));
    const Scored s = scored(p);
    EXPECT_LT(s.score.scales[0], 0);
    EXPECT_EQ(s.score.s, 0);
    EXPECT_TRUE(is_finite(s));
    EXPECT_GE(*std::min_element(s.map.begin(), s.map.end()), -1.0f);
}

TEST(Tmqi, ConstantWindowsAreNoNan) {
    Picture p(60, 60);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 60; ++x)
            p.hdr[p.at(x, y)] = x < 30 ? 1e-3f : 1e4f; // and a black picture of it
    const Scored black = scored(p);
    EXPECT_TRUE(is_finite(black));
    EXPECT_EQ(black.score.n, 0);
    for (size_t i = 0; i < p.hdr.size(); ++i)
        p.ldr[i] = p.hdr[i] < 1 ? 10.0f : 240.0f;
    const Scored shown = scored(p);
    EXPECT_TRUE(is_finite(shown));
    EXPECT_GT(shown.score.s, black.score.s);
    // Bright and constant: exactly no variance, so both images show nothing there.
    EXPECT_NEAR(shown.map[p.at(45, 30)], 1, 1e-6);
}

TEST(Tmqi, TheUnitOfLightDoesNotMatter) {
    Picture p = noise(40, 30), other = p;
    for (float& v : other.hdr)
        v *= 1024;
    EXPECT_EQ(scored(p).map, scored(other).map);
    EXPECT_EQ(scored(p).score.q, scored(other).score.q);
}

TEST(Tmqi, SchedulesDoNotChangeABit) {
    const Picture p = noise(300, 470); // several blocks at the two finest scales
    const Scored a = scored(p);
    for (const ParallelFor& parallel : {backwards(), on_threads(3)}) {
        const Scored b = scored(p, parallel);
        EXPECT_EQ(a.map, b.map);
        EXPECT_EQ(a.score.scales, b.score.scales);
        EXPECT_EQ(a.score.n, b.score.n);
        EXPECT_EQ(a.score.q, b.score.q);
    }
}

TEST(Tmqi, HolesHaveNoStructureUnlessInBoth) {
    Picture p = noise(40, 30);
    p.hdr[p.at(5, 6)] = kNan;
    p.ldr[p.at(30, 20)] = std::numeric_limits<float>::infinity();
    p.hdr[p.at(20, 10)] = p.ldr[p.at(20, 10)] = kNan;
    const Scored holes = scored(p);
    EXPECT_TRUE(is_finite(holes));
    EXPECT_EQ(holes.map[p.at(5, 6)], 0.0f);
    EXPECT_EQ(holes.map[p.at(30, 20)], 0.0f);
    p.hdr[p.at(5, 6)] = p.hdr[p.at(20, 10)] = 0;
    p.ldr[p.at(30, 20)] = p.ldr[p.at(20, 10)] = 0;
    const Scored black = scored(p);
    EXPECT_EQ(holes.map[p.at(20, 10)], black.map[p.at(20, 10)]);
    EXPECT_EQ(holes.score.scales[1], black.score.scales[1]);
    EXPECT_EQ(holes.score.n, black.score.n);
}

// The finest scale, each window by itself: weighted deviations from its mean.
double brute_force(const Picture& p, const LightRange& range, int x0, int y0) {
    double weights[11][11], sum = 0, mean[2] = {}, vv[2] = {}, hl = 0;
    const auto value = [&](int dx, int dy, int which) {
        const int x = x0 + dx - 5, y = y0 + dy - 5;
        if (x < 0 || y < 0 || x >= p.width || y >= p.height)
            return 0.0;
        const double h = double(p.hdr[p.at(x, y)]);
        return which == 1 ? double(p.ldr[p.at(x, y)])
                          : std::round(4294967295.0 / (range.high - range.low) * (h - range.low));
    };
    const auto each = [&](const std::function<void(int, int)>& visit) {
        for (int dy = 0; dy < 11; ++dy)
            for (int dx = 0; dx < 11; ++dx)
                visit(dx, dy);
    };
    each([&](int dx, int dy) {
        const int square = (dx - 5) * (dx - 5) + (dy - 5) * (dy - 5);
        sum += weights[dy][dx] = std::exp(-square / 4.5);
    });
    each([&](int dx, int dy) {
        weights[dy][dx] /= sum;
        for (int i = 0; i < 2; ++i)
            mean[i] += weights[dy][dx] * value(dx, dy, i);
    });
    each([&](int dx, int dy) {
        const double d[2] = {value(dx, dy, 0) - mean[0], value(dx, dy, 1) - mean[1]};
        for (int i = 0; i < 2; ++i)
            vv[i] += weights[dy][dx] * d[i] * d[i];
        hl += weights[dy][dx] * d[0] * d[1];
    });
    // 128 / (1.4 CSF(16 cycles per degree)), published as 1.32361.
    const double u = 128 / (1.4 * 260 * (0.0192 + 0.114 * 16) * std::exp(-std::pow(1.824, 1.1)));
    EXPECT_NEAR(u, 1.32361, 5e-6);
    const double sh = std::sqrt(vv[0]), sl = std::sqrt(vv[1]);
    const auto seen = [&](double s) { return 0.5 * std::erfc((u - s) * 3 / u / std::sqrt(2.0)); };
    const double a = seen(sh), b = seen(sl);
    return (2 * a * b + 0.01) / (a * a + b * b + 0.01) * (hl + 10) / (sh * sl + 10);
}

TEST(Tmqi, AgreesWithBruteForce) {
    Picture p = noise(29, 23);
    for (int y = 8; y < 23; ++y) // fine shades, below and around what is seen
        for (int x = 10; x < 29; ++x)
            p.ldr[p.at(x, y)] = float(100 + 0.02 * double(p.ldr[p.at(x, y)]));
    const auto range = light_range(p.hdr.data(), p.width, p.height, in_order());
    const Scored s = scored(p);
    double sum = 0;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            const double expected = brute_force(p, range, x, y);
            EXPECT_NEAR(s.map[p.at(x, y)], expected, 1e-7) << x << "," << y; // the map is float
            sum += expected;
        }
    EXPECT_NEAR(s.score.scales[0], sum / double(p.hdr.size()), 1e-10);
}

} // namespace
} // namespace tonetool::metrics
