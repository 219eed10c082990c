// SPDX-License-Identifier: BSD-3-Clause
// Laws of bias_check(). Its numbers are compared in bias_golden_test.cpp.
#include "metrics/bias.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bias_pictures.h"
#include "refusal.h"

namespace tonetool::metrics {
namespace {

using kernels::backwards;
using kernels::in_order;
using kernels::on_threads;

constexpr int kWidth = 128, kHeight = 96;

RenderOptions skewed(double gain = 1) {
    RenderOptions options;
    options.power = 4;
    options.gain = gain;
    return options;
}

RenderOptions clean() {
    RenderOptions options;
    options.noise = 0;
    return options;
}

Render render(uint64_t seed, const RenderOptions& options = skewed()) {
    return {kWidth, kHeight, seed, options};
}

// Every number that a result has.
std::vector<double> numbers(const BiasResult& r) {
    std::vector<double> out = {double(r.verdict),
                               double(r.reason),
                               double(r.nonfinite),
                               r.asymmetry,
                               double(r.unlike),
                               r.correlation,
                               r.dark,
                               r.bound,
                               r.absolute,
                               r.shown,
                               r.more.value_or(-1),
                               double(r.untested)};
    out.insert(out.end(), r.rare.begin(), r.rare.end());
    for (const BiasGain& g : r.gain)
        out.insert(out.end(), {g.gain, g.se, g.z, g.p, g.energy, g.energy_se, double(g.rejected)});
    for (const BiasScale& scale : r.scales) {
        for (const auto& c : scale.channel) {
            for (const auto* values : {&c.mean, &c.se, &c.t, &c.p, &c.level})
                out.insert(out.end(), values->begin(), values->end());
            out.insert(out.end(), c.rejected.begin(), c.rejected.end());
        }
        out.insert(out.end(), scale.structure_p.begin(), scale.structure_p.end());
    }
    return out;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double relative) {
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[i]) // infinities
            EXPECT_NEAR(a[i], b[i], relative * (1e-3 + std::abs(a[i]))) << i;
}

BiasResult check_sides(const std::vector<Render>& references, const std::vector<Render>& tests,
                       const BiasTest& options = {}) {
    return bias_check(side_of(references), side_of(tests), options, in_order());
}

TEST(BiasCheck, NoiseIsNotAPass) {
    const BiasResult got = check_pair(render(1), render(2));
    EXPECT_EQ(got.verdict, BiasVerdict::NotEnoughSamples);
    EXPECT_EQ(got.reason, BiasReason::Undecided);
    ASSERT_TRUE(got.more.has_value());
    EXPECT_GT(*got.more, 1);
}

TEST(BiasCheck, FindsAGainBehindNoise) {
    RenderOptions brighter;
    brighter.gain = 1.05;
    const BiasResult got = check_pair(render(1, RenderOptions()), render(2, brighter));
    EXPECT_EQ(got.verdict, BiasVerdict::Different);
    EXPECT_EQ(got.reason, BiasReason::Evidence);
    EXPECT_NEAR(got.gain[0].gain, 0.05, 3 * got.gain[0].se);
    EXPECT_FALSE(got.more.has_value());
}

// `more` comes true: the number of seeds that it asks for shows equality.
TEST(BiasCheck, AsManyMoreSamplesAsItSaysAreEnough) {
    const BiasResult one = check_pair(render(1), render(2));
    const int seeds = int(std::ceil(*one.more));
    ASSERT_LT(seeds, 20);
    std::vector<Render> references, tests;
    for (int i = 0; i < seeds; ++i) {
        references.push_back(render(uint64_t(100 + i)));
        tests.push_back(render(uint64_t(200 + i)));
    }
    EXPECT_EQ(check_sides(references, tests).verdict, BiasVerdict::Equal);
}

TEST(BiasCheck, IdenticalImagesAreEqual) {
    for (const Render& image : {render(1), render(1, clean()),
                                Render(kWidth, kHeight, 1).changed([](float) { return 0.0f; })}) {
        const BiasResult got = check_pair(image, image);
        EXPECT_EQ(got.verdict, BiasVerdict::Equal);
        EXPECT_EQ(got.reason, BiasReason::Identical);
        EXPECT_EQ(got.bound, 0.0);
        EXPECT_EQ(got.shown, 1.0);
        EXPECT_FALSE(got.judged);
    }
}

TEST(BiasCheck, OnePixelThatDiffersIsNotIdentical) {
    const Render reference = render(1);
    Render test = reference;
    test.at(2, 127, 95) += 1e-7f;
    EXPECT_EQ(check_pair(reference, test).reason, BiasReason::Rounding);
}

// 2^-10 of the value, and in the dark of 2 % of the mean.
TEST(BiasCheck, RoundingIsEqualUpToAUnitOfHalf) {
    const Render reference = render(1);
    const auto off_by = [&](float relative) {
        return check_pair(reference, reference.changed([=](float v) { return v + v * relative; }));
    };
    const BiasResult rounded = off_by(0.99f * 0x1p-10f);
    EXPECT_EQ(rounded.verdict, BiasVerdict::Equal);
    EXPECT_EQ(rounded.reason, BiasReason::Rounding);
    EXPECT_EQ(rounded.bound, 0x1p-10);
    EXPECT_NE(off_by(1.01f * 0x1p-10f).reason, BiasReason::Rounding);

    const BiasResult judged = off_by(0.01f);
    ASSERT_GT(judged.dark, 0);
    Render dark = reference;
    dark.at(0, 5, 5) = dark.at(1, 5, 5) = dark.at(2, 5, 5) = 0;
    Render allowed = dark, above = dark;
    allowed.at(2, 5, 5) = float(0.99 * 0x1p-10 * judged.dark);
    above.at(2, 5, 5) = float(1.02 * 0x1p-10 * judged.dark);
    EXPECT_EQ(check_pair(dark, allowed).reason, BiasReason::Rounding);
    EXPECT_NE(check_pair(dark, above).reason, BiasReason::Rounding);
}

// Half the files are stored as half: a float reference is not different from them for ever.
TEST(BiasCheck, RoundingOfConstantBlocksIsNoEvidence) {
    const Render reference = render(1).changed([](float) { return 0.5f; });
    Render test = reference.changed([](float v) { return v * (1 + 0.9f * 0x1p-11f); });
    // One pixel with a real difference, so that rounding alone does not end it.
    test.at(0, 0, 0) *= 1.5f;
    const BiasResult got = check_pair(reference, test);
    ASSERT_TRUE(got.judged);
    EXPECT_EQ(got.scales[0].rejected, 0);
    const BiasResult more =
        check_pair(reference, reference.changed([](float v) { return v * (1 + 1.1f * 0x1p-10f); }));
    ASSERT_TRUE(more.judged);
    EXPECT_EQ(more.scales[0].rejected, 48) << "p is 0, not NaN, where nothing varies";
}

TEST(BiasCheck, ConstantDifferenceWithoutNoiseIsCertain) {
    RenderOptions lit = clean();
    lit.level = 0.5;
    const BiasResult got = check_pair(render(1, clean()), render(1, lit));
    EXPECT_EQ(got.verdict, BiasVerdict::Different);
    for (const BiasScale& scale : got.scales)
        for (const double p : scale.channel[0].p)
            EXPECT_EQ(p, 0.0);
}

// The absolute rule: seeds that are the same show equality at once, and a change below the margin.
TEST(BiasCheck, SameSeedsShowEqualityAtOnce) {
    const BiasResult got = check_pair(render(1), render(1, skewed(1.02)));
    EXPECT_EQ(got.verdict, BiasVerdict::Equal);
    EXPECT_NEAR(got.absolute, 0.02, 1e-6);
    BiasTest strict;
    strict.within = 0.01;
    EXPECT_EQ(check_pair(render(1), render(1, skewed(1.02)), strict).verdict,
              BiasVerdict::Different);
}

TEST(BiasCheck, SwappedSidesNegateTheDifference) {
    RenderOptions brighter;
    brighter.gain = 1.05;
    const Render a = render(1, RenderOptions()), b = render(2, brighter);
    const BiasResult forth = check_pair(a, b), back = check_pair(b, a);
    EXPECT_EQ(forth.verdict, back.verdict);
    EXPECT_EQ(forth.asymmetry, -back.asymmetry);
    for (size_t c = 0; c < kBiasChannels; ++c) {
        EXPECT_LT(forth.gain[c].gain * back.gain[c].gain, 0);
        // Sums over the reference and over the test.
        EXPECT_NEAR(forth.gain[c].energy, -back.gain[c].energy / (1 + back.gain[c].energy), 1e-12);
    }
    const auto& m = forth.scales[0].channel[0].mean;
    for (size_t i = 0; i < m.size(); ++i)
        EXPECT_NEAR(m[i], -back.scales[0].channel[0].mean[i], 1e-15);
}

TEST(BiasCheck, PowersOfTwoChangeNothing) {
    const Render a = render(1, clean()), b = render(2);
    const BiasResult got = check_pair(a, b);
    for (const int stops : {-20, 7}) {
        const auto scaled = [stops](float v) { return std::ldexp(v, stops); };
        const BiasResult other = check_pair(a.changed(scaled), b.changed(scaled));
        EXPECT_EQ(other.bound, got.bound);
        EXPECT_EQ(other.more, got.more);
        EXPECT_EQ(other.correlation, got.correlation);
        for (size_t c = 0; c < kBiasChannels; ++c) {
            EXPECT_EQ(other.gain[c].z, got.gain[c].z);
            EXPECT_EQ(other.rare[c], got.rare[c]);
        }
        for (size_t s = 0; s < kBiasScales; ++s) {
            EXPECT_EQ(other.scales[s].channel[0].t, got.scales[s].channel[0].t);
            EXPECT_EQ(other.scales[s].structure_p, got.scales[s].structure_p);
        }
    }
}

// Light without noise is in both sides and not in d.
TEST(BiasCheck, EqualLightOnBothSidesKeepsTheTests) {
    RenderOptions lit = skewed(1.1);
    lit.level = 0.125;
    RenderOptions reference = lit;
    reference.gain = 1;
    const BiasResult plain = check_pair(render(1), render(2, skewed(1.1)));
    const BiasResult more = check_pair(render(1, reference), render(2, lit));
    const auto &a = plain.scales[1].channel[0], &b = more.scales[1].channel[0];
    for (size_t i = 0; i < a.t.size(); ++i) {
        // Both without what rounding explains of their level; float pixels of another level.
        const double rounding = 0x1p-11 * b.level[i] / b.se[i];
        EXPECT_NEAR(a.t[i], b.t[i], rounding + 1e-4) << i;
        EXPECT_NEAR(a.mean[i], b.mean[i], 1e-7);
    }
}

TEST(BiasCheck, OrderOfSeedsMattersToStructureOnly) {
    const std::vector<Render> seeds = {render(1), render(2), render(3)};
    const std::vector<Render> other = {render(3), render(1), render(2)};
    const std::vector<Render> tests = {render(4), render(5, skewed(1.1))};
    BiasResult a = check_sides(seeds, tests), b = check_sides(other, tests);
    EXPECT_NE(a.scales[0].structure_p, b.scales[0].structure_p);
    for (size_t s = 0; s < kBiasScales; ++s)
        a.scales[s].structure_p = b.scales[s].structure_p = {};
    expect_near(numbers(a), numbers(b), 1e-9);
}

TEST(BiasCheck, SidesOfOneSeedAreTheSameEitherWay) {
    const Render a = render(1), b = render(2);
    EXPECT_EQ(numbers(check_pair(a, b)), numbers(check_sides({a}, {b})));
}

// Structure is found by products of independent halves, which see an edge that means do not.
TEST(BiasCheck, SeedsFindAnEdgeThatMoved) {
    RenderOptions moved;
    moved.shift = 1;
    const std::vector<Render> a = {render(1, RenderOptions()), render(2, RenderOptions())};
    const std::vector<Render> b = {render(3, moved), render(4, moved)};
    const BiasResult got = check_sides(a, b);
    EXPECT_GT(got.scales[2].structures, 0);
    EXPECT_EQ(got.scales[2].rejected, 0);
    EXPECT_EQ(got.verdict, BiasVerdict::Different);
}

TEST(BiasCheck, TransposedImagesHaveTheSameMeans) {
    const auto transposed = [](const Render& from) {
        Render out(kHeight, kWidth, 0);
        for (int c = 0; c < 3; ++c)
            for (int y = 0; y < kHeight; ++y)
                for (int x = 0; x < kWidth; ++x)
                    out.at(c, y, x) = from.plane[c][size_t(y * kWidth + x)];
        return out;
    };
    const Render a = render(1), b = render(2, skewed(1.1));
    const BiasResult got = check_pair(a, b), other = check_pair(transposed(a), transposed(b));
    for (size_t c = 0; c < kBiasChannels; ++c) {
        EXPECT_NEAR(got.gain[c].z, other.gain[c].z, 1e-9);
        EXPECT_NEAR(got.gain[c].energy_se, other.gain[c].energy_se, 1e-12);
    }
    EXPECT_NEAR(got.correlation, other.correlation, 1e-9);
    EXPECT_NEAR(got.bound, other.bound, 1e-9);
    for (size_t s = 0; s < kBiasScales; ++s) {
        const BiasScale &f = got.scales[s], &t = other.scales[s];
        for (int y = 0; y < f.rows(); ++y)
            for (int x = 0; x < f.columns(); ++x)
                EXPECT_NEAR(f.channel[1].t[size_t(y * f.columns() + x)],
                            t.channel[1].t[size_t(x * t.columns() + y)], 1e-9);
    }
}

TEST(BiasCheck, BitsDoNotDependOnSchedules) {
    RenderOptions fireflies = skewed();
    fireflies.fireflies = 0.002;
    const Render a = render(1, clean()), b = render(2, fireflies); // unlike noise: every pass
    const BiasSide many_a = side_of({render(1), render(3)}), many_b = side_of({b, render(4)});
    const auto run = [&](const kernels::ParallelFor& parallel) {
        std::vector<double> out =
            numbers(bias_check(BiasSide(a.view()), BiasSide(b.view()), {}, parallel));
        const auto seeds = numbers(bias_check(many_a, many_b, {}, parallel));
        out.insert(out.end(), seeds.begin(), seeds.end());
        return out;
    };
    const std::vector<double> expected = run(in_order());
    EXPECT_EQ(run(backwards()), expected);
    for (const int threads : {1, 2, 3, 7})
        EXPECT_EQ(run(on_threads(threads)), expected) << threads;
}

TEST(BiasCheck, RowStridesDoNotMatter) {
    const Render a = render(1), b = render(2);
    constexpr int stride = kWidth + 13;
    std::vector<float> padded[3];
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kHeight; ++y) {
            const auto* row = b.plane[c].data() + y * kWidth;
            padded[c].insert(padded[c].end(), row, row + kWidth);
            padded[c].insert(padded[c].end(), 13, std::nanf(""));
        }
    const kernels::ConstRgb view = {
        {padded[0].data(), padded[1].data(), padded[2].data()}, stride, kWidth, kHeight, 0};
    const BiasResult expected = check_pair(a, b);
    EXPECT_EQ(numbers(bias_check(BiasSide(a.view()), BiasSide(view), {}, in_order())),
              numbers(expected));
    BiasSide side(kWidth, kHeight);
    side.add(view, in_order());
    EXPECT_EQ(numbers(bias_check(BiasSide(a.view()), side, {}, in_order())), numbers(expected));
}

