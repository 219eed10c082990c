// SPDX-License-Identifier: BSD-3-Clause
// bias_check() on pictures that are not what a renderer should deliver, and its maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bias_pictures.h"
#include "metrics/bias_grid.h"

namespace tonetool::metrics {
namespace {

using kernels::in_order;
using kernels::on_threads;

constexpr float kInf = std::numeric_limits<float>::infinity();

RenderOptions skewed(double gain = 1) {
    RenderOptions options;
    options.power = 4;
    options.gain = gain;
    return options;
}

Render with_fireflies(uint64_t seed) {
    RenderOptions options = skewed();
    options.fireflies = 0.002;
    return {128, 96, seed, options};
}

RenderOptions clean() {
    RenderOptions options;
    options.noise = 0;
    return options;
}

void set_pixel(Render& image, int x, int y, float value) {
    for (int c = 0; c < 3; ++c)
        image.at(c, x, y) = value;
}

TEST(BiasPictures, PixelsThatAreNotFiniteCountAsZeroOnBothSides) {
    const Render a(128, 96, 1, skewed()), b(128, 96, 2, skewed(1.3));
    Render bad_a = a, bad_b = b, zero_a = a, zero_b = b;
    bad_a.at(0, 3, 3) = std::nanf("");
    bad_b.at(1, 64, 40) = -kInf;
    bad_b.at(2, 127, 95) = kInf;
    bad_a.at(0, 127, 95) = kInf;
    for (Render* image : {&zero_a, &zero_b}) {
        set_pixel(*image, 3, 3, 0);
        set_pixel(*image, 64, 40, 0);
        set_pixel(*image, 127, 95, 0);
    }
    for (const bool added : {false, true}) {
        const BiasResult got =
            added ? bias_check(side_of({bad_a, bad_a}), side_of({bad_b, bad_b}), {}, in_order())
                  : check_pair(bad_a, bad_b);
        const BiasResult want =
            added ? bias_check(side_of({zero_a, zero_a}), side_of({zero_b, zero_b}), {}, in_order())
                  : check_pair(zero_a, zero_b);
        EXPECT_EQ(got.nonfinite, 3);
        EXPECT_EQ(want.nonfinite, 0);
        EXPECT_EQ(got.verdict, want.verdict);
        EXPECT_EQ(got.bound, want.bound);
        EXPECT_EQ(got.absolute, want.absolute);
        EXPECT_EQ(got.correlation, want.correlation);
        EXPECT_EQ(got.asymmetry, want.asymmetry);
        for (size_t s = 0; s < kBiasScales; ++s) {
            EXPECT_EQ(got.scales[s].structure_p, want.scales[s].structure_p);
            for (size_t c = 0; c < kBiasChannels; ++c)
                EXPECT_EQ(got.scales[s].channel[c].p, want.scales[s].channel[c].p);
        }
    }
}

TEST(BiasPictures, UnlikeNoiseWithPixelsThatAreNotFinite) {
    Render a(128, 96, 1, clean()), b = with_fireflies(2);
    Render zero_a = a, zero_b = b;
    b.at(1, 64, 40) = kInf;
    set_pixel(zero_a, 64, 40, 0);
    set_pixel(zero_b, 64, 40, 0);
    const BiasResult got = check_pair(a, b), want = check_pair(zero_a, zero_b);
    EXPECT_EQ(got.unlike, 1);
    EXPECT_EQ(got.rare, want.rare);
    EXPECT_GT(got.rare[0], 0);
    EXPECT_EQ(got.scales[0].channel[0].t, want.scales[0].channel[0].t);
}

TEST(BiasPictures, PixelsThatAreNotFiniteBarEqual) {
    const auto expect_barred = [](Render a, Render b) {
        EXPECT_EQ(check_pair(a, b).verdict, BiasVerdict::Equal);
        a.at(1, 30, 30) = kInf;
        for (const Render& test : {b, a}) { // in one side, in both
            const BiasResult got = check_pair(a, test);
            EXPECT_EQ(got.verdict, BiasVerdict::NotEnoughSamples);
            EXPECT_EQ(got.reason, BiasReason::NonFinite);
            EXPECT_FALSE(got.more.has_value()) << "more samples would not help";
        }
    };
    RenderOptions little;
    little.noise = 0.2;
    expect_barred({192, 128, 1, little}, {192, 128, 2, little});
    const Render image(192, 128, 1, little);
    expect_barred(image, image);
    expect_barred(image, image.changed([](float v) { return v * (1 + 0x1p-12f); }));
}

// They do not hide what the others show.
TEST(BiasPictures, PixelsThatAreNotFiniteDoNotBarDifferent) {
    RenderOptions brighter;
    brighter.gain = 1.2;
    Render a(128, 96, 1), b(128, 96, 2, brighter);
    a.at(0, 0, 0) = std::nanf("");
    EXPECT_EQ(check_pair(a, b).verdict, BiasVerdict::Different);
}

TEST(BiasPictures, AllNotFinite) {
    const Render a = Render(128, 96, 1).changed([](float) { return std::nanf(""); });
    const BiasResult got = check_pair(a, Render(128, 96, 2));
    EXPECT_EQ(got.verdict, BiasVerdict::NotEnoughSamples);
    EXPECT_EQ(got.nonfinite, 128 * 96);
}

TEST(BiasPictures, BlackReference) {
    const Render black = Render(128, 96, 1).changed([](float) { return 0.0f; });
    const BiasResult got = check_pair(black, Render(128, 96, 2, skewed()));
    EXPECT_EQ(got.verdict, BiasVerdict::Different);
    EXPECT_TRUE(std::isinf(got.bound)) << "nothing to relate the difference to";
    const BiasResult back = check_pair(Render(128, 96, 2, skewed()), black);
    EXPECT_EQ(back.verdict, BiasVerdict::Different);
    EXPECT_NEAR(back.gain[0].energy, -1, 1e-12);
}

TEST(BiasPictures, NegativeValuesStay) {
    const auto negative = [](float v) { return v - 0.0625f; };
    const Render a(128, 96, 1, skewed()), b(128, 96, 2, skewed());
    const BiasResult plain = check_pair(a, b);
    const BiasResult got = check_pair(a.changed(negative), b.changed(negative));
    for (size_t i = 0; i < plain.scales[2].channel[0].mean.size(); ++i)
        EXPECT_NEAR(got.scales[2].channel[0].mean[i], plain.scales[2].channel[0].mean[i], 1e-8);
    const auto minus = [](float v) { return -v; };
    const BiasResult all = check_pair(a.changed(minus), b.changed(minus));
    EXPECT_EQ(all.gain[0].gain, 0.0) << "no weight without light";
    EXPECT_EQ(all.dark, 0.0);
    EXPECT_EQ(all.verdict, BiasVerdict::NotEnoughSamples);
    EXPECT_EQ(all.scales[0].channel[0].se, plain.scales[0].channel[0].se);
}

TEST(BiasPictures, SmallImagesAreNotJudged) {
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(63, 65), std::pair(4095, 1)}) {
        const Render a(width, height, 1);
        const BiasResult got = check_pair(a, a);
        EXPECT_EQ(got.verdict, BiasVerdict::NotEnoughSamples);
        EXPECT_EQ(got.reason, BiasReason::TooSmall);
        EXPECT_FALSE(got.more.has_value());
    }
    EXPECT_EQ(check_pair(Render(64, 64, 1), Render(64, 64, 1)).reason, BiasReason::Identical);
}

