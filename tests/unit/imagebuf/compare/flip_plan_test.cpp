// SPDX-License-Identifier: BSD-3-Clause
// Options of LDR-FLIP and HDR-FLIP: what they do and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "images.h"
#include "tonetool/flip.h"
#include "tonetool/luminance.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using ToneAlgo::hdr_flip;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

struct Outcome {
    ImageBuf map;
    FlipResult result;
};

Outcome run(const ImageBuf& reference, const ImageBuf& test, const HdrFlipOptions& options = {}) {
    Outcome out;
    EXPECT_TRUE(hdr_flip(out.map, reference, test, options, &out.result)) << out.map.geterror();
    return out;
}

template <class F>
HdrFlipOptions options(const F& set) {
    HdrFlipOptions out;
    set(out);
    return out;
}

using O = HdrFlipOptions;

TEST(FlipOptions, AreRefusedWithTheirValue) {
    const struct {
        HdrFlipOptions options;
        std::vector<const char*> words;
    } cases[] = {
        {options([](O& o) { o.ppd = 0.5; }), {"ppd is 0.5", "1 to 1000"}},
        {options([](O& o) { o.ppd = 1001; }), {"ppd is 1001"}},
        {options([](O& o) { o.ppd = kNan; }), {"ppd is nan"}},
        {options([](O& o) { o.distance = 0; }), {"distance is 0", "metres"}},
        {options([](O& o) { o.distance = kInf; }), {"distance is inf"}},
        {options([](O& o) { o.width = -1; }), {"width is -1"}},
        {options([](O& o) { o.pixels_across = 0; }), {"pixels is 0"}},
        {options([](O& o) { o.distance = 1e3; }), {"ppd is 95743.7", "1 to 1000"}},
        {options([](O& o) { o.curve.name = "axg"; }), {"\"axg\"", "agx", "uncharted2"}},
        {options([](O& o) { o.curve.name = "ACES"; }), {"\"ACES\""}},
        {options([](O& o) {
             o.curve.coeffs = {1, 2, 3};
         }),
         {"coeffs are 1,2,3", "6 coefficients"}},
        {options([](O& o) { o.curve.coeffs = {1, 2, 3, 4, 5, 6, 7}; }), {"1,2,3,4,5,6,7", "not 7"}},
        {options([](O& o) { o.curve.coeffs = {0, 1, 0, 0, 1, kNan}; }),
         {"coeffs", "nan", "finite"}},
        {options([](O& o) { o.curve.coeffs = {0, 1, 0, 0, 0, 0}; }),
         {"coeffs are 0,1,0,0,0,0", "denominator is 0"}},
        {options([](O& o) { o.num_exposures = 0; }), {"numExposures is 0", "1 to 1024"}},
        {options([](O& o) { o.num_exposures = 1025; }), {"numExposures is 1025"}},
        {options([](O& o) { o.start_exposure = -127; }), {"startExposure is -127", "-126"}},
        {options([](O& o) { o.stop_exposure = 128; }), {"stopExposure is 128", "127"}},
        {options([](O& o) { o.start_exposure = kNan; }), {"startExposure is nan"}},
        {options([](O& o) { o.stop_exposure = kInf; }), {"stopExposure is inf"}},
        {options([](O& o) { o.max_luminance = 0; }), {"maxluminance is 0", "positive"}},
        {options([](O& o) { o.median_luminance = -2; }), {"medianluminance is -2"}},
        {options([](O& o) { o.median_luminance = kNan; }), {"medianluminance is nan"}},
        {options([](O& o) { o.start_exposure = 2, o.stop_exposure = 1; }),
         {"start exposure 2", "stop exposure 1"}},
        {options([](O& o) { o.pixels.layer = "nope"; }), {"\"nope\"", "R,G,B"}},
        {options([](O& o) { o.pixels.from = "nope"; }), {"\"nope\"", "rec709"}},
        {options([](O& o) { o.alpha = AlphaPolicy::Error; }), {"alpha=error", "neither"}}};
    const auto image = noise(5, 5, 1);
    for (const auto& c : cases) {
        ImageBuf dst;
        EXPECT_FALSE(hdr_flip(dst, image, image, c.options)) << c.words[0];
        const std::string error = dst.geterror();
        for (const char* word : c.words)
            EXPECT_THAT(error, HasSubstr(word));
    }
}

