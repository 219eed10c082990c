// SPDX-License-Identifier: BSD-3-Clause
// HDR-FLIP under every tone curve of the registry.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "images.h"
#include "tonetool/flip.h"
#include "tonetool/tonemap.h"

namespace tonetool {
namespace {

using testing::HasSubstr;
using ToneAlgo::hdr_flip;
using ToneAlgo::ldr_flip;
using ToneAlgo::tonemap;

struct Outcome {
    ImageBuf map;
    FlipSummary summary;
};

Outcome run(const ImageBuf& reference, const ImageBuf& test, const HdrFlipOptions& options) {
    FlipResult result;
    Outcome out;
    EXPECT_TRUE(hdr_flip(out.map, reference, test, options, &result)) << out.map.geterror();
    out.summary = result.summary;
    return out;
}

// The image at an exposure, behind the curve as HDR-FLIP has it.
ImageBuf shown(const ImageBuf& image, const HdrFlipOptions& options, const FlipSummary& summary,
               double stops) {
    TonemapOptions look;
    look.curve = options.curve;
    look.curve.parameters = summary.parameters;
    look.calibration.stops = stops;
    look.encode = "none";
    ImageBuf out = tonemap(image, look);
    EXPECT_FALSE(out.has_error()) << out.geterror();
    return out;
}

HdrFlipOptions with_curve(const std::string& name) {
    HdrFlipOptions options;
    options.curve.name = name;
    return options;
}

TEST(FlipCurves, OneExposureIsLdrFlipOfTheToneMappedPair) {
    const auto reference = noise(60, 40, 5), test = disturbed(reference, 0.5, 6);
    for (const std::string& name : ToneAlgo::tone_curve_names()) {
        HdrFlipOptions options = with_curve(name);
        options.num_exposures = 1;
        options.start_exposure = -0.75;
        const Outcome hdr = run(reference, test, options);
        FlipOptions ldr;
        ldr.pixels.from = "rec709";
        ImageBuf map;
        ASSERT_TRUE(ldr_flip(map, shown(reference, options, hdr.summary, -0.75),
                             shown(test, options, hdr.summary, -0.75), ldr));
        // The same arithmetic; lanes of the curve alone and beside the filters round alike but for
        // the curves that the kernels of FLIP have themselves.
        EXPECT_LE(largest_difference(hdr.map, map), 2e-6) << name;
        EXPECT_GT(hdr.summary.pool.mean, 0.01) << name;
    }
}

TEST(FlipCurves, IdenticalImagesAreExactlyZero) {
    const auto image = noise(40, 30, 1);
    for (const std::string& name : ToneAlgo::tone_curve_names())
        EXPECT_EQ(run(image, image, with_curve(name)).summary.pool.max, 0) << name;
}

TEST(FlipCurves, ExposuresBringMaximumAndMedianTo085) {
    const auto reference = noise(60, 40, 5), test = disturbed(reference, 0.5, 6);
    for (const std::string& name : ToneAlgo::tone_curve_names()) {
        const Outcome r = run(reference, test, with_curve(name));
        const FlipSummary& s = r.summary;
        ASSERT_GT(s.bright, 0) << name;
        CurveOptions curve;
        curve.name = name;
        curve.parameters = s.parameters;
        std::vector<double> light;
        std::string error;
        ASSERT_TRUE(
            ToneAlgo::tone_curve_response(light, curve,
                                          {s.max_luminance * std::exp2(s.exposures.front()),
                                           s.median_luminance * std::exp2(s.exposures.back())},
                                          error))
            << error;
        EXPECT_NEAR(light[0], 0.85, 1e-9) << name;
        EXPECT_NEAR(light[1], 0.85, 1e-9) << name;
    }
}

TEST(FlipCurves, CoefficientsOfACurveAreThatCurve) {
    const auto reference = noise(60, 40, 5), test = disturbed(reference, 0.5, 6);
    int compared = 0;
    for (const std::string& name : ToneAlgo::tone_curve_names()) {
        const Outcome named = run(reference, test, with_curve(name));
        if (named.summary.coeffs.empty())
            continue;
        HdrFlipOptions own;
        own.curve.coeffs = named.summary.coeffs;
        own.curve.on = named.summary.on;
        ImageBuf map;
        // A user's own coefficients must make a curve that rises; these ones are told so.
        if (!hdr_flip(map, reference, test, own)) {
            EXPECT_THAT(map.geterror(), HasSubstr("does not increase")) << name;
            EXPECT_THAT(name, testing::AnyOf("steve-b", "hejl2015")) << name;
            continue;
        }
        EXPECT_LE(largest_difference(named.map, map), 1e-6) << name;
        ++compared;
    }
    EXPECT_GE(compared, 7);
}

TEST(FlipCurves, OfThePaperAreItsOwn) {
    const auto reference = noise(20, 20, 5);
    const auto aces = run(reference, reference, with_curve("aces")).summary;
    EXPECT_EQ(aces.parameters.at("prescale"), 0.6);
    EXPECT_NEAR(aces.bright, 2.11887312, 3e-6); // as published, solved in float there
    EXPECT_EQ(aces.on, "rgb");
    EXPECT_EQ(run(reference, reference, with_curve("reinhard")).summary.on, "luminance");
}

TEST(FlipCurves, ParametersAndDomainEnterTheMap) {
    const auto reference = noise(60, 40, 5), test = disturbed(reference, 0.5, 6);
    const auto changed = [&](const std::string& name, const auto& set) {
        HdrFlipOptions plain = with_curve(name);
        plain.start_exposure = -2;
        plain.stop_exposure = 2;
        HdrFlipOptions other = plain;
        set(other.curve);
        return largest_difference(run(reference, test, plain).map, run(reference, test, other).map);
    };
    EXPECT_GT(changed("drago", [](CurveOptions& c) { c.parameters["bias"] = 0.6; }), 1e-3);
    EXPECT_GT(changed("reinhard", [](CurveOptions& c) { c.on = "rgb"; }), 1e-3);
    EXPECT_GT(changed("reinhard", [](CurveOptions& c) { c.saturation = 0.5; }), 1e-3);
    EXPECT_EQ(changed("reinhard", [](CurveOptions& c) { c.on = "luminance"; }), 0);
}

TEST(FlipCurves, WhatIsWrongIsSaid) {
    const auto image = noise(4, 4, 1);
    const auto error = [&](const auto& set) {
        HdrFlipOptions options;
        set(options);
        ImageBuf map;
        EXPECT_FALSE(hdr_flip(map, image, image, options));
        return map.geterror();
    };
    EXPECT_THAT(error([](HdrFlipOptions& o) { o.curve.parameters["bias"] = 0.5; }),
                HasSubstr("bias"));
    EXPECT_THAT(error([](HdrFlipOptions& o) { o.encoding = "srgb"; }), HasSubstr("view"));
    EXPECT_THAT(error([](HdrFlipOptions& o) { o.peak = 100; }), HasSubstr("view"));
    EXPECT_THAT(error([](HdrFlipOptions& o) {
                    o.curve.name = "exponential";
                    o.curve.on = "alpha";
                }),
                HasSubstr("rgb, luminance"));
}

} // namespace
} // namespace tonetool