TEST(BiasPictures, LongAndThinImages) {
    for (const auto& [width, height] :
         {std::pair(4096, 1), std::pair(1, 4096), std::pair(2, 2049)}) {
        RenderOptions bright;
        bright.gain = 1.5;
        const BiasResult got = check_pair({width, height, 1}, {width, height, 2, bright});
        EXPECT_EQ(got.verdict, BiasVerdict::Different) << width;
        EXPECT_EQ(got.scales[2].blocks(),
                  64 * std::max(1, width / 4096) * std::max(height, width) / 4096)
            << width;
        for (const BiasScale& scale : got.scales)
            for (const double p : scale.channel[0].p)
                EXPECT_TRUE(p >= 0 && p <= 1) << p;
    }
}

// Without pairs there is nothing to judge the noise or structures by.
TEST(BiasPictures, OneColumnHasNoPairs) {
    const BiasResult got = check_pair({1, 4096, 1}, {1, 4096, 2});
    EXPECT_EQ(got.asymmetry, 0.0);
    for (const double p : got.scales[2].structure_p)
        EXPECT_EQ(p, 1.0);
}

TEST(BiasPictures, CorrelatedNeighboursAreNotEnough) {
    RenderOptions smooth;
    smooth.smooth = 0.4;
    const BiasResult got = check_pair({192, 128, 1, smooth}, {192, 128, 2, smooth});
    EXPECT_TRUE(got.correlated);
    EXPECT_EQ(got.verdict, BiasVerdict::NotEnoughSamples);
    EXPECT_EQ(got.reason, BiasReason::Correlated);
    EXPECT_FALSE(got.more.has_value());
    EXPECT_TRUE(got.scales[0].structure_p.empty());
}

