#include "metrics/luminance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace tonetool::metrics {
namespace {

struct Picture {
    int width, height, stride;
    std::vector<float> plane[3];

    Picture(int w, int h, int s = 0) : width(w), height(h), stride(s ? s : w) {
        for (auto& p : plane)
            p.assign(size_t(stride) * size_t(h), 1e9f);
    }
    void set(int x, int y, float r, float g, float b) {
        const float rgb[3] = {r, g, b};
        for (int c = 0; c < 3; ++c)
            plane[c][size_t(y * stride + x)] = rgb[c];
    }
    kernels::ConstRgb view() const {
        return {{plane[0].data(), plane[1].data(), plane[2].data()}, stride, width, height};
    }
};

Picture random_picture(int width, int height, int stride = 0) {
    Picture picture(width, height, stride);
    std::mt19937 random(5);
    const auto value = [&] { return std::exp2(float(random()) * 0x1p-32f * 12 - 6); };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float r = value(), g = value(), b = value();
            picture.set(x, y, r, g, b);
        }
    return picture;
}

// Luminances that are looked at, ascending.
std::vector<double> brute_force(const Picture& p, const std::vector<uint8_t>& skip) {
    std::vector<double> out;
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x) {
            if (!skip.empty() && skip[size_t(y * p.width + x)])
                continue;
            const size_t i = size_t(y * p.stride + x);
            out.push_back(0.2126 * double(p.plane[0][i]) + 0.7152 * double(p.plane[1][i]) +
                          0.0722 * double(p.plane[2][i]));
        }
    std::sort(out.begin(), out.end());
    return out;
}

// Single luminances are float: three products, two sums and rounded weights, 2^-24 each.
constexpr double kFloat = 4e-7;

void expect_statistics(const LuminanceStats& s, const std::vector<double>& all) {
    const size_t n = all.size();
    const auto lit = std::upper_bound(all.begin(), all.end(), 0.0);
    const auto lit_n = size_t(all.end() - lit);
    const auto near = [](double ours, double exact) { EXPECT_NEAR(ours, exact, kFloat * exact); };
    near(s.min, all.front());
    near(s.max, all.back());
    near(s.median, all[n / 2]);
    near(s.median_lit, lit_n ? lit[ptrdiff_t(lit_n / 2)] : 0);
    near(s.p1, all[size_t(std::ceil(0.01 * double(n))) - 1]);
    near(s.p99, all[size_t(std::ceil(0.99 * double(n))) - 1]);
    near(s.p999, all[size_t(std::ceil(0.999 * double(n))) - 1]);
    double sum = 0, logs = 0;
    for (double v : all)
        sum += v;
    for (auto v = lit; v != all.end(); ++v)
        logs += std::log(*v);
    near(s.mean, sum / double(n));
    near(s.log_average, lit_n ? std::exp(logs / double(lit_n)) : 0);
    EXPECT_EQ(s.black, int64_t(n - lit_n));
}

TEST(Luminance, AgreesWithBruteForce) {
    // Even and odd counts: the median is the upper one.
    const int sizes[][2] = {{1, 1}, {2, 1}, {3, 1}, {1, 2}, {16, 9}, {33, 17}, {40, 25}};
    for (const auto& size : sizes) {
        SCOPED_TRACE(testing::Message() << size[0] << "x" << size[1]);
        const Picture p = random_picture(size[0], size[1]);
        expect_statistics(luminance(p.view(), {}), brute_force(p, {}));
    }
}

TEST(Luminance, RespectsTheStride) {
    const Picture p = random_picture(13, 11, 32);
    expect_statistics(luminance(p.view(), {}), brute_force(p, {}));
}

TEST(Luminance, SkipsWhatItIsTold) {
    Picture p = random_picture(14, 10);
    std::vector<uint8_t> skip(140, 0);
    for (size_t i = 0; i < skip.size(); i += 3) {
        skip[i] = 1;
        for (auto& plane : p.plane)
            plane[i] = i % 2 ? 0.0f : 1e20f;
    }
    expect_statistics(luminance(p.view(), skip), brute_force(p, skip));
}

TEST(Luminance, MedianIsTheUpperOne) {
    Picture p(4, 1);
    for (int x = 0; x < 4; ++x)
        p.set(x, 0, float(x + 1), float(x + 1), float(x + 1));
    EXPECT_NEAR(luminance(p.view(), {}).median, 3.0, 3 * kFloat);
}

TEST(Luminance, BlackCountsAndLitMedian) {
    Picture p(10, 1);
    for (int x = 0; x < 10; ++x) {
        const float v = x < 7 ? 0.0f : float(x);
        p.set(x, 0, v, v, v);
    }
    const LuminanceStats s = luminance(p.view(), {});
    EXPECT_EQ(s.black, 7);
    EXPECT_EQ(s.median, 0.0);
    EXPECT_NEAR(s.median_lit, 8.0, 8 * kFloat);
    EXPECT_NEAR(s.log_average, std::cbrt(7.0 * 8 * 9), 9 * kFloat);
}

TEST(Luminance, OfBlackIsZero) {
    Picture p(3, 3);
    for (int i = 0; i < 9; ++i)
        p.set(i % 3, i / 3, 0, 0, 0);
    const LuminanceStats s = luminance(p.view(), {});
    EXPECT_EQ(s.black, 9);
    for (double v : {s.min, s.max, s.mean, s.median, s.median_lit, s.log_average, s.p999})
        EXPECT_EQ(v, 0.0);
}

// R = G = B = FLT_MAX is finite; its luminance must be, too, or the maximum of the image is lost.
TEST(Luminance, OfTheLargestFloatsIsNotLost) {
    Picture p(2, 1);
    const float most = std::numeric_limits<float>::max();
    p.set(0, 0, 1, 1, 1);
    p.set(1, 0, most, most, most);
    const LuminanceStats s = luminance(p.view(), {});
    EXPECT_NEAR(s.max / double(most), 1.0, kFloat);
}

} // namespace
} // namespace tonetool::metrics