TEST(BiasCheck, RefusesWhatCannotBeCompared) {
    const Render a = render(1), small(64, 64, 1);
    EXPECT_EQ(refusal([&] { check_pair(a, small); }),
              "the sides have different sizes: 128x96, 64x64");
    EXPECT_EQ(refusal([&] {
                  side_of({a, small});
              }),
              "the seeds of a side have different sizes: 128x96, 64x64");
    EXPECT_EQ(
        refusal([&] { bias_check(BiasSide(a.view()), BiasSide(kWidth, kHeight), {}, in_order()); }),
        "a side has no image");
    EXPECT_NE(refusal([&] { BiasSide(a.view()).add(a.view(), in_order()); }), "");
}

TEST(BiasCheck, RefusesOptionsOutOfRange) {
    const Render a = render(1);
    const auto with = [&](double within, double alpha, double power) {
        BiasTest options;
        options.within = within;
        options.alpha = alpha;
        options.power = power;
        return refusal([&] { check_pair(a, a, options); });
    };
    EXPECT_EQ(with(0.05, 0.01, 0.9), "");
    const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
    for (const double within : {0.0, -1.0, nan, inf})
        EXPECT_NE(with(within, 0.01, 0.9).find("within"), std::string::npos);
    for (const double alpha : {0.0, 0.5, nan})
        EXPECT_NE(with(0.05, alpha, 0.9).find("alpha"), std::string::npos);
    for (const double power : {0.4, 1.0, nan})
        EXPECT_NE(with(0.05, 0.01, power).find("power"), std::string::npos);
}

} // namespace
} // namespace tonetool::metrics