TEST(BiasPictures, WhatIsKnownOfTheNoiseIsBelieved) {
    const Render a(128, 96, 1, clean()), b = with_fireflies(2);
    const auto unlike = [](const Render& r, const Render& t, const char* noise) {
        BiasTest options;
        options.reference = noise;
        return check_pair(r, t, options).unlike;
    };
    EXPECT_EQ(unlike(a, b, "auto"), 1);
    EXPECT_EQ(unlike(b, a, "auto"), -1);
    EXPECT_EQ(unlike(a, b, "alike"), 0);
    EXPECT_EQ(unlike(b, a, "converged"), 1);
    const Render c(128, 96, 2, skewed()), d(128, 96, 3, skewed());
    EXPECT_EQ(unlike(c, d, "auto"), 0);
    EXPECT_EQ(unlike(c, d, "converged"), 1);
}

// Blocks of all sizes of images, against the definition.
TEST(BiasGrid, EveryPixelIsInOneBlockAndOneCell) {
    for (int size = 1; size < 300; ++size) {
        const bias::Cells cells(size, 1);
        for (const int edge : cells.grid.x)
            ASSERT_LE(edge, size);
        for (size_t i = 0; i + 1 < cells.grid.x.size(); ++i) {
            ASSERT_LT(cells.grid.x[i], cells.grid.x[i + 1]);
            ASSERT_LT(cells.grid.x[i + 1] - cells.grid.x[i], 24);
        }
        for (size_t s = 0; s < kBiasScales; ++s) {
            const bias::Cells::Scale& scale = cells.scale[s];
            const int wanted = std::max(1, int(std::floor(double(size) / kBiasBlocks[s] + 0.5)));
            ASSERT_EQ(scale.grid.columns(), wanted) << size;
            ASSERT_EQ(scale.grid.x.front(), 0);
            ASSERT_EQ(scale.grid.x.back(), size);
            for (size_t i = 0; i < scale.x.size(); ++i)
                ASSERT_EQ(cells.grid.x[size_t(scale.x[i])], scale.grid.x[i]);
        }
    }
}

