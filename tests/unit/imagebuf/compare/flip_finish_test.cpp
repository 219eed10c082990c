// SPDX-License-Identifier: BSD-3-Clause
// What is not colour: NaN, Inf, negative values, alpha.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "images.h"
#include "tonetool/flip.h"

namespace tonetool {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using ToneAlgo::hdr_flip;
using ToneAlgo::ldr_flip;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr int kReach = 10; // of the widest filter at 67 pixels per degree

struct Outcome {
    ImageBuf map;
    FlipResult result;
};

// Explicit exposures, so that a changed reference does not change them.
HdrFlipOptions fixed_exposures() {
    HdrFlipOptions options;
    options.start_exposure = -2;
    options.stop_exposure = 2;
    options.want_exposure_map = options.want_exposures = true;
    return options;
}

Outcome run(const ImageBuf& reference, const ImageBuf& test,
            const HdrFlipOptions& options = fixed_exposures()) {
    Outcome out;
    EXPECT_TRUE(hdr_flip(out.map, reference, test, options, &out.result)) << out.map.geterror();
    return out;
}

float at(const ImageBuf& map, int x, int y) {
    return map.getchannel(x, y, 0, 0);
}

class NonFinite : public testing::TestWithParam<float> {
protected:
    const ImageBuf m_reference = noise(50, 40, 1);
    const ImageBuf m_test = disturbed(m_reference, 0.3, 2);
    const std::vector<float> m_bad = {1, GetParam(), 1};

    // The map apart from one pixel.
    static void expect_same_elsewhere(const ImageBuf& a, const ImageBuf& b, int x, int y) {
        for (int j = a.ybegin(); j < a.yend(); ++j)
            for (int i = a.xbegin(); i < a.xend(); ++i)
                if (i != x || j != y)
                    ASSERT_EQ(at(a, i, j), at(b, i, j)) << i << "," << j;
    }
};

TEST_P(NonFinite, InOneImageIsAnErrorOf1) {
    const auto bad_test = with_pixel(m_test, 20, 15, m_bad);
    const auto bad_reference = with_pixel(m_reference, 20, 15, m_bad);
    const struct {
        const ImageBuf &reference, &test;
        int in_reference, in_test;
    } cases[] = {{m_reference, bad_test, 0, 1}, {bad_reference, m_test, 1, 0}};
    for (const auto& c : cases) {
        const Outcome r = run(c.reference, c.test);
        EXPECT_EQ(at(r.map, 20, 15), 1.0f);
        EXPECT_EQ(at(r.result.exposure_index, 20, 15), 0.0f);
        for (const auto& exposure : r.result.exposures)
            EXPECT_EQ(at(exposure.flip, 20, 15), 1.0f);
        EXPECT_EQ(r.result.summary.reference.nonfinite, c.in_reference);
        EXPECT_EQ(r.result.summary.test.nonfinite, c.in_test);
        EXPECT_EQ(r.result.summary.nonfinite_both, 0);
        EXPECT_EQ(r.result.summary.pool.max, 1.0);
        EXPECT_THAT(r.result.summary.warnings, Contains(HasSubstr("1 pixel(s) of the")));
        EXPECT_EQ(at(ldr_flip(c.reference, c.test), 20, 15), 1.0f);
    }
}

TEST_P(NonFinite, NeighboursSeeTheOtherImagesPixel) {
    const auto mended_test = with_pixel(m_test, 20, 15, pixel_of(m_reference, 20, 15));
    expect_same_elsewhere(run(m_reference, with_pixel(m_test, 20, 15, m_bad)).map,
                          run(m_reference, mended_test).map, 20, 15);
    const auto mended_reference = with_pixel(m_reference, 20, 15, pixel_of(m_test, 20, 15));
    expect_same_elsewhere(run(with_pixel(m_reference, 20, 15, m_bad), m_test).map,
                          run(mended_reference, m_test).map, 20, 15);
}

TEST_P(NonFinite, FarPixelsDoNotNotice) {
    const Outcome plain = run(m_reference, m_test);
    for (const Outcome& r : {run(m_reference, with_pixel(m_test, 20, 15, m_bad)),
                             run(with_pixel(m_reference, 20, 15, m_bad), m_test)})
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 50; ++x)
                if (std::max(std::abs(x - 20), std::abs(y - 15)) > kReach)
                    ASSERT_EQ(at(r.map, x, y), at(plain.map, x, y)) << x << "," << y;
}

