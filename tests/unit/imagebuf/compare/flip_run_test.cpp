// SPDX-License-Identifier: BSD-3-Clause
// Regions, threads and several tests: none of them changes a bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "images.h"
#include "tonetool/flip.h"

namespace tonetool {
namespace {

using testing::Contains;
using testing::HasSubstr;
using ToneAlgo::hdr_flip;
using ToneAlgo::ldr_flip;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

HdrFlipOptions all_maps() {
    HdrFlipOptions options;
    options.want_exposure_map = options.want_exposures = true;
    return options;
}

TEST(FlipRun, ThreadsDoNotChangeABit) {
    const auto reference = noise(150, 110, 1), test = disturbed(reference, 0.3, 2);
    FlipResult one, many;
    const auto map = hdr_flip(reference, test, all_maps(), &one, {}, 1);
    for (int n : {2, 3, 8, 0}) {
        EXPECT_EQ(values(map), values(hdr_flip(reference, test, all_maps(), &many, {}, n))) << n;
        EXPECT_EQ(values(one.exposure_index), values(many.exposure_index));
        EXPECT_EQ(one.summary.pool.mean, many.summary.pool.mean);
        EXPECT_EQ(one.summary.pool.weighted_median, many.summary.pool.weighted_median);
        EXPECT_EQ(one.summary.exposures, many.summary.exposures);
        EXPECT_EQ(values(ldr_flip(reference, test, {}, nullptr, {}, 1)),
                  values(ldr_flip(reference, test, {}, nullptr, {}, n)));
    }
}

TEST(FlipRun, TilesIntoAnInitializedMapGiveTheSameBits) {
    auto spec = make_spec(130, 100, {"R", "G", "B"});
    spec.x = -7;
    spec.y = 11;
    const auto reference = noise(spec, 3), test = disturbed(reference, 0.3, 4);
    const auto whole = hdr_flip(reference, test);
    const std::pair<int, int> sizes[] = {{41, 37}, {130, 9}, {1, 100}, {129, 99}};
    for (const auto& [w, h] : sizes) {
        const ImageSpec& map_spec = whole.spec();
        ImageBuf tiled(map_spec);
        const float stale = -1;
        for (ImageBuf::Iterator<float> p(tiled); !p.done(); ++p)
            p[0] = stale;
        const void* memory = tiled.localpixels();
        for (int y = 11; y < 111; y += h)
            for (int x = -7; x < 123; x += w)
                ASSERT_TRUE(hdr_flip(tiled, reference, test, {}, nullptr,
                                     ROI(x, std::min(x + w, 123), y, std::min(y + h, 111))))
                    << tiled.geterror();
        EXPECT_EQ(tiled.localpixels(), memory) << "written in place";
        EXPECT_EQ(values(tiled), values(whole)) << w << "x" << h;
    }
}

TEST(FlipRun, ARegionIsPooledAlone) {
    const auto reference = noise(60, 50, 5), test = disturbed(reference, 0.3, 6);
    const ROI roi(10, 31, 20, 33);
    FlipResult whole, part;
    const auto all = hdr_flip(reference, test, {}, &whole);
    const auto map = hdr_flip(reference, test, {}, &part, roi);
    EXPECT_EQ(map.roi(), ROI(10, 31, 20, 33, 0, 1, 0, 1));
    EXPECT_EQ(part.summary.pool.pixels, 21 * 13);
    EXPECT_EQ(part.summary.exposures, whole.summary.exposures) << "from the whole reference";
    double sum = 0;
    for (int y = 20; y < 33; ++y)
        for (int x = 10; x < 31; ++x) {
            EXPECT_EQ(map.getchannel(x, y, 0, 0), all.getchannel(x, y, 0, 0));
            sum += double(all.getchannel(x, y, 0, 0));
        }
    EXPECT_NEAR(part.summary.pool.mean, sum / (21 * 13), 1e-14); // doubles in another order
    EXPECT_GE(part.summary.pool.max_x, 10);
    EXPECT_GE(part.summary.pool.max_y, 20);
}

TEST(FlipRun, ARegionOutsideIsAnError) {
    const auto image = noise(6, 6, 1);
    ImageBuf dst;
    EXPECT_FALSE(hdr_flip(dst, image, image, {}, nullptr, ROI(10, 12, 0, 3)));
    EXPECT_THAT(dst.geterror(), HasSubstr("region of interest holds no pixel"));
    // Partly outside: what is inside.
    EXPECT_EQ(hdr_flip(image, image, {}, nullptr, ROI(4, 12, -2, 3)).roi(),
              ROI(4, 6, 0, 3, 0, 1, 0, 1));
}

ImageBuf shifted(const ImageBuf& image, int x, int y) {
    ImageBuf out = image;
    const ROI full = out.roi_full();
    out.set_origin(x, y);
    out.set_roi_full(full);
    return out;
}

void expect_as_single(const ImageBuf& reference, const std::vector<const ImageBuf*>& tests,
                      const HdrFlipOptions& options) {
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> results;
    ASSERT_TRUE(hdr_flip(maps, reference, tests, options, &results)) << maps[0].geterror();
    ASSERT_EQ(maps.size(), tests.size());
    ASSERT_EQ(results.size(), tests.size());
    for (size_t t = 0; t < tests.size(); ++t) {
        SCOPED_TRACE(t);
        FlipResult single;
        const ImageBuf map = hdr_flip(reference, *tests[t], options, &single);
        EXPECT_EQ(maps[t].roi(), map.roi());
        EXPECT_EQ(values(maps[t]), values(map));
        EXPECT_EQ(values(results[t].exposure_index), values(single.exposure_index));
        const FlipSummary &a = results[t].summary, &b = single.summary;
        EXPECT_EQ(a.exposures, b.exposures);
        EXPECT_EQ(a.pool.mean, b.pool.mean);
        EXPECT_EQ(a.warnings, b.warnings);
        EXPECT_EQ(a.nonfinite_both, b.nonfinite_both);
        ASSERT_EQ(results[t].exposures.size(), single.exposures.size());
        for (size_t n = 0; n < single.exposures.size(); ++n) {
            EXPECT_EQ(values(results[t].exposures[n].flip), values(single.exposures[n].flip));
            EXPECT_EQ(values(results[t].exposures[n].test), values(single.exposures[n].test));
        }
    }
}

TEST(SeveralTests, GiveTheBitsOfSingleCalls) {
    const auto reference = noise(50, 40, 7);
    const auto a = disturbed(reference, 0.3, 8), b = disturbed(reference, 1e-3, 9);
    expect_as_single(reference, {&a, &reference, &b}, all_maps());
}

TEST(SeveralTests, WithNonFinitePixels) {
    const auto clean = noise(40, 30, 10);
    const auto reference = with_pixel(with_pixel(clean, 5, 6, {kNan, 1, 1}), 30, 20, {1, kNan, 1});
    const auto a = disturbed(clean, 0.3, 11);
    const auto b = with_pixel(disturbed(clean, 0.2, 12), 5, 6, {kNan, 2, 2});
    const auto c = with_pixel(disturbed(clean, 0.1, 13), 8, 6, {kNan, 2, 2});
    expect_as_single(reference, {&a, &b, &c, &reference}, all_maps());
    expect_as_single(clean, {&a, &b, &c}, all_maps());
}

TEST(SeveralTests, WithDifferentDataWindows) {
    const auto reference = noise(40, 30, 14);
    const auto a = disturbed(reference, 0.3, 15), b = shifted(a, 3, -2), c = shifted(a, -5, 1);
    expect_as_single(reference, {&a, &b, &c}, all_maps());
}

TEST(SeveralTests, AreAllOrNothing) {
    const auto reference = noise(10, 10, 16), small = noise(9, 10, 17);
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> results(7);
    EXPECT_FALSE(hdr_flip(maps, reference, {&reference, &small}, {}, &results));
    ASSERT_EQ(maps.size(), 2u);
    for (const ImageBuf& map : maps) {
        EXPECT_FALSE(map.initialized());
        EXPECT_THAT(map.geterror(), HasSubstr("9x10+0+0"));
    }
    EXPECT_EQ(results.size(), 7u);
    EXPECT_FALSE(hdr_flip(maps, reference, {}));
    ASSERT_EQ(maps.size(), 1u);
    EXPECT_THAT(maps[0].geterror(), HasSubstr("there is no test image"));
    EXPECT_FALSE(hdr_flip(maps, reference, {&reference, nullptr}));
    ASSERT_EQ(maps.size(), 2u);
    EXPECT_THAT(maps[1].geterror(), HasSubstr("null pointer"));
}

// Windows and sizes.

TEST(DataWindows, TheUnionIsComparedAndCounted) {
    const auto reference = noise(20, 10, 18);
    const auto test = shifted(reference, 4, 3); // covers 16 x 7 of the same pixels
    FlipResult result;
    const auto map = hdr_flip(reference, test, {}, &result);
    EXPECT_EQ(map.roi(), ROI(0, 24, 0, 13, 0, 1, 0, 1));
    EXPECT_EQ(map.roi_full(), ROI(0, 20, 0, 10, 0, 1, 0, 1));
    EXPECT_EQ(result.summary.reference.uncovered, 24 * 13 - 200);
    EXPECT_EQ(result.summary.test.uncovered, 24 * 13 - 200);
    EXPECT_EQ(result.summary.pool.pixels, 24 * 13);
    EXPECT_THAT(result.summary.warnings, Contains(HasSubstr("112 compared pixel(s) lie outside "
                                                            "the reference's data window")));
}

TEST(DataWindows, MissingPixelsAreBlack) {
    const auto reference = noise(30, 20, 19);
    const auto part = OIIO::ROI(6, 25, 3, 18, 0, 1, 0, 3);
    ImageSpec spec = reference.spec();
    spec.x = part.xbegin;
    spec.y = part.ybegin;
    spec.width = part.width();
    spec.height = part.height();
    ImageBuf cut(spec), padded = constant(30, 20, {0, 0, 0});
    std::vector<float> pixels(size_t(part.width()) * size_t(part.height()) * 3);
    reference.get_pixels(part, OIIO::TypeFloat, pixels.data());
    cut.set_pixels(part, OIIO::TypeFloat, pixels.data());
    padded.set_pixels(part, OIIO::TypeFloat, pixels.data());
    EXPECT_EQ(values(hdr_flip(reference, cut)), values(hdr_flip(reference, padded)));
}

TEST(DataWindows, ExposuresLookAtTheReferencesOwnPixels) {
    const auto reference = noise(20, 10, 20);
    FlipResult alone, wider;
    hdr_flip(reference, reference, {}, &alone);
    hdr_flip(reference, shifted(reference, 12, 8), {}, &wider);
    EXPECT_EQ(alone.summary.exposures, wider.summary.exposures);
}

TEST(Sizes, ResizeAndCrop) {
    const auto reference = constant(24, 12, {0.5f, 0.25f, 0.125f});
    const auto half = constant(12, 6, {0.5f, 0.25f, 0.125f});
    HdrFlipOptions options;
    options.size = SizePolicy::Resize;
    FlipResult result;
    const auto resized = hdr_flip(reference, half, options, &result);
    ASSERT_FALSE(resized.has_error()) << resized.geterror();
    EXPECT_EQ(resized.roi(), ROI(0, 24, 0, 12, 0, 1, 0, 1));
    // Weights of the resampling add up to 1 within 1e-6; the metric is steep there: h^0.7.
    EXPECT_LE(result.summary.pool.max, 1e-4);
    options.size = SizePolicy::Crop;
    const auto cropped = hdr_flip(reference, half, options, &result);
    ASSERT_FALSE(cropped.has_error()) << cropped.geterror();
    EXPECT_EQ(cropped.roi(), ROI(0, 12, 0, 6, 0, 1, 0, 1));
    EXPECT_EQ(result.summary.pool.max, 0.0);
    EXPECT_EQ(result.summary.pool.pixels, 72);
}

TEST(MapInPlace, OnlyAFloatChannelThatCoversTheRegionIsKept) {
    const auto reference = noise(20, 10, 21), test = disturbed(reference, 0.2, 22);
    const auto expected = values(hdr_flip(reference, test));
    const ImageSpec others[] = {make_spec(20, 10, {"R", "G", "B"}), make_spec(19, 10, {"Y"}),
                                make_spec(20, 10, {"Y"}, OIIO::TypeHalf)};
    for (const ImageSpec& spec : others) {
        ImageBuf dst(spec);
        ASSERT_TRUE(hdr_flip(dst, reference, test));
        EXPECT_EQ(dst.nchannels(), 1);
        EXPECT_EQ(dst.spec().format, OIIO::TypeFloat);
        EXPECT_EQ(values(dst), expected);
    }
    ImageBuf larger(make_spec(22, 12, {"Y"}));
    const void* memory = larger.localpixels();
    ASSERT_TRUE(hdr_flip(larger, reference, test));
    EXPECT_EQ(larger.localpixels(), memory);
    EXPECT_EQ(larger.getchannel(19, 9, 0, 0), expected.back());
    EXPECT_GT(larger.spec().get_float_attribute("FLIP:meanerror"), 0.0f);
}

TEST(FlipRun, AReusedMapKeepsNoOldAttributes) {
    const auto reference = noise(12, 10, 30), test = disturbed(reference, 0.3, 31);
    auto map = hdr_flip(reference, test);
    ASSERT_TRUE(map.spec().find_attribute("FLIP:startExposure"));
    ASSERT_TRUE(ToneAlgo::ldr_flip(map, reference, test));
    EXPECT_FALSE(map.spec().find_attribute("FLIP:startExposure"));
    EXPECT_TRUE(map.spec().find_attribute("FLIP:meanerror"));
}

} // namespace
} // namespace tonetool
