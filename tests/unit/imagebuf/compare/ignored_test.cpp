// SPDX-License-Identifier: BSD-3-Clause
// Pixels that do not count: laws.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "images.h"
#include "tonetool/tonetool.h"

namespace tonetool {
namespace {

using testing::Contains;
using testing::HasSubstr;
using ToneAlgo::error_map;
using ToneAlgo::hdr_flip;
using ToneAlgo::ignored_pixels;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const ImageSpec kSpec = make_spec(70, 50, {"R", "G", "B"});

std::shared_ptr<ImageBuf> mask_outside(const ROI& ignored) {
    auto mask = std::make_shared<ImageBuf>(make_spec(kSpec.width, kSpec.height, {"Y"}));
    for (ImageBuf::Iterator<float> p(*mask); !p.done(); ++p)
        p[0] = ignored.contains(p.x(), p.y()) ? 0.0f : 1.0f;
    return mask;
}

HdrFlipOptions exposed() {
    HdrFlipOptions options;
    options.start_exposure = -2;
    options.stop_exposure = 2;
    options.quantities = {"p99.95", "above0.1"};
    options.want_exposure_map = true;
    return options;
}

void expect_same_pool(const FlipPool& a, const FlipPool& b) {
    EXPECT_EQ(a.mean, b.mean);
    EXPECT_EQ(a.weighted_median, b.weighted_median);
    EXPECT_EQ(a.p50, b.p50);
    EXPECT_EQ(a.p999, b.p999);
    EXPECT_EQ(a.min, b.min);
    EXPECT_EQ(a.max, b.max);
    EXPECT_EQ(a.max_x, b.max_x);
    EXPECT_EQ(a.max_y, b.max_y);
    EXPECT_EQ(a.min_x, b.min_x);
    EXPECT_EQ(a.pixels, b.pixels);
    EXPECT_EQ(a.histogram, b.histogram);
    EXPECT_EQ(a.further, b.further);
}

// A border that is equal in both, and ignored, is as if only the rest had been asked for.
TEST(Ignored, ABorderIsPooledAsARegionWithoutIt) {
    const ROI inside(13, 58, 9, 44);
    const ImageBuf reference = noise(kSpec, 1), other = disturbed(reference, 0.4, 2);
    ImageBuf test = reference;
    for (ImageBuf::Iterator<float> p(test, inside); !p.done(); ++p)
        for (int c = 0; c < 3; ++c)
            p[c] = other.getchannel(p.x(), p.y(), 0, c);
    HdrFlipOptions options = exposed();
    FlipResult part, masked;
    const ImageBuf region = hdr_flip(reference, test, options, &part, inside);
    options.ignore = {"70x9+0+0", "70x6+0+44", "13x50+0+0", "12x50+58+0"};
    const ImageBuf map = hdr_flip(reference, test, options, &masked);
    ASSERT_FALSE(map.has_error()) << map.geterror();
    expect_same_pool(masked.summary.pool, part.summary.pool);
    for (ImageBuf::ConstIterator<float> p(map); !p.done(); ++p) {
        const bool counts = inside.contains(p.x(), p.y());
        ASSERT_EQ(p[0], counts ? region.getchannel(p.x(), p.y(), 0, 0) : 0.0f);
        if (!counts)
            ASSERT_EQ(masked.exposure_index.getchannel(p.x(), p.y(), 0, 0), 0.0f);
    }
    EXPECT_NEAR(*masked.summary.ignored, 1 - 45.0 * 35 / (70 * 50), 1e-12);
    EXPECT_FALSE(part.summary.ignored);
}

TEST(Ignored, AnImageAndRegionsSayTheSame) {
    const ImageBuf reference = noise(kSpec, 3), test = disturbed(reference, 0.4, 4);
    HdrFlipOptions by_region, by_mask;
    by_region.ignore = {"20x10+5+7"};
    by_mask.mask.image = mask_outside(ROI(5, 25, 7, 17));
    FlipResult a, b;
    EXPECT_EQ(values(hdr_flip(reference, test, by_region, &a)),
              values(hdr_flip(reference, test, by_mask, &b)));
    expect_same_pool(a.summary.pool, b.summary.pool);
    EXPECT_EQ(a.summary.exposures, b.summary.exposures);
}

TEST(Ignored, ThreadsAndTestsBesideDoNotChangeABit) {
    ImageBuf reference = with_pixel(noise(kSpec, 5), 6, 8, {kNan, 1, 1});
    const ImageBuf one = with_pixel(disturbed(reference, 0.4, 6), 40, 30, {1, kNan, 1});
    const ImageBuf two = with_pixel(disturbed(reference, 0.4, 7), 7, 9, {1, kNan, 1});
    HdrFlipOptions options = exposed();
    options.ignore = {"20x10+5+7"}; // holds the first and the third of them
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> results;
    ASSERT_TRUE(hdr_flip(maps, reference, {&one, &two}, options, &results, {}, 3));
    for (size_t t = 0; t < 2; ++t) {
        FlipResult alone;
        EXPECT_EQ(values(maps[t]),
                  values(hdr_flip(reference, t == 0 ? one : two, options, &alone, {}, 1)));
        expect_same_pool(results[t].summary.pool, alone.summary.pool);
        EXPECT_EQ(alone.summary.reference.nonfinite, 0);
        EXPECT_EQ(alone.summary.test.nonfinite, t == 0 ? 1 : 0);
    }
}

TEST(Ignored, AlphaThatDoesNotCountIsNotCompared) {
    const ImageSpec spec = make_spec(70, 50, {"R", "G", "B", "A"});
    const ImageBuf reference = constant(spec, {0.4f, 0.4f, 0.4f, 1});
    const ImageBuf test = with_pixel(with_pixel(reference, 3, 3, {0.4f, 0.4f, 0.4f, 0}), 30, 30,
                                     {0.4f, 0.4f, 0.4f, 0.5f});
    ErrorOptions options;
    options.metric = "mse";
    options.ignore = {"5x5+1+1"};
    ErrorSummary ignoring, comparing;
    error_map(reference, test, options, &ignoring);
    EXPECT_EQ(ignoring.alpha_ignored, 1);
    options.alpha = AlphaPolicy::Error;
    error_map(reference, test, options, &comparing);
    EXPECT_EQ(comparing.alpha_max, 0.5);
    EXPECT_EQ(comparing.alpha_max_x, 30);
    EXPECT_EQ(comparing.alpha_mean, 0.5 / (70 * 50 - 25));
}

TEST(Ignored, TheLargestErrorOfPixelsWithoutNumbersIsOneThatCounts) {
    const ImageBuf reference = constant(70, 50, {0, 0, 0});
    const ImageBuf test =
        with_pixel(with_pixel(reference, 2, 2, {90, 90, 90}), 30, 30, {kNan, 0, 0});
    ErrorOptions options;
    options.metric = "mse";
    ErrorSummary all, some;
    const ImageBuf map = error_map(reference, test, options, &all);
    EXPECT_EQ(map.getchannel(30, 30, 0, 0), 8100);
    options.ignore = {"5x5+0+0"};
    const ImageBuf rest = error_map(reference, test, options, &some);
    EXPECT_EQ(rest.getchannel(30, 30, 0, 0), 1);
    EXPECT_EQ(some.pool.max_x, 30);
    options.ignore = {"1x1+30+30"}; // what does not count is not lost
    error_map(reference, test, options, &some);
    EXPECT_EQ(some.pool.max, 8100);
}

TEST(Ignored, OfAPartNothingMayBeLeft) {
    const ImageBuf reference = noise(kSpec, 8);
    HdrFlipOptions options = exposed();
    options.ignore = {"20x10+5+7"};
    EXPECT_THAT(hdr_flip(reference, reference, options, nullptr, ROI(5, 9, 7, 9)).geterror(),
                HasSubstr("leave no pixel that counts"));
    FlipResult most;
    options.ignore = {"36x50+0+0"};
    hdr_flip(reference, reference, options, &most);
    EXPECT_THAT(most.summary.warnings, Contains(HasSubstr("of the pixels do not count")));
    options.ignore = {"35x50+0+0"};
    hdr_flip(reference, reference, options, &most);
    EXPECT_TRUE(most.summary.warnings.empty());
}

TEST(Ignored, PixelsAreToldAsTheyAreFound) {
    std::vector<uint8_t> found;
    std::vector<std::string> warnings;
    std::string error;
    IgnoreOptions options;
    options.ignore = {"2x1-1+1", "1x1+2+0"};
    ASSERT_TRUE(ignored_pixels(found, kSpec, options, ROI(-1, 3, 0, 2), warnings, error)) << error;
    EXPECT_EQ(found, (std::vector<uint8_t>{0, 0, 0, 1, 1, 1, 0, 0}));
    options.ignore = {"2x1"};
    EXPECT_FALSE(ignored_pixels(found, kSpec, options, ROI(0, 3, 0, 2), warnings, error));
    EXPECT_THAT(error, HasSubstr("must be WxH+X+Y"));
}

TEST(Ignored, LuminanceIsOfWhatCounts) {
    const ImageBuf image = with_pixel(constant(70, 50, {1, 1, 1}), 4, 4, {500, 500, 500});
    LuminanceStats stats;
    std::string error;
    IgnoreOptions without;
    without.ignore = {"1x1+4+4"};
    ASSERT_TRUE(ToneAlgo::luminance_stats(stats, image, error, {}, {}, 0, without)) << error;
    EXPECT_EQ(stats.max, 1);
    EXPECT_EQ(stats.pixels, 70 * 50 - 1);
}

} // namespace
} // namespace tonetool