TEST_P(NonFinite, InBothImagesIsEqual) {
    const auto reference = with_pixel(m_reference, 20, 15, m_bad);
    const auto test = with_pixel(m_test, 20, 15, m_bad);
    const Outcome r = run(reference, test);
    EXPECT_EQ(at(r.map, 20, 15), 0.0f);
    EXPECT_EQ(r.result.summary.nonfinite_both, 1);
    EXPECT_THAT(r.result.summary.warnings,
                Contains(HasSubstr("1 pixel(s) are NaN or Inf in both")));
    const std::vector<float> black = {0, 0, 0};
    expect_same_elsewhere(
        r.map, run(with_pixel(m_reference, 20, 15, black), with_pixel(m_test, 20, 15, black)).map,
        20, 15);
    EXPECT_EQ(run(reference, reference).result.summary.pool.max, 0.0);
}

TEST_P(NonFinite, InBothImagesOfAnotherKindIsAnErrorOf1) {
    const auto reference = with_pixel(m_reference, 20, 15, m_bad);
    for (std::vector<float> other :
         {std::vector<float>{kNan, kInf, 0.25f}, {-kInf, -kInf, -kInf}}) {
        const Outcome r = run(reference, with_pixel(m_test, 20, 15, other));
        EXPECT_EQ(at(r.map, 20, 15), 1.0f);
        for (const auto& exposure : r.result.exposures)
            EXPECT_EQ(at(exposure.flip, 20, 15), 1.0f);
        EXPECT_EQ(r.result.summary.nonfinite_both, 0);
        EXPECT_EQ(r.result.summary.nonfinite_unlike, 1);
        EXPECT_THAT(r.result.summary.warnings, Contains(HasSubstr("count as different")));
    }
}

std::vector<std::string> warnings_of(const ImageBuf& reference, const ImageBuf& test,
                                     double start = -2, double stop = 2) {
    HdrFlipOptions options;
    options.start_exposure = start;
    options.stop_exposure = stop;
    return run(reference, test, options).result.summary.warnings;
}

TEST(Clipped, DifferencesThatNoExposureShowsAreSaid) {
    const auto plain = noise(40, 30, 1);
    auto light = plain, lighter = plain, dark = plain, darker = plain;
    for (int x = 0; x < 8; ++x) {
        light = with_pixel(light, x, 3, {5000, 5000, 5000});
        lighter = with_pixel(lighter, x, 3, {20000, 20000, 20000});
        dark = with_pixel(dark, x, 3, {0, 0, 0});
        darker = with_pixel(darker, x, 3, {1e-7f, 2e-7f, 0});
    }
    EXPECT_THAT(warnings_of(light, lighter), Contains(HasSubstr("8 of 8 differing pixel(s) are "
                                                                "white")));
    EXPECT_THAT(warnings_of(dark, darker), Contains(HasSubstr("are black in both images")));
    EXPECT_THAT(warnings_of(light, lighter, -20, 0), Not(Contains(HasSubstr("are white"))));
    EXPECT_THAT(warnings_of(light, with_pixel(light, 0, 3, {5000, 1, 5000})),
                Not(Contains(HasSubstr("are white"))));
    FlipResult ldr;
    ldr_flip(light, lighter, {}, &ldr);
    EXPECT_THAT(ldr.summary.warnings, Contains(HasSubstr("are white")));
    const auto few = disturbed(light, 0.2, 3); // 8 of more than 1000 pixels: below 1 %
    EXPECT_THAT(warnings_of(light, few), Not(Contains(HasSubstr("are white"))));
}