TEST(FlipOptions, PpdFollowsTheScreen) {
    const auto image = noise(5, 5, 1);
    // float(0.7 * 3840 / 0.7 * pi / 180), to its last digit
    EXPECT_NEAR(run(image, image).result.summary.ppd, 67.0206451, 4e-6);
    const auto far = options([](O& o) { o.distance = 1.4, o.pixels_across = 1920; });
    EXPECT_NEAR(run(image, image, far).result.summary.ppd, 67.0206451, 4e-6);
    const auto given = options([](O& o) { o.ppd = 30, o.distance = -1; });
    EXPECT_EQ(run(image, image, given).result.summary.ppd, 30);
}

TEST(Exposures, FollowTheReferencesLuminance) {
    const auto reference = noise(21, 13, 2);
    LuminanceStats stats;
    std::string error;
    ASSERT_TRUE(ToneAlgo::luminance_stats(stats, reference, error)) << error;
    const FlipSummary s = run(reference, disturbed(reference, 0.1, 1)).result.summary;
    EXPECT_EQ(s.max_luminance, stats.max);
    EXPECT_EQ(s.median_luminance, stats.median);
    // log2 of the ACES bright point; published in float32
    EXPECT_NEAR(s.exposures.front(), 1.08329725 - std::log2(stats.max), 1e-6);
    EXPECT_NEAR(s.exposures.back(), 1.08329725 - std::log2(stats.median), 1e-6);
    EXPECT_EQ(s.exposures.size(), size_t(std::ceil(std::log2(stats.max / stats.median))));
    EXPECT_EQ(s.tonemapper, "aces");
    EXPECT_FALSE(s.median_of_lit);
}

TEST(Exposures, MayBeGiven) {
    const auto image = noise(5, 5, 1);
    const auto stops = [&](const HdrFlipOptions& o) {
        return run(image, image, o).result.summary.exposures;
    };
    EXPECT_THAT(stops(options(
                    [](O& o) { o.start_exposure = -1, o.stop_exposure = 3, o.num_exposures = 3; })),
                ElementsAre(-1, 1, 3));
    EXPECT_THAT(stops(options([](O& o) { o.start_exposure = 0.5, o.num_exposures = 1; })),
                ElementsAre(0.5));
    EXPECT_THAT(stops(options([](O& o) { o.start_exposure = o.stop_exposure = 2; })),
                ElementsAre(2, 2));
}

TEST(Exposures, LuminancesMayBeGiven) {
    const auto reference = noise(9, 9, 3), test = disturbed(reference, 0.3, 4);
    const Outcome measured = run(reference, test);
    const FlipSummary& s = measured.result.summary;
    const auto given = options(
        [&](O& o) { o.max_luminance = s.max_luminance, o.median_luminance = s.median_luminance; });
    const Outcome same = run(reference, test, given);
    EXPECT_EQ(same.result.summary.exposures, s.exposures);
    EXPECT_EQ(values(same.map), values(measured.map));
    const auto wide =
        run(reference, test, options([](O& o) { o.max_luminance = 2, o.median_luminance = 0.18; }));
    // OpenImageIO's published figures for these defaults: 0.083 to 3.557, N = 4
    EXPECT_NEAR(wide.result.summary.exposures.front(), 0.083, 5e-4);
    EXPECT_NEAR(wide.result.summary.exposures.back(), 3.557, 5e-4);
    EXPECT_EQ(wide.result.summary.exposures.size(), 4u);
}

TEST(Exposures, ABlackReferenceNeedsThem) {
    const auto black = constant(6, 6, {0, 0, 0}), grey = constant(6, 6, {0.2f, 0.2f, 0.2f});
    ImageBuf dst;
    EXPECT_FALSE(hdr_flip(dst, black, grey));
    EXPECT_THAT(dst.geterror(), HasSubstr("the reference is black"));
    const auto given = options([](O& o) { o.start_exposure = 0, o.stop_exposure = 1; });
    EXPECT_GT(run(black, grey, given).result.summary.pool.min, 0.1);
    const auto lit = options([](O& o) { o.max_luminance = 1, o.median_luminance = 0.5; });
    EXPECT_GT(run(black, grey, lit).result.summary.pool.min, 0.1);
}

