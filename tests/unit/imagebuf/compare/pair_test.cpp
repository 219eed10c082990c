// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/compare/pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "images.h"
#include "refusal.h"

namespace tonetool {
namespace {

using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

ImageBuf window(ROI data, ROI display) {
    auto spec = make_spec(data.width(), data.height(), {"R", "G", "B"});
    spec.x = data.xbegin;
    spec.y = data.ybegin;
    spec.full_x = display.xbegin;
    spec.full_y = display.ybegin;
    spec.full_width = display.width();
    spec.full_height = display.height();
    return noise(spec, 1);
}

ROI rect(int x0, int x1, int y0, int y1) {
    return {x0, x1, y0, y1, 0, 1, 0, 1};
}

TEST(ComparedRegion, IsTheUnionOfTheDataWindows) {
    const ROI display = rect(0, 10, 0, 10);
    EXPECT_EQ(compared_region(window(rect(1, 4, 2, 5), display), window(rect(3, 9, -2, 3), display),
                              SizePolicy::Match),
              rect(1, 9, -2, 5));
}

TEST(ComparedRegion, DifferentDisplayWindowsAreAnError) {
    const std::string error = refusal([] {
        compared_region(window(rect(0, 10, 0, 8), rect(0, 10, 0, 8)),
                        window(rect(0, 10, 0, 8), rect(-1, 10, 2, 8)), SizePolicy::Match);
    });
    for (const char* word : {"10x8+0+0", "11x6-1+2", "resize=", "crop="})
        EXPECT_THAT(error, HasSubstr(word));
}

TEST(ComparedRegion, CropTakesTheCommonDisplayWindow) {
    EXPECT_EQ(compared_region(window(rect(0, 10, 0, 8), rect(0, 10, 0, 8)),
                              window(rect(4, 20, 3, 20), rect(4, 20, 3, 20)), SizePolicy::Crop),
              rect(4, 10, 3, 8));
    const std::string error = refusal([] {
        compared_region(window(rect(0, 4, 0, 4), rect(0, 4, 0, 4)),
                        window(rect(4, 8, 0, 4), rect(4, 8, 0, 4)), SizePolicy::Crop);
    });
    EXPECT_THAT(error, HasSubstr("4x4+0+0 and 4x4+4+0 do not overlap"));
}

TEST(MendNonfinite, TakesTheOtherImagesPixel) {
    const auto clean = noise(4, 1, 1), other = noise(4, 1, 2);
    const auto r = with_pixel(with_pixel(clean, 0, 0, {kNan, 1, 1}), 2, 0, {1, kNan, 1});
    const auto t = with_pixel(with_pixel(other, 1, 0, {1, 1, kNan}), 2, 0, {kNan, 1, 1});
    ColorPlanes pr = read_planes(r, {}, r.roi(), false, 1);
    ColorPlanes pt = read_planes(t, {}, t.roi(), false, 1);
    const NonfiniteBoth both = substitute_nonfinite(pr, pt, 0, 1);
    EXPECT_EQ(both.alike, 0);
    EXPECT_EQ(both.unlike, 1) << "NaN in another component";
    for (int p = 0; p < 3; ++p) {
        EXPECT_EQ(pr.plane[p][0], pt.plane[p][0]);
        EXPECT_EQ(pr.plane[p][0], pixel_of(other, 0, 0)[size_t(p)]);
        EXPECT_EQ(pt.plane[p][1], pixel_of(clean, 1, 0)[size_t(p)]);
        EXPECT_EQ(pr.plane[p][2], 0.0f);
        EXPECT_EQ(pt.plane[p][2], 0.0f);
        EXPECT_EQ(pr.plane[p][3], pixel_of(clean, 3, 0)[size_t(p)]);
    }
}

// One pixel that is non-finite in both images.
NonfiniteBoth both_of(std::vector<float> in_reference, std::vector<float> in_test,
                      const std::string& space = "") {
    const auto r = with_pixel(noise(4, 1, 1), 2, 0, std::move(in_reference));
    const auto t = with_pixel(noise(4, 1, 2), 2, 0, std::move(in_test));
    ColorPlanes pr = read_planes(r, {}, r.roi(), false, 1);
    ColorPlanes pt = read_planes(t, {"", space}, t.roi(), false, 1);
    return substitute_nonfinite(pr, pt, 0, 1);
}

TEST(MendNonfinite, TellsKindsAndTheOtherComponents) {
    const float inf = std::numeric_limits<float>::infinity();
    const struct {
        std::vector<float> reference, test;
        bool alike;
    } cases[] = {{{inf, 1, 1}, {inf, 1, 1}, true},
                 {{kNan, kNan, kNan}, {kNan, kNan, kNan}, true},
                 {{-inf, 0, 0.1f}, {-inf, 0, 0.1f}, true},
                 {{inf, 0.1f, 1}, {inf, 0.0999755859375f, 1}, true}, // rounded to half
                 {{inf, 1, 1}, {kNan, 1, 1}, false},
                 {{inf, 1, 1}, {-inf, 1, 1}, false},
                 {{inf, 1, 1}, {1, inf, 1}, false},
                 {{inf, 1, 1}, {inf, inf, 1}, false},
                 {{inf, 1, 1}, {inf, 1.001f, 1}, false},
                 {{1, 2, kNan}, {1, 2.5f, kNan}, false}};
    for (const auto& c : cases) {
        const NonfiniteBoth found = both_of(c.reference, c.test);
        EXPECT_EQ(found.alike, c.alike ? 1 : 0);
        EXPECT_EQ(found.unlike, c.alike ? 0 : 1);
    }
    EXPECT_EQ(both_of({inf, 1, 1}, {inf, 2, 2}, "acescg").alike, 1) << "not of one space";
}

TEST(CheckOrientation, PicturesTurnedAlikeGoTogether) {
    const auto turned = [](int tag) {
        auto spec = make_spec(4, 4, {"R", "G", "B"});
        if (tag != 0)
            spec.attribute("Orientation", tag);
        return constant(spec, {1, 1, 1});
    };
    for (const auto& [r, t] : {std::pair(0, 0), {0, 1}, {1, 0}, {6, 6}, {3, 3}})
        EXPECT_NO_THROW(check_orientation(turned(r), turned(t))) << r << "," << t;
    for (const auto& [r, t] : {std::pair(0, 3), {6, 1}, {2, 4}, {8, 0}})
        EXPECT_THROW(check_orientation(turned(r), turned(t)), Refusal) << r << "," << t;
    EXPECT_THAT(refusal([&] { check_orientation(turned(8), turned(0)); }),
                HasSubstr("the Orientation of the reference is 8, that of the test 1"));
    FittedTest fitted;
    EXPECT_THROW(fitted.open(turned(1), turned(6), {}, 1), Refusal);
}

ColorPlanes read(const FittedTest& fitted, bool alpha) {
    ColorReader reader;
    fitted.open_reader(alpha, 1, reader);
    ColorPlanes planes = fitted.planes(reader);
    reader.read(fitted.region().ybegin, fitted.region().yend, planes);
    return planes;
}

PairOptions with_size(SizePolicy size) {
    PairOptions options;
    options.size = size;
    return options;
}

TEST(FittedTest, ResizesToTheReferencesDisplayWindow) {
    const auto reference = noise(20, 10, 1);
    const auto test =
        constant(make_spec(10, 5, {"Z", "B", "G", "R", "A"}), {9, 0.25f, 0.5f, 0.75f, 0.5f});
    FittedTest fitted;
    PairOptions options = with_size(SizePolicy::Resize);
    options.alpha = AlphaPolicy::Error;
    fitted.open(reference, test, options, 1);
    EXPECT_EQ(fitted.region(), rect(0, 20, 0, 10));
    const ColorPlanes planes = read(fitted, true);
    const float expected[3] = {0.75f, 0.5f, 0.25f};
    for (int p = 0; p < 3; ++p)
        for (float v : planes.plane[p]) // filter weights of a constant sum to 1 within rounding
            EXPECT_NEAR(v, expected[p], 1e-6);
    for (float a : planes.alpha)
        EXPECT_NEAR(a, 0.5, 1e-6);
}

TEST(FittedTest, ResizeKeepsTheColorSpace) {
    auto spec = make_spec(6, 6, {"R", "G", "B"});
    spec.attribute("oiio:ColorSpace", "acescg");
    const auto test = constant(spec, {0.2f, 0.5f, 0.1f});
    FittedTest fitted;
    fitted.open(noise(12, 12, 1), test, with_size(SizePolicy::Resize), 1);
    const ColorPlanes resized = read(fitted, false);
    const ColorPlanes plain = read_planes(test, {}, test.roi(), false, 1);
    for (int p = 0; p < 3; ++p)
        EXPECT_NEAR(resized.plane[p][70], plain.plane[p][0], 1e-6); // resampling's rounding
    EXPECT_EQ(resized.choice.space, "acescg");
}

TEST(FittedTest, ResizeKeepsAHoleWhereItIs) {
    auto test = constant(8, 8, {0.2f, 0.5f, 0.1f});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float hole[3] = {0.2f, nan, 0.1f};
    test.setpixel(3, 4, hole);
    FittedTest fitted;
    fitted.open(noise(16, 16, 1), test, with_size(SizePolicy::Resize), 1);
    const ColorPlanes planes = read(fitted, false);
    EXPECT_EQ(planes.counts.nonfinite, 4);
    for (size_t i = 0; i < planes.nonfinite.size(); ++i) {
        const size_t x = i % 16, y = i / 16;
        EXPECT_EQ(planes.nonfinite[i] != 0, x / 2 == 3 && y / 2 == 4) << x << "," << y;
        if (!planes.nonfinite[i])
            EXPECT_NEAR(planes.plane[1][i], 0.5, 1e-6); // filter weights sum to 1 within rounding
    }
}

} // namespace
} // namespace tonetool