TEST(BiasMaps, SignedShowsTheFinestRejectedBlock) {
    RenderOptions changed = skewed();
    changed.corner = 6;
    const BiasResult got = check_pair({128, 96, 1, skewed()}, {128, 96, 2, changed});
    ASSERT_GT(got.scales[0].rejected, 0);
    const auto map = planes_of(got, BiasMap::Signed, in_order());
    const auto rejected = planes_of(got, BiasMap::Rejected, in_order());
    const auto p = planes_of(got, BiasMap::P, in_order());
    EXPECT_NEAR(map[0][0], 5, 1.5) << "six times as much light";
    EXPECT_GT(map[2][0], 0.99f);
    EXPECT_EQ(rejected[0][0], 3.0f);
    EXPECT_LT(p[0][0], -4.0f);
    const size_t far = 95 * 128 + 127; // the last pixel: nothing found, the last 32-block in Y
    const BiasScale& scale = got.scales[1];
    const BiasScale::Channel& y = scale.channel[0];
    const double base = std::max(y.level.back(), got.dark);
    EXPECT_EQ(map[0][far], float(y.mean.back() / base));
    EXPECT_EQ(map[1][far], float(scale.t_alpha * y.se.back() / base));
    EXPECT_EQ(map[2][far], float(1 - y.p.back()));
    EXPECT_EQ(rejected[0][far], 0.0f);
    double smallest = 1;
    for (const auto& channel : got.scales[2].channel)
        smallest = std::min(smallest, channel.p.back());
    EXPECT_EQ(p[2][far], float(std::log10(smallest)));
}

TEST(BiasMaps, UntestedAndStructure) {
    const BiasResult got = check_pair({160, 96, 1, clean()}, [] {
        RenderOptions dark = skewed(0.7);
        dark.fireflies = 0.002;
        return Render(160, 96, 2, dark);
    }());
    ASSERT_GT(got.untested, 0);
    const auto map = planes_of(got, BiasMap::Rejected, in_order());
    // Against the blocks, one pixel after the other.
    const auto block = [](const std::vector<int>& edges, int at) {
        return int(std::upper_bound(edges.begin(), edges.end(), at) - edges.begin()) - 1;
    };
    int untested = 0, structures = 0;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 160; ++x) {
            int means = 0, tested = 0, structure = 0;
            for (const BiasScale& scale : got.scales) {
                const auto at = size_t(block(scale.y, y) * scale.columns() + block(scale.x, x));
                bool any = false;
                for (const auto& channel : scale.channel)
                    any = any || channel.rejected[at];
                means += any;
                tested += scale.channel[0].tested[at];
                structure += scale.structure_rejected[at];
            }
            const size_t pixel = size_t(y) * 160 + size_t(x);
            ASSERT_EQ(map[0][pixel], float(means == 0 && tested == 0 ? -1 : means))
                << x << "," << y;
            ASSERT_EQ(map[1][pixel], float(structure));
            untested += map[0][pixel] < 0;
            structures += map[1][pixel] > 0;
        }
    EXPECT_GT(structures, 0);
    EXPECT_GE(untested, 0);
}

TEST(BiasMaps, OfPicturesThatAreNotJudged) {
    const Render a(128, 96, 1), small(32, 32, 1);
    const BiasResult same = check_pair(a, a), tiny = check_pair(small, small);
    for (const BiasMap map : {BiasMap::Signed, BiasMap::P, BiasMap::Rejected}) {
        const auto planes = planes_of(same, map, in_order());
        for (const auto& plane : planes)
            EXPECT_EQ(plane, std::vector<float>(128 * 96, 0.0f));
        EXPECT_EQ(planes_of(tiny, map, in_order())[0].size(), size_t(32 * 32));
    }
    EXPECT_EQ(planes_of(tiny, BiasMap::Rejected, in_order())[0][5], -1.0f);
    EXPECT_EQ(planes_of(tiny, BiasMap::Signed, in_order())[0][5], 0.0f);
}

TEST(BiasMaps, LogarithmsHaveAFloor) {
    RenderOptions lit = clean();
    lit.level = 0.5;
    const BiasResult got = check_pair({128, 96, 1, clean()}, {128, 96, 1, lit});
    EXPECT_EQ(planes_of(got, BiasMap::P, in_order())[0][0], -300.0f);
}

TEST(BiasMaps, BitsDoNotDependOnSchedules) {
    RenderOptions changed = skewed();
    changed.corner = 6;
    const BiasResult got = check_pair({128, 96, 1, skewed()}, {128, 96, 2, changed});
    for (const BiasMap map : {BiasMap::Signed, BiasMap::P, BiasMap::Rejected})
        EXPECT_EQ(planes_of(got, map, in_order()), planes_of(got, map, on_threads(3)));
}

} // namespace
} // namespace tonetool::metrics