TEST(Exposures, AMostlyBlackReferenceUsesItsLitPixels) {
    auto reference = constant(5, 1, {0, 0, 0});
    reference = with_pixel(reference, 3, 0, {0.5f, 0.5f, 0.5f});
    reference = with_pixel(reference, 4, 0, {8, 8, 8});
    const Outcome r = run(reference, scaled(reference, 0.5));
    EXPECT_TRUE(r.result.summary.median_of_lit);
    EXPECT_NEAR(r.result.summary.median_luminance, 8.0, 8 * 4e-7); // float luminance
    EXPECT_THAT(r.result.summary.warnings,
                testing::Contains(HasSubstr("more than half of the reference is black")));
}

TEST(Coeffs, OfANamedCurveAreThatCurve) {
    const auto reference = noise(40, 30, 5), test = disturbed(reference, 0.5, 6);
    for (const char* name : {"aces", "hable"}) {
        HdrFlipOptions named;
        named.curve.name = name;
        const Outcome a = run(reference, test, named);
        for (double factor : {1.0, 1e-6, 1e9}) { // a quotient does not change
            HdrFlipOptions own;
            own.curve.name = "ignored";
            for (double k : a.result.summary.coeffs)
                own.curve.coeffs.push_back(k * factor);
            const Outcome b = run(reference, test, own);
            EXPECT_EQ(b.result.summary.tonemapper, "coeffs");
            // The coefficients as floats, rescaled: roundings of 6e-8 in the curve.
            EXPECT_LE(largest_difference(a.map, b.map), factor == 1.0 ? 1e-6 : 1e-5)
                << name << " times " << factor;
            ASSERT_EQ(a.result.summary.exposures.size(), b.result.summary.exposures.size());
            EXPECT_NEAR(a.result.summary.exposures[0], b.result.summary.exposures[0], 1e-12);
        }
    }
}

TEST(Coeffs, AreRefusedWhereTheCurveBreaks) {
    const auto image = constant(4, 4, {1, 1, 1});
    const struct {
        std::vector<double> coeffs;
        double stop;
        std::vector<const char*> words;
    } cases[] = {{{0, 1, 0, 0, -1, 2}, 2, {"0,1,0,0,-1,2", "pole at x = 2", "0 to 4"}},
                 {{-1, 4, 0, 0, 0, 1}, 2, {"does not increase above x = 2", "0 to 4"}},
                 {{0, -1, 1, 0, 0, 1}, 0, {"does not increase above x = 0"}}};
    for (const auto& c : cases) {
        const auto o = options([&](O& out) {
            out.curve.coeffs = c.coeffs, out.start_exposure = -1, out.stop_exposure = c.stop;
        });
        ImageBuf dst;
        EXPECT_FALSE(hdr_flip(dst, image, image, o));
        const std::string error = dst.geterror();
        for (const char* word : c.words)
            EXPECT_THAT(error, HasSubstr(word));
    }
    // The same pole beyond the exposed values of both images does not matter; of one image it does.
    const auto safe = options([](O& o) {
        o.curve.coeffs = {0, 1, 0, 0, -1, 2}, o.start_exposure = -1, o.stop_exposure = 0.5;
    });
    run(image, image, safe);
    ImageBuf dst;
    EXPECT_FALSE(hdr_flip(dst, image, scaled(image, 2), safe));
    EXPECT_THAT(dst.geterror(), HasSubstr("pole at x = 2"));
}

TEST(Coeffs, ACurveThatStaysDarkNeedsExposures) {
    const auto image = noise(4, 4, 1);
    const auto dark = options([](O& o) { o.curve.coeffs = {0, 0.5, 0, 0, 1, 1}; });
    ImageBuf dst;
    EXPECT_FALSE(hdr_flip(dst, image, image, dark));
    EXPECT_THAT(dst.geterror(), HasSubstr("never reaches 0.85"));
}

} // namespace
} // namespace tonetool
