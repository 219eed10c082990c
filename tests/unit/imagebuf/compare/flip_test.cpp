// SPDX-License-Identifier: BSD-3-Clause
// Laws of LDR-FLIP and HDR-FLIP as a caller sees them, and what they refuse.
#include "tonetool/flip.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "images.h"

namespace tonetool {
namespace {

using testing::Each;
using testing::HasSubstr;
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

} // namespace
} // namespace tonetool
