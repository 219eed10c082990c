// SPDX-License-Identifier: BSD-3-Clause
// Bands of rows, from memory or from files, give the bits of the whole image.
#include "imagebuf/pixels/bands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "files.h"
#include "imagebuf/compare/flip_run.h"
#include "refusal.h"

namespace tonetool {
namespace {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr int kWidth = 45, kHeight = 83;

struct Outcome {
    std::vector<ImageBuf> maps;
    std::vector<FlipResult> results;
    std::string error;
};

using Images = std::vector<const ImageBuf*>;

HdrFlipOptions all_maps() {
    HdrFlipOptions options;
    options.want_exposure_map = options.want_exposures = true;
    options.num_exposures = 3;
    return options;
}

Outcome run(const ImageBuf& reference, const Images& tests, const HdrFlipOptions& options,
            int band_rows, ROI roi = {}) {
    Outcome out;
    FlipPlan plan = plan_hdr(options);
    plan.band_rows = band_rows;
    std::vector<ImageBuf> dst(tests.size());
    std::vector<ImageBuf*> to;
    for (ImageBuf& image : dst)
        to.push_back(&image);
    out.error =
        refusal([&] { run_flip(plan, reference, tests, to, roi, 0, out.maps, out.results); });
    return out;
}

void expect_same_side(const FlipSide& a, const FlipSide& b) {
    EXPECT_EQ(a.layer, b.layer);
    EXPECT_EQ(a.space, b.space);
    EXPECT_EQ(a.nonfinite, b.nonfinite);
    EXPECT_EQ(a.negative, b.negative);
    EXPECT_EQ(a.uncovered, b.uncovered);
}

void expect_same_summary(const FlipSummary& a, const FlipSummary& b) {
    expect_same_side(a.reference, b.reference);
    expect_same_side(a.test, b.test);
    for (const std::string& name : ToneAlgo::flip_quantities())
        EXPECT_EQ(*ToneAlgo::flip_quantity(a.pool, name), *ToneAlgo::flip_quantity(b.pool, name));
    EXPECT_EQ(a.pool.histogram, b.pool.histogram);
    EXPECT_EQ(a.nonfinite_both, b.nonfinite_both);
    EXPECT_EQ(a.exposures, b.exposures);
    EXPECT_EQ(a.max_luminance, b.max_luminance);
    EXPECT_EQ(a.median_luminance, b.median_luminance);
    EXPECT_EQ(a.alpha_mean, b.alpha_mean);
    EXPECT_EQ(a.alpha_max, b.alpha_max);
    EXPECT_EQ(a.alpha_max_x, b.alpha_max_x);
    EXPECT_EQ(a.alpha_max_y, b.alpha_max_y);
    EXPECT_EQ(a.warnings, b.warnings);
}

void expect_same(const Outcome& a, const Outcome& b) {
    ASSERT_EQ(a.error, "");
    ASSERT_EQ(b.error, "");
    ASSERT_EQ(a.maps.size(), b.maps.size());
    for (size_t t = 0; t < a.maps.size(); ++t) {
        EXPECT_EQ(a.maps[t].roi(), b.maps[t].roi());
        EXPECT_EQ(values(a.maps[t]), values(b.maps[t]));
        const FlipResult &r = a.results[t], &s = b.results[t];
        expect_same_summary(r.summary, s.summary);
        EXPECT_EQ(values(r.exposure_index), values(s.exposure_index));
        EXPECT_EQ(values(r.exposure_stops), values(s.exposure_stops));
        ASSERT_EQ(r.exposures.size(), s.exposures.size());
        for (size_t n = 0; n < r.exposures.size(); ++n) {
            EXPECT_EQ(values(r.exposures[n].flip), values(s.exposures[n].flip));
            EXPECT_EQ(values(r.exposures[n].reference), values(s.exposures[n].reference));
            EXPECT_EQ(values(r.exposures[n].test), values(s.exposures[n].test));
        }
    }
}

// Whatever the bands: the outcome of the whole.
void expect_bands_alike(const ImageBuf& reference, const Images& tests,
                        const HdrFlipOptions& options = all_maps(), ROI roi = {}) {
    const Outcome whole = run(reference, tests, options, 0, roi);
    for (int rows : {1, 7, 16, 40, 82, 500}) {
        SCOPED_TRACE(rows);
        expect_same(whole, run(reference, tests, options, rows, roi));
    }
}

ImageBuf picture(uint32_t seed, const std::vector<std::string>& channels = {"R", "G", "B"}) {
    return noise(make_spec(kWidth, kHeight, channels), seed);
}

// Holes on both sides of every band of 16 and 40 rows, of which some meet a hole of the other.
ImageBuf holed(ImageBuf image, int every, int shift) {
    for (int y : {0, 6, 7, 15, 16, 31, 32, 39, 40, 79, 80, kHeight - 1})
        for (int x = shift; x < kWidth; x += every)
            image.setpixel(x, y, std::vector<float>{1, kNan, 2}.data());
    return image;
}

TEST(Bands, OfImagesInMemory) {
    const auto reference = picture(1), test = disturbed(reference, 0.3, 2);
    expect_bands_alike(reference, {&test});
    HdrFlipOptions given = all_maps();
    given.start_exposure = -2;
    given.stop_exposure = 1;
    expect_bands_alike(reference, {&test}, given);
    given.ppd = 20;
    expect_bands_alike(reference, {&test}, given);
}

TEST(Bands, WithHolesAndNegativeValuesAtTheirSeams) {
    const auto clean = picture(3);
    const auto other = disturbed(clean, 0.3, 4);
    const auto reference = holed(scaled(clean, -1), 11, 1), holes = holed(other, 7, 1);
    expect_bands_alike(holed(clean, 11, 1), {&other});
    expect_bands_alike(clean, {&holes});
    HdrFlipOptions given = all_maps();
    given.start_exposure = -1;
    given.stop_exposure = 1;
    expect_bands_alike(reference, {&holes}, given);
    expect_bands_alike(holed(clean, 11, 1), {&holes, &other, &clean});
}

TEST(Bands, WithPixelsThatDoNotCount) {
    const auto clean = picture(3);
    const auto other = disturbed(clean, 0.3, 4);
    HdrFlipOptions some = all_maps();
    some.ignore = {"12x20+3+10", "40x1+0+15", "1x83+7+0"};
    expect_bands_alike(clean, {&other}, some);
    const auto holes = holed(other, 7, 1), reference = holed(clean, 11, 1);
    expect_bands_alike(reference, {&holes, &other, &clean}, some);
    expect_bands_alike(reference, {&holes}, some, ROI(2, 41, 5, 61));
}

TEST(Bands, WithoutADifferenceThatShows) {
    const auto reference = picture(5), shifted = scaled(reference, -0.5);
    HdrFlipOptions given;
    given.start_exposure = -1;
    given.stop_exposure = 1;
    expect_bands_alike(scaled(reference, -1), {&shifted}, given);
    const auto bright = scaled(reference, 1e6), brighter = scaled(reference, 2e6);
    expect_bands_alike(bright, {&brighter}, given);
}

TEST(Bands, WithAlpha) {
    const auto reference = picture(6, {"R", "G", "B", "A"});
    const auto test = disturbed(reference, 0.5, 7), none = picture(8);
    HdrFlipOptions options = all_maps();
    options.alpha = AlphaPolicy::Error;
    expect_bands_alike(reference, {&test, &none}, options);
}

TEST(Bands, WithWindowsAndRegions) {
    auto spec = make_spec(kWidth - 10, kHeight - 20, {"R", "G", "B"});
    spec.x = 4;
    spec.y = -5;
    spec.full_width = kWidth;
    spec.full_height = kHeight;
    auto inner = noise(spec, 9);
    inner.set_full(0, kWidth, 0, kHeight, 0, 1);
    const auto reference = picture(10), second = disturbed(reference, 0.2, 11);
    expect_bands_alike(reference, {&inner});
    expect_bands_alike(inner, {&reference, &second});
    for (const ROI& roi : {ROI(3, 30, 20, 61), ROI(0, 9, 0, 5), ROI(40, 99, 81, 99)})
        expect_bands_alike(reference, {&second, &reference}, all_maps(), roi);
}

TEST(Bands, OfFiles) {
    const Folder folder;
    const auto reference = picture(12), test = disturbed(reference, 0.3, 13);
    const FileLook looks[] = {{OIIO::TypeFloat, "none", 0}, {OIIO::TypeHalf, "zip", 0},
                              {OIIO::TypeHalf, "piz", 0},   {OIIO::TypeFloat, "zip", 16},
                              {OIIO::TypeHalf, "zips", 64}, {OIIO::TypeFloat, "dwab", 0}};
    for (const FileLook& look : looks) {
        SCOPED_TRACE(look.compression + std::to_string(look.tile));
        const auto a = write_file(folder / "a.exr", reference, look);
        const auto b = write_file(folder / "b.exr", test, look);
        const ImageBuf r = read_whole(a), t = read_whole(b);
        const UnreadFile file_r(a), file_t(b);
        const Outcome expected = run(r, {&t}, all_maps(), 0);
        for (int rows : {0, 1, 7, 16, 40})
            expect_same(expected, run(file_r.image, {&file_t.image}, all_maps(), rows));
        expect_same(expected, run(r, {&file_t.image}, all_maps(), 5));
        EXPECT_EQ(file_r.cached_bytes() + file_t.cached_bytes(), 0);
        OIIO::ImageCache::create()->invalidate_all(true);
    }
}

TEST(Bands, OfFilesThatAreReadFromTheFront) {
    const Folder folder;
    const auto reference = scaled(picture(14), 0.3), test = disturbed(reference, 0.3, 15);
    for (const char* extension : {"png", "tif", "jpg", "hdr"}) {
        SCOPED_TRACE(extension);
        const bool real = std::string(extension) == "hdr";
        const FileLook look{real ? OIIO::TypeFloat : OIIO::TypeUInt8, "zip", 0};
        const auto a = write_file(folder / ("a." + std::string(extension)), reference, look);
        const auto b = write_file(folder / ("b." + std::string(extension)), test, look);
        const ImageBuf r = read_whole(a), t = read_whole(b);
        const UnreadFile file_r(a), file_t(b);
        const Outcome expected = run(r, {&t}, all_maps(), 0);
        EXPECT_EQ(expected.results[0].summary.reference.space, real ? "rec709" : "srgb");
        for (int rows : {0, 7, 40})
            expect_same(expected, run(file_r.image, {&file_t.image}, all_maps(), rows));
    }
}

TEST(Bands, OfALayerAmongMany) {
    const Folder folder;
    std::vector<std::string> names;
    for (int i = 0; i < 40; ++i)
        for (const char* c : {"A", "B", "G", "R"})
            names.push_back("aov" + std::to_string(i) + "." + c);
    names.insert(names.begin() + 7, "R");
    names.push_back("B");
    names.insert(names.begin() + 90, "G");
    const auto reference = picture(16, names), test = disturbed(reference, 0.3, 17);
    const UnreadFile a(write_file(folder / "a.exr", reference));
    const UnreadFile b(write_file(folder / "b.exr", test));
    for (const char* layer : {"", "aov7"}) {
        HdrFlipOptions options = all_maps();
        options.pixels.layer = layer;
        options.alpha = *layer ? AlphaPolicy::Error : AlphaPolicy::Ignore;
        const Outcome expected = run(reference, {&test}, options, 0);
        for (int rows : {0, 16, 33})
            expect_same(expected, run(a.image, {&b.image}, options, rows));
    }
}

TEST(Bands, OfATestThatIsResized) {
    const Folder folder;
    const auto reference = picture(18), small = holed(noise(30, kHeight, 19), 9, 2);
    HdrFlipOptions options = all_maps();
    options.size = SizePolicy::Resize;
    expect_bands_alike(reference, {&small, &reference}, options);
    const UnreadFile file(write_file(folder / "small.exr", small));
    expect_same(run(reference, {&small}, options, 0), run(reference, {&file.image}, options, 20));
}

TEST(Bands, DoNotChangeWhatIsRefused) {
    const auto fine = picture(20), black = scaled(fine, 0);
    const auto holes = constant(kWidth, kHeight, {1, kNan, 1});
    HdrFlipOptions pole;
    pole.curve.coeffs = {0, 1, 0, 0, -1, 1};
    const struct {
        const ImageBuf &reference, &test;
        HdrFlipOptions options;
        const char* words;
    } cases[] = {{black, fine, {}, "reference is black"},
                 {holes, fine, {}, "the reference has no finite pixel"},
                 {fine, holes, {}, "the test has no finite pixel"},
                 {fine, fine, pole, "coeffs"}};
    for (const auto& c : cases)
        for (int rows : {0, 16}) {
            const Outcome out = run(c.reference, {&c.test}, c.options, rows);
            EXPECT_THAT(out.error, HasSubstr(c.words)) << rows;
            EXPECT_TRUE(out.maps.empty());
        }
}

} // namespace
} // namespace tonetool