TEST(IgnoredAlpha, IsCounted) {
    const auto with_alpha = [](int holes) {
        auto image = constant(make_spec(20, 10, {"R", "G", "B", "A"}), {0.5f, 0.5f, 0.5f, 1});
        for (int x = 0; x < holes; ++x)
            image = with_pixel(image, x, 2, {0.5f, 0.5f, 0.5f, 0});
        return image;
    };
    const auto opaque = constant(20, 10, {0.5f, 0.5f, 0.5f});
    const struct {
        ImageBuf reference, test;
        int differing;
    } cases[] = {{with_alpha(0), with_alpha(7), 7},
                 {with_alpha(7), with_alpha(7), 0},
                 {opaque, with_alpha(3), 3},
                 {with_alpha(3), opaque, 3},
                 {opaque, with_alpha(0), 0}};
    for (const auto& c : cases) {
        const FlipSummary s = run(c.reference, c.test).result.summary;
        EXPECT_EQ(s.alpha_ignored, c.differing);
        EXPECT_EQ(s.pool.max, 0);
        EXPECT_EQ(s.warnings.empty(), c.differing == 0);
    }
    HdrFlipOptions compared = fixed_exposures();
    compared.alpha = AlphaPolicy::Error;
    EXPECT_EQ(run(with_alpha(0), with_alpha(7), compared).result.summary.alpha_ignored, 0);
}

TEST_P(NonFinite, DoesNotReachTheExposures) {
    FlipResult bad, without;
    hdr_flip(with_pixel(m_reference, 49, 39, m_bad), m_test, {}, &bad);
    const auto& exposures = bad.summary.exposures;
    hdr_flip(with_pixel(m_reference, 49, 39, {1e-9f, 1e-9f, 1e-9f}), m_test, {}, &without);
    ASSERT_FALSE(exposures.empty());
    for (double stops : exposures)
        EXPECT_TRUE(std::isfinite(stops));
    EXPECT_EQ(exposures.front(), without.summary.exposures.front());
}

INSTANTIATE_TEST_SUITE_P(Values, NonFinite, testing::Values(kNan, kInf, -kInf),
                         [](const auto& test) {
                             return std::isnan(test.param) ? "NaN"
                                    : test.param > 0       ? "Inf"
                                                           : "MinusInf";
                         });

TEST(Negative, IsCountedAndSetTo0) {
    const auto reference = noise(30, 20, 3), test = disturbed(reference, 0.3, 4);
    const auto negative = with_pixel(with_pixel(test, 3, 4, {-1, 0.5f, -2}), 9, 9, {1, 1, -1e-9f});
    const auto clamped = with_pixel(with_pixel(test, 3, 4, {0, 0.5f, 0}), 9, 9, {1, 1, 0});
    const Outcome a = run(reference, negative), b = run(reference, clamped);
    EXPECT_EQ(values(a.map), values(b.map));
    EXPECT_EQ(a.result.summary.test.negative, 2);
    EXPECT_EQ(b.result.summary.test.negative, 0);
    EXPECT_EQ(a.result.summary.reference.negative, 0);
}

TEST(Huge, IsWhiteNotBlack) {
    const auto black = constant(9, 9, {0, 0, 0});
    const float most = std::numeric_limits<float>::max();
    for (float v : {1e30f, most}) {
        const Outcome huge = run(black, constant(9, 9, {v, v, v}));
        EXPECT_EQ(values(huge.map), values(run(black, constant(9, 9, {1e9f, 1e9f, 1e9f})).map));
        EXPECT_NEAR(huge.result.summary.pool.min, 0.9673883, 1e-5); // published: black and white
    }
}

TEST(Huge, AReferencePixelMovesTheStartExposure) {
    const auto reference = noise(9, 9, 5);
    FlipResult result;
    const auto map =
        hdr_flip(with_pixel(reference, 4, 4, {1e30f, 1e30f, 1e30f}), reference, {}, &result);
    ASSERT_FALSE(map.has_error()) << map.geterror();
    // log2 of the ACES bright point over the luminance, which is a float
    EXPECT_NEAR(result.summary.exposures.front(), 1.08329725 - std::log2(1e30), 1e-6);
}

