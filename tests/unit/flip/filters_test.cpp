// SPDX-License-Identifier: BSD-3-Clause
#include "flip/filters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace tonetool::flip {
namespace {

using Taps = std::vector<double>;

constexpr double kPpd = 67.0206451;

double two_sided(const Taps& taps) {
    return 2 * std::accumulate(taps.begin(), taps.end(), 0.0) - taps[0];
}

TEST(PixelsPerDegree, OfTheDefaultScreen) {
    EXPECT_FLOAT_EQ(float(pixels_per_degree(0.7, 0.7, 3840)), 67.0206451f);
    EXPECT_DOUBLE_EQ(pixels_per_degree(1.4, 0.7, 3840), 2 * pixels_per_degree(0.7, 0.7, 3840));
    EXPECT_DOUBLE_EQ(pixels_per_degree(0.7, 1.4, 3840), pixels_per_degree(0.7, 0.7, 1920));
}

// Dumped from the published program at 67.0206451 pixels per degree: centre, +1, +2, ...
const struct {
    const char* name;
    Taps kernels::FlipTaps<double>::*taps;
    Taps expected;
} kGoldens[] = {
    {"y",
     &kernels::FlipTaps<double>::y,
     {0.385760248, 0.241703719, 0.0594539903, 0.0057412996, 0.000217656459, 3.23939753e-06,
      1.89272882e-08, 4.34155871e-11}},
    {"cx",
     &kernels::FlipTaps<double>::cx,
     {0.363269061, 0.239982337, 0.069188185, 0.00870534778, 0.000478015922, 1.14551249e-05,
      1.19800717e-07, 5.46791279e-10}},
    {"cz1",
     &kernels::FlipTaps<double>::cz1,
     {0.115442052, 0.109271646, 0.0926697478, 0.0704134181, 0.0479357913, 0.0292382427,
      0.0159782656, 0.00782339182, 0.00343200169, 0.00134892145, 0.000475021166}},
    {"cz2",
     &kernels::FlipTaps<double>::cz2,
     {0.0816927925, 0.0748192519, 0.0574780628, 0.0370382145, 0.0200196803, 0.00907660462,
      0.00345182512, 0.00110111712, 0.000294630241, 6.61271843e-05, 1.24492281e-05}},
    {"g",
     &kernels::FlipTaps<double>::g,
     {0.145257458, 0.135950163, 0.111456037, 0.0800405517, 0.0503499582, 0.0277441088, 0.013391369,
      0.00566189503, 0.00209691701, 0.000680273108}},
    {"d1",
     &kernels::FlipTaps<double>::d1,
     {0, -0.125649005, -0.206021667, -0.22192727, -0.186139449, -0.128209472, -0.0742601007,
      -0.0366301909, -0.0155042429, -0.00565854972}},
    {"d2",
     &kernels::FlipTaps<double>::d2,
     {-0.298901498, -0.242699876, -0.107849345, 0.0320539996, 0.117550358, 0.133767888, 0.105268702,
      0.0648457557, 0.0327071138, 0.0138061726}}};

TEST(MakeTaps, AreThoseOfThePublishedProgram) {
    const auto taps = make_taps(kPpd);
    for (const auto& golden : kGoldens) {
        const Taps& ours = taps.*golden.taps;
        ASSERT_GE(ours.size(), golden.expected.size()) << golden.name;
        for (size_t i = 0; i < golden.expected.size(); ++i) {
            const double expected = golden.expected[i];
            // float32 of a sum of float32; exp(-x) adds x ulps to the far taps, 25 at most here.
            EXPECT_NEAR(ours[i], expected,
                        (std::abs(expected) > 1e-4 ? 1e-6 : 5e-6) * std::abs(expected))
                << golden.name << " tap " << i;
        }
    }
}

TEST(MakeTaps, HaveThePublishedRadii) {
    const struct {
        double ppd;
        size_t contrast, feature;
    } cases[] = {{30, 5, 4}, {67, 10, 9}, {100, 14, 13}, {134, 19, 17}, {200, 28, 25}};
    for (const auto& c : cases) {
        const auto taps = make_taps(c.ppd);
        for (const Taps* t : {&taps.y, &taps.cx, &taps.cz1, &taps.cz2})
            EXPECT_EQ(t->size(), c.contrast + 1) << c.ppd;
        for (const Taps* t : {&taps.g, &taps.d1, &taps.d2})
            EXPECT_EQ(t->size(), c.feature + 1) << c.ppd;
        EXPECT_EQ(filter_radius(lane_taps(taps)), int(std::max(c.contrast, c.feature)));
    }
}

constexpr double kPpds[] = {1, 2.5, 10, 20, 30, 67, 100, 134, 200, 1000};

TEST(MakeTaps, AreNormalized) {
    for (double ppd : kPpds) {
        SCOPED_TRACE(ppd);
        const auto taps = make_taps(ppd);
        // Sums of at most 300 doubles.
        EXPECT_NEAR(two_sided(taps.y), 1, 1e-13);
        EXPECT_NEAR(two_sided(taps.cx), 1, 1e-13);
        const double cz1 = two_sided(taps.cz1), cz2 = two_sided(taps.cz2);
        EXPECT_NEAR(cz1 * cz1 + cz2 * cz2, 1, 1e-13);
        EXPECT_NEAR(two_sided(taps.g), 1, 1e-13);
        EXPECT_NEAR(std::accumulate(taps.d1.begin(), taps.d1.end(), 0.0), -1, 1e-13);
        double positive = 0, negative = 0;
        for (size_t i = 0; i < taps.d2.size(); ++i)
            (taps.d2[i] > 0 ? positive : negative) += taps.d2[i] * (i == 0 ? 1 : 2);
        EXPECT_NEAR(positive, 1, 1e-13);
        EXPECT_NEAR(negative, -1, 1e-13);
    }
}

TEST(MakeTaps, AreFiniteWithinTheBounds) {
    for (double ppd : kPpds) {
        const auto taps = make_taps(ppd);
        for (const auto& golden : kGoldens)
            for (double t : taps.*golden.taps)
                EXPECT_TRUE(std::isfinite(t)) << golden.name << " at " << ppd;
    }
}

TEST(LaneTaps, TrimWhatFloatCannotSee) {
    const auto at_67 = lane_taps(make_taps(67));
    // The tails dropped at 67 pixels per degree: 8.7e-11 and 1.1e-9 from 7 on.
    EXPECT_EQ(at_67.y.size(), 7u);
    EXPECT_EQ(at_67.cx.size(), 7u);
    for (double ppd : kPpds) {
        SCOPED_TRACE(ppd);
        const auto full = make_taps(ppd);
        const auto trimmed = lane_taps(full);
        const auto tail = [](const Taps& taps, size_t from) {
            return 2 * std::accumulate(taps.begin() + ptrdiff_t(from), taps.end(), 0.0);
        };
        ASSERT_EQ(trimmed.y.size(), trimmed.cx.size());
        // The lanes begin with a product and add the centre to it.
        ASSERT_GE(trimmed.y.size(), 2u);
        EXPECT_LT(std::max(tail(full.y, trimmed.y.size()), tail(full.cx, trimmed.y.size())), 2e-9);
        if (trimmed.y.size() > 2) {
            const size_t shorter = trimmed.y.size() - 1;
            EXPECT_GE(std::max(tail(full.y, shorter), tail(full.cx, shorter)), 2e-9)
                << "could be shorter";
        }
    }
}

TEST(LaneTaps, KeepTheRest) {
    for (double ppd : kPpds) {
        SCOPED_TRACE(ppd);
        const auto exact = make_taps(ppd);
        const auto taps = lane_taps(exact);
        EXPECT_EQ(taps.cz1.size(), exact.cz1.size());
        EXPECT_GE(taps.cz1.size(), 2u);
        EXPECT_EQ(taps.cz2.size(), exact.cz2.size());
        EXPECT_GE(taps.g.size(), std::max(exact.g.size(), taps.y.size()));
        const std::pair<const std::vector<float>*, const Taps*> pairs[] = {{&taps.cz1, &exact.cz1},
                                                                           {&taps.cz2, &exact.cz2},
                                                                           {&taps.g, &exact.g},
                                                                           {&taps.y, &exact.y},
                                                                           {&taps.cx, &exact.cx}};
        for (const auto& [ours, all] : pairs)
            for (size_t i = 0; i < ours->size(); ++i) {
                const float tap = i < all->size() ? float((*all)[i]) : 0.0f;
                // A list is as long as its partner, and then ends in zeros.
                EXPECT_TRUE((*ours)[i] == tap || (*ours)[i] == 0.0f) << i;
                EXPECT_LT(std::abs(double((*ours)[i]) - double(tap)), 2e-9) << i;
            }
    }
}

// A filter whose taps sum to 0, applied to the steps between neighbours, is itself.
TEST(LaneTaps, DetectStepsAsTheDetectorsDetectValues) {
    for (double ppd : kPpds) {
        SCOPED_TRACE(ppd);
        const auto exact = make_taps(ppd);
        const auto taps = lane_taps(exact);
        const auto radius = ptrdiff_t(exact.d1.size()) - 1;
        const auto value = [](ptrdiff_t x) {
            return std::sin(0.7 * double(x) + 0.3) + 0.1 * double(x);
        };
        const auto step = [&value](ptrdiff_t x) { return value(x + 1) - value(x); };
        double odd = 0, even = 0, odd_steps = 0, even_steps = 0;
        for (ptrdiff_t i = -radius; i <= radius; ++i) {
            const auto k = size_t(std::abs(i));
            odd += (i < 0 ? -1 : 1) * exact.d1[k] * value(i);
            even += exact.d2[k] * value(i);
        }
        for (size_t i = 0; i < taps.d1.size(); ++i) {
            const auto k = ptrdiff_t(i);
            odd_steps += double(taps.d1[i]) * (step(k) + step(-1 - k));
            even_steps += double(taps.d2[i]) * (step(k) - step(-1 - k));
        }
        // Taps are floats; the largest values are those of the ramp at the radius.
        const double bound = 1e-6 * (2 + 0.1 * double(radius));
        EXPECT_NEAR(odd_steps, odd, bound);
        EXPECT_NEAR(even_steps, even, bound);
    }
}

} // namespace
} // namespace tonetool::flip
