// SPDX-License-Identifier: BSD-3-Clause
// The tests of the lanes compare with the reference implementation; here it meets numbers that the
// published program gives.
#include "kernels/flip_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flip/filters.h"
#include "hdr_image.h"
#include "kernels/flip_constants.h"
#include "oracle.h"
#include "tonemap/rational.h"

namespace tonetool::kernels {
namespace {

// float(0.7 * 3840 / 0.7 * pi / 180)
constexpr double kPpd = 67.0206451;

PlaneImage<> constant(int width, int height, double r, double g, double b) {
    const auto n = size_t(width) * size_t(height);
    return {width,
            height,
            {std::vector<double>(n, r), std::vector<double>(n, g), std::vector<double>(n, b)}};
}

PlaneImage<> planes_of(const HdrImage& image) {
    return tone_map_reference(image.view(), {}, 0.0);
}

TEST(LdrFlipReference, ConstantImagesGiveThePublishedErrors) {
    const auto taps = flip::make_taps(kPpd);
    // Black against white: L = 100, no chroma, no feature.
    const double knee = kKneeShare * kLargestQ;
    const double white =
        kKneeError + (std::pow(100, 0.7) - knee) / (kLargestQ - knee) * (1 - kKneeError);
    const struct {
        PlaneImage<> reference, test;
        double exact, published;
    } cases[] = {{constant(5, 4, 0, 1, 0), constant(5, 4, 0, 0, 1), 1.0, 1.0},
                 {constant(5, 4, 0, 0, 0), constant(5, 4, 1, 1, 1), white, 0.9673883},
                 {constant(1, 1, 0, 0, 0), constant(1, 1, 1, 1, 1), white, 0.9673883}};
    for (const auto& c : cases) {
        const auto error = ldr_flip_reference(c.reference, c.test, taps);
        // Detectors of double sum to 1e-16 instead of 0; f is its root, E = color^(1 - f).
        for (double e : error)
            ASSERT_NEAR(e, c.exact, 1e-8);
        // In float they sum to 1e-7, f = 2.7e-4: 1e-5, as for every published figure.
        EXPECT_NEAR(error[0], c.published, 1e-5);
    }
}

TEST(LdrFlipReference, IsZeroOnIdentityAndSymmetric) {
    const auto taps = flip::make_taps(20);
    const HdrImage a = make_image(Content::Noise, 17, 9, 1), b = disturbed(a, 0.5, 2);
    for (double e : ldr_flip_reference(planes_of(a), planes_of(a), taps))
        EXPECT_EQ(e, 0.0);
    EXPECT_EQ(ldr_flip_reference(planes_of(a), planes_of(b), taps),
              ldr_flip_reference(planes_of(b), planes_of(a), taps));
}

TEST(LdrFlipReference, TurnsWithTheImages) {
    const auto taps = flip::make_taps(67);
    const auto turn = [](const PlaneImage<>& in) {
        PlaneImage<> out = constant(in.height, in.width, 0, 0, 0);
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < in.height; ++y)
                for (int x = 0; x < in.width; ++x)
                    out.plane[c][size_t(x * in.height + y)] = in.plane[c][size_t(y * in.width + x)];
        return out;
    };
    const HdrImage a = make_image(Content::Noise, 13, 7, 3), b = disturbed(a, 0.5, 4);
    const auto upright = ldr_flip_reference(planes_of(a), planes_of(b), taps);
    const auto turned = ldr_flip_reference(turn(planes_of(a)), turn(planes_of(b)), taps);
    for (int y = 0; y < 7; ++y)
        for (int x = 0; x < 13; ++x) // sums of doubles in another order, times the slope at 0
            EXPECT_NEAR(upright[size_t(y * 13 + x)], turned[size_t(x * 7 + y)], 1e-9);
}

TEST(HdrFlipReference, IsTheFirstMaximumOverTheExposures) {
    const auto taps = flip::make_taps(30);
    const ToneCurve aces = *tonemap::rational_curve("aces");
    const HdrImage a = make_image(Content::Gradient, 21, 8, 5), b = disturbed(a, 0.4, 6);
    const std::vector<double> stops = {-3, -1, -1, 2};
    std::vector<int> index;
    const auto error = hdr_flip_reference(a.view(), b.view(), taps, aces, stops, &index);
    std::vector<double> best(error.size());
    std::vector<int> first(error.size());
    for (size_t n = 0; n < stops.size(); ++n) {
        const auto one = ldr_flip_reference(tone_map_reference(a.view(), aces, stops[n]),
                                            tone_map_reference(b.view(), aces, stops[n]), taps);
        for (size_t i = 0; i < one.size(); ++i)
            if (one[i] > best[i]) {
                best[i] = one[i];
                first[i] = int(n);
            }
    }
    EXPECT_EQ(error, best);
    EXPECT_EQ(index, first);
    EXPECT_EQ(std::count(index.begin(), index.end(), 2), 0) << "exposure 2 repeats exposure 1";
}

// Float evaluates the same formulas: what it misses is rounding, up to the D2 taps that sum to 1e-7
// instead of 0, which the root and the power at small errors make 1e-3 of.
TEST(HdrFlipReference, InFloatIsCloseToItself) {
    const auto taps = flip::make_taps(67);
    const FlipTaps<float> float_taps = rounded(taps);
    const HdrImage a = make_image(Content::Noise, 23, 18, 7), b = disturbed(a, 0.4, 8);
    for (const char* curve : {"aces", "hable", "reinhard"}) {
        const ToneCurve tone = *tonemap::rational_curve(curve);
        const auto exact = hdr_flip_reference(a.view(), b.view(), taps, tone, {-2, 1}, nullptr);
        const auto plain =
            hdr_flip_reference(a.view(), b.view(), float_taps, tone, {-2, 1}, nullptr);
        double largest = 0;
        for (size_t i = 0; i < exact.size(); ++i)
            largest = std::max(largest, std::abs(double(plain[i]) - exact[i]));
        EXPECT_LT(largest, 1e-3) << curve;
        EXPECT_GT(largest, 1e-9) << curve << ": that would not be float";
    }
}

TEST(ToneMapReference, FollowsTheCurves) {
    HdrImage pixel(1, 1);
    pixel.plane[0] = {0.5f};
    pixel.plane[1] = {2.0f};
    pixel.plane[2] = {0.25f};
    const double x = 1.0, lum = 0.2126 * 1 + 0.7152 * 4 + 0.0722 * 0.5; // exposed by one stop
    const struct {
        ToneCurve curve;
        double red;
    } cases[] = {
        {{}, 1.0},
        {*tonemap::rational_curve("aces"), (0.9036 * x + 0.018) / (0.8748 * x + 0.354 + 0.14)},
        {*tonemap::rational_curve("hable"), (0.231683 + 0.013791) / (0.18 + 0.3 + 0.018)},
        {*tonemap::rational_curve("reinhard"), x / (1 + lum)}};
    for (const auto& c : cases) // a handful of double roundings
        EXPECT_NEAR(tone_map_reference(pixel.view(), c.curve, 1.0).plane[0][0], c.red, 1e-14);
}

TEST(FlipConstants, AreThoseOfThePaper) {
    // L, a', b' of pure green and pure blue give the largest HyAB.
    EXPECT_NEAR(std::pow(kLargestHyab, 0.7), kLargestQ, 1e-12);
    EXPECT_NEAR(kLargestQ, 41.2760963, 4e-6);  // a float32 figure
    EXPECT_NEAR(kWhite[0], 0.950428545, 6e-8); // float32 figures
    EXPECT_NEAR(kWhite[1], 1.0, 1e-15);
    EXPECT_NEAR(kWhite[2], 1.088900371, 6e-8);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            double sum = 0;
            for (int k = 0; k < 3; ++k)
                sum += kXyzToRgb[i][k] * kRgbToXyz[k][j];
            EXPECT_NEAR(sum, i == j, 1e-14); // kXyzToRgb is written with 15 decimals
        }
}

} // namespace
} // namespace tonetool::kernels
