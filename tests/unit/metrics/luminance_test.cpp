// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/luminance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "schedules.h"

namespace tonetool::metrics {
namespace {

using kernels::backwards;
using kernels::in_order;
using kernels::on_threads;
using kernels::ParallelFor;

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

// The luminances of a picture, NaN where they are to be skipped.
std::vector<float> plane_of(const Picture& p, const std::vector<uint8_t>& skip) {
    std::vector<float> out(size_t(p.width) * size_t(p.height));
    const kernels::ConstRgb view = p.view();
    for (int y = 0; y < p.height; ++y)
        luminance_row(view.plane[0] + y * view.stride, view.plane[1] + y * view.stride,
                      view.plane[2] + y * view.stride, out.data() + y * p.width, p.width);
    for (size_t i = 0; i < skip.size(); ++i)
        if (skip[i])
            out[i] = std::numeric_limits<float>::quiet_NaN();
    return out;
}

LuminanceStats luminance_of(const Picture& p, const std::vector<uint8_t>& skip,
                            const ParallelFor& parallel) {
    return luminance(plane_of(p, skip).data(), p.width, p.height, parallel);
}

ExposureStats exposures_of(const Picture& p, const std::vector<uint8_t>& skip,
                           const ParallelFor& parallel) {
    return exposure_statistics(plane_of(p, skip).data(), p.width, p.height, parallel);
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
        expect_statistics(luminance_of(p, {}, in_order()), brute_force(p, {}));
    }
}

TEST(Luminance, RespectsTheStride) {
    const Picture p = random_picture(13, 11, 32);
    expect_statistics(luminance_of(p, {}, in_order()), brute_force(p, {}));
}

TEST(Luminance, SkipsWhatItIsTold) {
    Picture p = random_picture(14, 10);
    std::vector<uint8_t> skip(140, 0);
    for (size_t i = 0; i < skip.size(); i += 3) {
        skip[i] = 1;
        for (auto& plane : p.plane)
            plane[i] = i % 2 ? 0.0f : 1e20f;
    }
    expect_statistics(luminance_of(p, skip, in_order()), brute_force(p, skip));
}

TEST(Luminance, MedianIsTheUpperOne) {
    Picture p(4, 1);
    for (int x = 0; x < 4; ++x)
        p.set(x, 0, float(x + 1), float(x + 1), float(x + 1));
    EXPECT_NEAR(luminance_of(p, {}, in_order()).median, 3.0, 3 * kFloat);
}

TEST(Luminance, BlackCountsAndLitMedian) {
    Picture p(10, 1);
    for (int x = 0; x < 10; ++x) {
        const float v = x < 7 ? 0.0f : float(x);
        p.set(x, 0, v, v, v);
    }
    const LuminanceStats s = luminance_of(p, {}, in_order());
    EXPECT_EQ(s.black, 7);
    EXPECT_EQ(s.median, 0.0);
    EXPECT_NEAR(s.median_lit, 8.0, 8 * kFloat);
    EXPECT_NEAR(s.log_average, std::cbrt(7.0 * 8 * 9), 9 * kFloat);
}

TEST(Luminance, OfBlackIsZero) {
    Picture p(3, 3);
    for (int i = 0; i < 9; ++i)
        p.set(i % 3, i / 3, 0, 0, 0);
    const LuminanceStats s = luminance_of(p, {}, in_order());
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
    const LuminanceStats s = luminance_of(p, {}, in_order());
    EXPECT_NEAR(s.max / double(most), 1.0, kFloat);
}

// Larger than a block of rows, with holes and black pixels.
std::vector<float> luminance_plane(int width, int height) {
    std::mt19937 random(9);
    std::vector<float> plane(size_t(width) * size_t(height));
    for (float& v : plane) {
        const auto r = uint32_t(random());
        v = std::exp2(float(r) * 0x1p-32f * 20 - 10);
        if (r % 5 == 0)
            v = 0;
        if (r % 13 == 0)
            v = r % 2 ? std::numeric_limits<float>::quiet_NaN()
                      : std::numeric_limits<float>::infinity();
    }
    return plane;
}

std::vector<double> figures(const LuminanceStats& s) {
    return {s.min,         s.max, s.mean, s.median, s.median_lit,
            s.log_average, s.p1,  s.p99,  s.p999,   double(s.black)};
}

std::vector<double> figures(const ExposureStats& s) {
    return {s.max, s.median, s.median_lit, double(s.black), double(s.counted)};
}

TEST(Luminance, OfAPlaneLooksAtFiniteValuesOnly) {
    const auto plane = luminance_plane(517, 301);
    std::vector<double> finite;
    for (float v : plane)
        if (std::isfinite(v))
            finite.push_back(double(v));
    std::sort(finite.begin(), finite.end());
    expect_statistics(luminance(plane.data(), 517, 301, in_order()), finite);
}

TEST(Luminance, ExposureStatisticsAreThoseOfTheWhole) {
    const int sizes[][2] = {{517, 301}, {1, 1}, {2, 1}, {3, 5}};
    for (const auto& size : sizes) {
        const auto plane = luminance_plane(size[0], size[1]);
        const LuminanceStats all = luminance(plane.data(), size[0], size[1], in_order());
        const ExposureStats some = exposure_statistics(plane.data(), size[0], size[1], in_order());
        EXPECT_EQ(some.counted, std::count_if(plane.begin(), plane.end(),
                                              [](float v) { return std::isfinite(v); }));
        EXPECT_EQ(some.black, all.black);
        EXPECT_EQ(some.max, all.max);
        EXPECT_EQ(some.median, all.median);
        EXPECT_EQ(some.median_lit, all.median_lit);
    }
}

TEST(Luminance, OfNothingIsZero) {
    EXPECT_EQ(figures(luminance(nullptr, 0, 0, in_order())), std::vector<double>(10, 0.0));
    const std::vector<float> holes(6, std::numeric_limits<float>::quiet_NaN());
    EXPECT_EQ(figures(luminance(holes.data(), 3, 2, in_order())), std::vector<double>(10, 0.0));
    EXPECT_EQ(figures(exposure_statistics(holes.data(), 3, 2, in_order())),
              std::vector<double>(5, 0.0));
}

TEST(Luminance, ScheduleDoesNotChangeABit) {
    const Picture p = random_picture(700, 301, 704);
    std::vector<uint8_t> skip(700 * 301, 0);
    for (size_t i = 0; i < skip.size(); i += 7)
        skip[i] = 1;
    const auto all = figures(luminance_of(p, skip, in_order()));
    const auto some = figures(exposures_of(p, skip, in_order()));
    for (const ParallelFor& parallel : {backwards(), on_threads(2), on_threads(7)}) {
        EXPECT_EQ(figures(luminance_of(p, skip, parallel)), all);
        EXPECT_EQ(figures(exposures_of(p, skip, parallel)), some);
    }
}

// An image may become a plane in bands, by whoever reads it.
TEST(Luminance, OfRowsOneByOneIsThatOfTheImage) {
    const Picture p = random_picture(37, 23, 40);
    std::vector<float> plane(37 * 23);
    for (int y = 0; y < 23; ++y)
        luminance_row(p.plane[0].data() + y * 40, p.plane[1].data() + y * 40,
                      p.plane[2].data() + y * 40, plane.data() + y * 37, 37);
    EXPECT_EQ(figures(luminance(plane.data(), 37, 23, in_order())),
              figures(luminance_of(p, {}, in_order())));
    expect_statistics(luminance(plane.data(), 37, 23, in_order()), brute_force(p, {}));
}

} // namespace
} // namespace tonetool::metrics