// 2^-127 is no normal float: such a reference needs its exposures given, and the error says so.
TEST(Huge, ExposuresBeyondFloatAreRefusedNotRounded) {
    const float most = std::numeric_limits<float>::max();
    const auto reference = with_pixel(noise(9, 9, 5), 4, 4, {most, most, most});
    EXPECT_THAT(hdr_flip(reference, reference).geterror(), HasSubstr("start exposure is -126.917"));
    EXPECT_EQ(run(reference, reference).result.summary.pool.max, 0.0);
}

ImageBuf with_alpha(float alpha) {
    return constant(make_spec(12, 8, {"R", "G", "B", "A"}), {0.2f, 0.3f, 0.4f, alpha});
}

HdrFlipOptions alpha_is_compared() {
    HdrFlipOptions options = fixed_exposures();
    options.alpha = AlphaPolicy::Error;
    return options;
}

TEST(Alpha, IsIgnoredUnlessAskedFor) {
    const Outcome r = run(with_alpha(1), with_alpha(0.25f));
    EXPECT_EQ(r.result.summary.pool.max, 0.0);
    EXPECT_FALSE(r.result.summary.alpha_compared);
}

TEST(Alpha, ADifferenceInAlphaAloneIsSeen) {
    const auto test = with_pixel(with_alpha(0.75f), 5, 6, {0.2f, 0.3f, 0.4f, 0.5f});
    const Outcome r = run(with_alpha(1), test, alpha_is_compared());
    EXPECT_EQ(at(r.map, 0, 0), 0.25f);
    EXPECT_EQ(at(r.map, 5, 6), 0.5f);
    const FlipSummary& s = r.result.summary;
    EXPECT_TRUE(s.alpha_compared);
    EXPECT_EQ(s.alpha_max, 0.5);
    EXPECT_EQ(s.alpha_max_x, 5);
    EXPECT_EQ(s.alpha_max_y, 6);
    EXPECT_NEAR(s.alpha_mean, (95 * 0.25 + 0.5) / 96, 1e-15); // a sum of exact doubles
    EXPECT_EQ(s.pool.max, 0.5);
}

TEST(Alpha, TheLargerOfTheTwoWins) {
    const auto reference = with_alpha(1);
    const auto test = disturbed(reference, 1.0, 7);
    const Outcome color = run(reference, test), both = run(reference, test, alpha_is_compared());
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 12; ++x) {
            const float alpha = std::abs(pixel_of(test, x, y)[3] - 1.0f);
            EXPECT_EQ(at(both.map, x, y), std::max(at(color.map, x, y), alpha));
        }
}

TEST(Alpha, OneImageWithoutItIsOpaque) {
    const auto opaque = constant(12, 8, {0.2f, 0.3f, 0.4f});
    for (const bool in_test : {true, false}) {
        const Outcome r = in_test ? run(opaque, with_alpha(0.75f), alpha_is_compared())
                                  : run(with_alpha(0.75f), opaque, alpha_is_compared());
        EXPECT_EQ(at(r.map, 3, 3), 0.25f);
        EXPECT_THAT(r.result.summary.warnings, Contains(HasSubstr("only one image has alpha")));
    }
}

TEST(Alpha, NonFiniteAlphaCountsWhenCompared) {
    const auto bad = with_pixel(with_alpha(1), 2, 2, {0.2f, 0.3f, 0.4f, kNan});
    EXPECT_EQ(at(run(with_alpha(1), bad, alpha_is_compared()).map, 2, 2), 1.0f);
    EXPECT_EQ(run(with_alpha(1), bad).result.summary.pool.max, 0.0);
}

TEST(Warnings, AreEmptyWhereAllIsWell) {
    const auto reference = noise(10, 10, 8);
    EXPECT_THAT(run(reference, disturbed(reference, 0.1, 9)).result.summary.warnings, IsEmpty());
}

TEST(Warnings, CountsAreOfTheImagesNotOfTheRegion) {
    const auto reference = noise(30, 30, 10);
    const auto test = with_pixel(reference, 29, 29, {kNan, 0, 0});
    FlipResult result;
    hdr_flip(reference, test, {}, &result, ROI(0, 5, 0, 5));
    EXPECT_EQ(result.summary.test.nonfinite, 1);
    EXPECT_EQ(result.summary.pool.max, 0.0);
}

} // namespace
} // namespace tonetool
