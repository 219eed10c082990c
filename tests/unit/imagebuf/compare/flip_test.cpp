// SPDX-License-Identifier: BSD-3-Clause
// Laws of LDR-FLIP and HDR-FLIP as a caller sees them, and what they refuse.
#include "tonetool/flip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "images.h"
#include "view_configs.h"

namespace tonetool {
namespace {

using testing::Each;
using testing::HasSubstr;
using ToneAlgo::flip_exposed;
using ToneAlgo::hdr_flip;
using ToneAlgo::ldr_flip;

struct Outcome {
    ImageBuf map;
    FlipResult result;
};

Outcome run(const ImageBuf& reference, const ImageBuf& test, const HdrFlipOptions& options = {}) {
    Outcome out;
    EXPECT_TRUE(hdr_flip(out.map, reference, test, options, &out.result)) << out.map.geterror();
    return out;
}

TEST(Flip, IdenticalImagesAreExactlyZero) {
    const auto image = noise(50, 40, 1);
    for (const char* name : {"aces", "hable", "reinhard"}) {
        HdrFlipOptions options;
        options.curve.name = name;
        options.want_exposure_map = true;
        const Outcome r = run(image, image, options);
        EXPECT_THAT(values(r.map), Each(0.0f));
        EXPECT_THAT(values(r.result.exposure_index), Each(0.0f));
        EXPECT_THAT(values(r.result.exposure_stops), Each(float(r.result.summary.exposures[0])));
        EXPECT_EQ(r.result.summary.pool.max, 0.0);
    }
    EXPECT_THAT(values(ldr_flip(image, image)), Each(0.0f));
}

TEST(Flip, LdrOfPureColorsIsPublished) {
    const struct {
        std::vector<float> a, b;
        double error;
    } cases[] = {{{0, 1, 0}, {0, 0, 1}, 1.0}, {{0, 0, 0}, {1, 1, 1}, 0.9673883}};
    for (const auto& c : cases) {
        const auto map = ldr_flip(constant(9, 9, c.a), constant(9, 9, c.b));
        ASSERT_FALSE(map.has_error()) << map.geterror();
        for (float e : values(map)) // the published program's float noise
            EXPECT_NEAR(e, c.error, 1e-5);
    }
}

TEST(Flip, LdrIsSymmetricAndClamps) {
    const auto a = noise(30, 20, 1), b = disturbed(a, 0.4, 2);
    EXPECT_EQ(values(ldr_flip(a, b)), values(ldr_flip(b, a)));
    const auto white = constant(6, 6, {1, 1, 1});
    EXPECT_THAT(values(ldr_flip(white, constant(6, 6, {3, 1e30f, 1}))), Each(0.0f));
}

TEST(Flip, GrowsWithTheDifference) {
    const auto reference = noise(40, 30, 3);
    double before = 0;
    for (double amount : {1e-3, 1e-2, 0.1, 0.5, 1.0}) {
        const double mean =
            run(reference, disturbed(reference, amount, 4)).result.summary.pool.mean;
        EXPECT_GT(mean, before) << amount;
        before = mean;
    }
    EXPECT_LE(before, 1.0);
}

// Twice the light is one stop less exposure of the same picture.
TEST(Flip, ScaleByAPowerOfTwoShiftsTheExposures) {
    const auto reference = noise(40, 30, 5), test = disturbed(reference, 0.5, 6);
    for (const char* name : {"aces", "hable", "reinhard"}) {
        HdrFlipOptions options;
        options.curve.name = name;
        const Outcome plain = run(reference, test, options);
        const auto& stops = plain.result.summary.exposures;
        for (int k = -20; k <= 20; ++k) {
            const double factor = std::exp2(k);
            const Outcome r = run(scaled(reference, factor), scaled(test, factor), options);
            ASSERT_EQ(r.result.summary.exposures.size(), stops.size()) << name << " " << k;
            for (size_t n = 0; n < stops.size(); ++n) // a logarithm of double near 20
                EXPECT_NEAR(r.result.summary.exposures[n], stops[n] - k, 1e-9);
            // exp2 of the shifted exposure rounds to the same float, or to its neighbour.
            EXPECT_LE(largest_difference(r.map, plain.map), 1e-6) << name << " " << k;
        }
    }
}

TEST(Flip, ExposureMapIsTheIndexInStops) {
    const auto reference = noise(40, 30, 7), test = disturbed(reference, 0.5, 8);
    HdrFlipOptions options;
    options.want_exposure_map = options.want_exposures = true;
    const Outcome r = run(reference, test, options);
    const auto& stops = r.result.summary.exposures;
    const auto index = values(r.result.exposure_index), map = values(r.map);
    const auto in_stops = values(r.result.exposure_stops);
    ASSERT_EQ(r.result.exposures.size(), stops.size());
    std::set<float> used;
    for (size_t i = 0; i < index.size(); ++i) {
        ASSERT_EQ(in_stops[i], float(stops[size_t(index[i])]));
        ASSERT_EQ(map[i], values(r.result.exposures[size_t(index[i])].flip)[i]);
        used.insert(index[i]);
    }
    EXPECT_GT(used.size(), 1u);
    for (size_t n = 0; n < stops.size(); ++n) {
        EXPECT_EQ(r.result.exposures[n].stops, stops[n]);
        for (float v : values(r.result.exposures[n].reference)) {
            ASSERT_GE(v, 0.0f);
            ASSERT_LE(v, 1.0f);
        }
    }
}

TEST(Flip, MapHasTheWindowsOfTheImages) {
    auto spec = make_spec(20, 10, {"R", "G", "B"});
    spec.x = spec.full_x = -3;
    spec.y = 4;
    spec.full_y = 2;
    spec.full_width = 30;
    spec.full_height = 16;
    const auto image = noise(spec, 9);
    const auto map = ldr_flip(image, disturbed(image, 0.2, 1));
    EXPECT_EQ(map.nchannels(), 1);
    EXPECT_EQ(map.spec().format, OIIO::TypeFloat);
    EXPECT_EQ(map.xbegin(), -3);
    EXPECT_EQ(map.ybegin(), 4);
    EXPECT_EQ(map.roi_full(), ROI(-3, 27, 2, 18, 0, 1, 0, 1));
}

void expect_refused(const ImageBuf& reference, const ImageBuf& test, const char* word) {
    SCOPED_TRACE(word);
    for (const bool hdr : {true, false}) {
        ImageBuf dst = noise(3, 3, 1);
        EXPECT_FALSE(hdr ? hdr_flip(dst, reference, test) : ldr_flip(dst, reference, test));
        EXPECT_TRUE(dst.has_error());
        const std::string error = dst.geterror();
        EXPECT_THAT(error, HasSubstr(hdr ? "hdr_flip: " : "ldr_flip: "));
        EXPECT_THAT(error, HasSubstr(word));
        EXPECT_FALSE(dst.initialized()) << "a map is left";
        const ImageBuf returned = hdr ? hdr_flip(reference, test) : ldr_flip(reference, test);
        EXPECT_THAT(returned.geterror(), HasSubstr(word));
    }
}

TEST(Flip, RefusesWhatIsNoPicture) {
    const auto image = noise(6, 6, 1);
    const ImageBuf empty, missing("no/such/file.exr"), deep(TESTIMAGES_DIR "/deep.exr");
    const ImageBuf text(TESTIMAGES_DIR "/not_an_image.exr");
    expect_refused(empty, image, "reference image: is not initialized");
    expect_refused(image, empty, "test image: is not initialized");
    expect_refused(missing, image, "reference image \"no/such/file.exr\"");
    expect_refused(image, missing, "test image \"no/such/file.exr\"");
    expect_refused(deep, image, "deep images are not supported");
    expect_refused(image, deep, "deep images are not supported");
    expect_refused(text, image, "not_an_image.exr");
    expect_refused(image, noise(make_spec(6, 6, {"Z"}), 1), "\"Z\", the only layer, holds depths");
    expect_refused(noise(make_spec(6, 6, {"U", "V"}), 1), image, "needs R,G,B");
    expect_refused(image, noise(7, 6, 1), "7x6+0+0");
    expect_refused(image, constant(6, 6, {NAN, 1, 1}), "the test has no finite pixel");
    expect_refused(constant(6, 6, {NAN, 1, 1}), image, "the reference has no finite pixel");
}

TEST(Flip, ATruncatedFileIsAnError) {
    const ImageBuf truncated(TESTIMAGES_DIR "/truncated.exr"), plain(TESTIMAGES_DIR "/plain.exr");
    ImageBuf dst;
    EXPECT_FALSE(hdr_flip(dst, truncated, truncated));
    EXPECT_THAT(dst.geterror(), HasSubstr("truncated.exr"));
}

TEST(Flip, AFailureLeavesTheResultAlone) {
    FlipResult result;
    result.summary.ppd = -1;
    ImageBuf dst;
    EXPECT_FALSE(hdr_flip(dst, ImageBuf(), ImageBuf(), {}, &result));
    EXPECT_EQ(result.summary.ppd, -1);
}

TEST(FlipQuantity, KnowsEveryNameItLists) {
    FlipPool pool;
    pool.mean = 1;
    pool.weighted_median = 2;
    pool.weighted_q1 = 3;
    pool.weighted_q3 = 4;
    pool.p50 = 5;
    pool.p95 = 6;
    pool.p99 = 7;
    pool.p999 = 8;
    pool.min = 9;
    pool.max = 10;
    double expected = 1;
    for (const std::string& name : ToneAlgo::flip_quantities())
        EXPECT_EQ(ToneAlgo::flip_quantity(pool, name), expected++) << name;
    EXPECT_EQ(expected, 11);
    for (const char* name : {"", "Mean", "average", "p99.95"})
        EXPECT_FALSE(ToneAlgo::flip_quantity(pool, name).has_value()) << name;
}

TEST(FlipQuantity, PercentilesAndSharesThatWereAskedFor) {
    const auto reference = noise(40, 30, 1);
    HdrFlipOptions options;
    options.quantities = {"p99.95", "p0", "p100", "p99.90", "above0.2", "above0", "p25"};
    FlipResult result;
    const auto map = ToneAlgo::hdr_flip(reference, disturbed(reference, 0.5, 2), options, &result);
    const FlipPool& pool = result.summary.pool;
    std::vector<float> sorted(1200);
    ASSERT_TRUE(map.get_pixels(map.roi(), OIIO::TypeFloat, sorted.data()));
    std::sort(sorted.begin(), sorted.end());
    const auto above = [&](double error) {
        return double(std::count_if(sorted.begin(), sorted.end(),
                                    [&](float v) { return v > error; })) /
               1200;
    };
    EXPECT_EQ(ToneAlgo::flip_quantity(pool, "p99.95"), double(sorted[1199]));
    EXPECT_EQ(ToneAlgo::flip_quantity(pool, "p25"), double(sorted[299]));
    EXPECT_EQ(ToneAlgo::flip_quantity(pool, "p0"), pool.min);
    EXPECT_EQ(ToneAlgo::flip_quantity(pool, "p100"), pool.max);
    EXPECT_EQ(ToneAlgo::flip_quantity(pool, "p99.90"), pool.p999);
    EXPECT_EQ(ToneAlgo::flip_quantity(pool, "above0.2"), above(0.2));
    EXPECT_EQ(ToneAlgo::flip_quantity(pool, "above0"), above(0));
    EXPECT_EQ(map.spec().get_float_attribute("FLIP:above0.2"), float(above(0.2)));
    for (const char* name :
         {"p101", "p-1", "p", "px", "pnan", "above", "above-1", "aboveinf", "P50", "p5 0"}) {
        options.quantities = {name};
        EXPECT_THAT(ToneAlgo::hdr_flip(reference, reference, options).geterror(),
                    HasSubstr("unknown quantity"))
            << name;
    }
}

// What flip_exposed() shows is what hdr_flip() compared, at its own exposures and at single ones.
void expect_shown_as_compared(const ImageBuf& reference, const ImageBuf& test,
                              HdrFlipOptions options) {
    options.want_exposures = true;
    const FlipResult compared = run(reference, test, options).result;
    std::vector<FlipExposure> all, one;
    std::string error;
    ASSERT_TRUE(flip_exposed(all, reference, test, error, options)) << error;
    ASSERT_EQ(all.size(), compared.exposures.size());
    for (size_t i = 0; i < all.size(); ++i) {
        const FlipExposure& wanted = compared.exposures[i];
        ASSERT_TRUE(flip_exposed(one, reference, test, error, options, {wanted.stops}, {}, 1))
            << error;
        for (const FlipExposure& shown : {all[i], one.at(0)}) {
            EXPECT_EQ(shown.stops, wanted.stops);
            EXPECT_EQ(values(shown.reference), values(wanted.reference));
            EXPECT_EQ(values(shown.test), values(wanted.test));
            EXPECT_EQ(shown.test.spec().get_string_attribute("oiio:ColorSpace"), "Linear");
            EXPECT_FALSE(shown.flip.initialized());
        }
    }
}

TEST(Exposed, IsWhatHdrFlipComparesToTheBit) {
    const auto reference = with_pixel(noise(70, 41, 1), 3, 4, {NAN, 1, 2});
    const auto test = with_pixel(disturbed(noise(70, 41, 1), 0.3, 2), 9, 9, {1, INFINITY, -1});
    const Folder folder;
    for (const char* curve : {"aces", "hable", "reinhard", "drago", "agx"}) {
        SCOPED_TRACE(curve);
        HdrFlipOptions options;
        options.curve.name = curve;
        expect_shown_as_compared(reference, test, options);
        if (curve == std::string("agx"))
            continue; // which mixes the channels
        options.curve.on = "luminance";
        expect_shown_as_compared(reference, test, options);
    }
    HdrFlipOptions options;
    options.view = ViewOptions();
    options.view->config = write_text(folder / "config.ocio", kConfig);
    options.view->display = "sRGB";
    options.view->view = "SDR";
    for (const bool exact : {false, true}) {
        SCOPED_TRACE(exact);
        options.exact = exact;
        expect_shown_as_compared(reference, test, options);
    }
}

TEST(Exposed, TakesAnyExposuresARegionAndOneImage) {
    const auto image = noise(30, 20, 1);
    std::vector<FlipExposure> whole, part;
    std::string error;
    ASSERT_TRUE(flip_exposed(whole, image, image, error, {}, {4, -2.5})) << error;
    ASSERT_EQ(whole.size(), 2u);
    EXPECT_EQ(whole[0].stops, 4);
    EXPECT_EQ(values(whole[1].reference), values(whole[1].test));
    const ROI roi(5, 8, 2, 4);
    ASSERT_TRUE(flip_exposed(part, image, image, error, {}, {4}, roi)) << error;
    EXPECT_EQ(part.at(0).test.spec().width, 3);
    EXPECT_EQ(pixel_of(part[0].test, 6, 3), pixel_of(whole[0].test, 6, 3));
}

TEST(Exposed, RefusesWhatHdrFlipRefuses) {
    const auto image = noise(30, 20, 1), black = constant(30, 20, {0, 0, 0});
    const auto why = [&](const ImageBuf& reference, const std::vector<double>& stops) {
        std::vector<FlipExposure> shown(1);
        std::string error;
        EXPECT_FALSE(flip_exposed(shown, reference, image, error, {}, stops));
        EXPECT_TRUE(shown.empty());
        return error;
    };
    EXPECT_THAT(why(image, {0, 500}), HasSubstr("an exposure is 500 stops: must be -126 to 127"));
    EXPECT_THAT(why(image, {NAN}), HasSubstr("must be -126 to 127"));
    EXPECT_THAT(why(black, {}), HasSubstr("the reference is black"));
    EXPECT_THAT(why(noise(8, 8, 1), {0}), HasSubstr("display window"));
}

} // namespace
} // namespace tonetool
