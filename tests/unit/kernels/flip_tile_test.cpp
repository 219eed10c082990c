// SPDX-License-Identifier: BSD-3-Clause
// Lanes on every instruction set of this machine against the double-precision reference
// implementation.
#include "kernels/flip_tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>

#include "flip/filters.h"
#include "hdr_image.h"
#include "kernels/flip_reference.h"
#include "oracle.h"
#include "target.h"
#include "tonemap/rational.h"

namespace tonetool::kernels {
namespace {

struct Maps {
    std::vector<float> error, index;
};

// The image as one tile, or as much of it as `window` holds.
Maps run_lanes(const HdrImage& reference, const HdrImage& test, const FlipTaps<double>& taps,
               const ToneCurve& curve, const std::vector<double>& stops, Window window = {}) {
    if (window.width == 0)
        window = {0, 0, reference.width, reference.height};
    const FlipRows& functions = flip_rows();
    const LaneTaps lane_taps = flip::lane_taps(taps);
    const TileShape shape(functions.lanes, window.width, window.height,
                          flip::filter_radius(lane_taps));
    FlipTile tile(functions, shape, lane_taps, 1, false);
    const ConstRgb r = reference.view(), t = test.view();
    tile.load(window, r, {&t});
    for (size_t n = 0; n < stops.size(); ++n)
        tile.expose(curve, float(std::exp2(stops[n])), float(n));
    const size_t pixels = size_t(window.width) * size_t(window.height);
    Maps out{std::vector<float>(pixels, -1.0f), std::vector<float>(pixels, -1.0f)};
    tile.store(0, FlipTile::kError, out.error.data(), window.width);
    tile.store(0, FlipTile::kIndex, out.index.data(), window.width);
    return out;
}

class Lanes : public testing::TestWithParam<Case> {
protected:
    const FlipTaps<double> m_exact = flip::make_taps(GetParam().ppd);
    const ToneCurve m_curve = curve_of(GetParam().curve);
    const std::vector<double> m_stops = GetParam().curve == std::string("ldr")
                                            ? std::vector<double>{0.0}
                                            : std::vector<double>{-4.5, -1.25, 0.3, 3.0};

    // One pair of images on every target: against the reference implementation, and against the
    // first target.
    void compare(const HdrImage& reference, const HdrImage& test) const {
        const auto expected =
            hdr_flip_reference(reference.view(), test.view(), m_exact, m_curve, m_stops, nullptr);
        std::vector<float> first;
        on_every_target([&] {
            const auto ours = run_lanes(reference, test, m_exact, m_curve, m_stops).error;
            expect_close(ours, expected, kClose, kCloseBelow, "reference implementation");
            if (first.empty())
                first = ours;
            expect_close(ours, first, kAmongTargets, kCloseBelow, "first target");
        });
    }
};

// Beside the lengths of vectors (4, 8, 16 lanes), and thinner than any filter.
constexpr int kSizes[][2] = {{1, 1}, {1, 19}, {23, 1}, {7, 5}, {33, 17}, {65, 40}};

TEST_P(Lanes, MatchTheReferenceImplementation) {
    for (const auto& size : kSizes)
        for (Content content : {Content::Noise, Content::Gradient, Content::Patches}) {
            SCOPED_TRACE(testing::Message() << content << " " << size[0] << "x" << size[1]);
            const HdrImage reference = make_image(content, size[0], size[1], 11);
            compare(reference, disturbed(reference, 0.5, 12));
        }
}

TEST_P(Lanes, MatchTheReferenceImplementationOnSlightDifferences) {
    for (double amount : {1e-2, 1e-4, 1e-6}) {
        SCOPED_TRACE(amount);
        const HdrImage reference = make_image(Content::Noise, 33, 17, 21);
        compare(reference, disturbed(reference, amount, 22));
    }
}

TEST_P(Lanes, MatchTheReferenceImplementationOnUnrelatedImages) {
    for (Content content : {Content::Noise, Content::Gradient, Content::Patches}) {
        SCOPED_TRACE(content);
        compare(make_image(content, 33, 17, 31), make_image(Content::Noise, 33, 17, 32));
    }
}

// No edge and no point in a flat image: what the detectors find there is rounding alone, and its
// root multiplies into the error.
TEST_P(Lanes, MatchTheReferenceImplementationOnFlatImages) {
    const double colors[][3] = {{0.18, 0.18, 0.18}, {0.3, 0.6, 0.1}, {0.9, 0.05, 0.4}, {2, 1, 4}};
    for (const auto& color : colors) {
        SCOPED_TRACE(testing::PrintToString(color));
        HdrImage reference(45, 30), test(45, 30);
        for (int c = 0; c < 3; ++c) {
            reference.plane[c].assign(reference.size(), float(color[c]));
            test.plane[c].assign(test.size(), float(color[(c + 1) % 3] * 0.75));
        }
        compare(reference, test);
    }
}

TEST_P(Lanes, IdenticalImagesAreExactlyZero) {
    on_every_target([&] {
        for (Content content : {Content::Noise, Content::Gradient, Content::Patches}) {
            const HdrImage image = make_image(content, 37, 11, 41);
            const Maps maps = run_lanes(image, image, m_exact, m_curve, m_stops);
            EXPECT_EQ(maps.error, std::vector<float>(image.size(), 0.0f));
            EXPECT_EQ(maps.index, std::vector<float>(image.size(), 0.0f));
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Curves, Lanes,
                         testing::Values(Case{"ldr", 20}, Case{"ldr", 67.02}, Case{"ldr", 134},
                                         Case{"ldr", 200}, Case{"aces", 20}, Case{"aces", 67.02},
                                         Case{"aces", 134}, Case{"aces", 200}, Case{"hable", 20},
                                         Case{"hable", 67.02}, Case{"hable", 134},
                                         Case{"hable", 200}, Case{"reinhard", 20},
                                         Case{"reinhard", 67.02}, Case{"reinhard", 134},
                                         Case{"reinhard", 200}),
                         name_of);

// Tiles that lie inside, hang over each side, or are smaller than their halo.
TEST(FlipTile, WindowsGiveTheBitsOfTheWhole) {
    const HdrImage image = make_image(Content::Noise, 41, 26, 51),
                   other = disturbed(image, 0.4, 52);
    const auto taps = flip::make_taps(45);
    const ToneCurve aces = curve_of("aces");
    const Window windows[] = {
        {13, 8, 11, 9}, {0, 0, 5, 26}, {37, 20, 4, 6}, {0, 25, 41, 1}, {40, 0, 1, 26}};
    on_every_target([&] {
        const Maps whole = run_lanes(image, other, taps, aces, {-1, 2});
        for (const Window& w : windows) {
            const Maps part = run_lanes(image, other, taps, aces, {-1, 2}, w);
            for (int y = 0; y < w.height; ++y)
                for (int x = 0; x < w.width; ++x) {
                    const auto i = size_t((w.y0 + y) * 41 + w.x0 + x), k = size_t(y * w.width + x);
                    ASSERT_EQ(part.error[k], whole.error[i])
                        << w.x0 << "+" << x << "," << w.y0 << "+" << y;
                    ASSERT_EQ(part.index[k], whole.index[i]);
                }
        }
    });
}

TEST(FlipTile, ForgetsTheTileBefore) {
    const HdrImage a = make_image(Content::Noise, 30, 20, 53), b = disturbed(a, 0.5, 54);
    const HdrImage same = make_image(Content::Patches, 30, 20, 55);
    const LaneTaps taps = flip::lane_taps(flip::make_taps(30));
    const ToneCurve aces = curve_of("aces");
    const TileShape shape(flip_rows().lanes, 30, 20, flip::filter_radius(taps));
    FlipTile tile(flip_rows(), shape, taps, 2, true);
    const ConstRgb ra = a.view(), rb = b.view(), rs = same.view();
    const auto planes = [&tile](size_t test, FlipTile::ResultPlane plane) {
        std::vector<float> out(600, -1.0f);
        tile.store(test, plane, out.data(), 30);
        return out;
    };
    tile.load({0, 0, 30, 20}, ra, {&rb, &ra});
    tile.expose(aces, 1.0f, 3);
    const auto error = planes(0, FlipTile::kError);
    EXPECT_EQ(planes(0, FlipTile::kLastError), error);
    EXPECT_EQ(planes(1, FlipTile::kError), std::vector<float>(600, 0.0f));
    EXPECT_EQ(planes(1, FlipTile::kLastError), std::vector<float>(600, 0.0f));
    // A smaller one of other images, then the first one again, among the tests in another place.
    tile.load({3, 2, 7, 5}, rs, {&rs});
    tile.expose(aces, 2.0f, 1);
    tile.load({0, 0, 30, 20}, ra, {&ra, &rb});
    tile.expose(aces, 1.0f, 3);
    EXPECT_EQ(planes(0, FlipTile::kError), std::vector<float>(600, 0.0f));
    EXPECT_EQ(planes(1, FlipTile::kError), error);
}

TEST(SamePixels, SeesEveryBitWithinTheHalo) {
    HdrImage image = make_image(Content::Patches, 9, 6, 52);
    image.plane[1][7] = 0.0f;
    const Window tile{1, 1, 4, 4};
    EXPECT_TRUE(same_pixels(image.view(), image.view(), tile, 3));
    HdrImage other = image;
    other.plane[2][0] = std::nextafter(other.plane[2][0], 100.0f);
    EXPECT_FALSE(same_pixels(image.view(), other.view(), tile, 3));
    EXPECT_TRUE(same_pixels(image.view(), other.view(), {4, 4, 2, 1}, 3)) << "out of reach";
    other = image;
    other.plane[0][7] = -other.plane[0][7]; // column 7: the last one that a halo of 3 reaches
    EXPECT_FALSE(same_pixels(image.view(), other.view(), tile, 3));
    EXPECT_TRUE(same_pixels(image.view(), other.view(), tile, 2));
}

TEST(Transpose, TransposesOnEveryTarget) {
    on_every_target([] {
        const ptrdiff_t lanes = flip_rows().lanes;
        for (ptrdiff_t strip : {4, 8, 12, 44}) {
            std::vector<float> in(size_t(lanes * strip)), out(in.size()), back(in.size());
            for (size_t i = 0; i < in.size(); ++i)
                in[i] = float(i);
            flip_rows().transpose(in.data(), lanes, strip, out.data());
            for (ptrdiff_t l = 0; l < lanes; ++l)
                for (ptrdiff_t v = 0; v < strip; ++v)
                    ASSERT_EQ(out[size_t(v * lanes + l)], float(l * strip + v));
            flip_rows().transpose(out.data(), strip, lanes, back.data());
            EXPECT_EQ(back, in);
        }
    });
}

TEST(ToneMapPixels, MatchTheReferenceImplementationForEveryCount) {
    const HdrImage image = make_image(Content::Noise, 40, 1, 61);
    on_every_target([&] {
        for (const char* name : {"ldr", "aces", "hable", "reinhard"}) {
            SCOPED_TRACE(name);
            const ToneCurve curve = curve_of(name);
            const PlaneImage expected = tone_map_reference(image.view(), curve, 1.25);
            for (int count = 1; count <= 40; ++count) {
                HdrImage out(41, 1);
                float* to[3] = {out.plane[0].data(), out.plane[1].data(), out.plane[2].data()};
                for (auto& p : out.plane)
                    p[size_t(count)] = -7.0f;
                tone_map_pixels(image.view().plane, to, count, curve, float(std::exp2(1.25)));
                for (int c = 0; c < 3; ++c) {
                    EXPECT_EQ(out.plane[c][size_t(count)], -7.0f) << "written past the end";
                    for (size_t i = 0; i < size_t(count); ++i) // ten roundings of 2^-24
                        ASSERT_NEAR(out.plane[c][i], expected.plane[c][i], 6e-7);
                }
            }
        }
    });
}

TEST(ToneMapPixels, MatchTheReferenceImplementationAtAnyExposure) {
    const HdrImage image = make_image(Content::Noise, 32, 1, 63);
    on_every_target([&] {
        for (const char* name : {"aces", "hable", "reinhard"}) {
            const ToneCurve curve = curve_of(name);
            const PlaneImage expected = tone_map_reference(image.view(), curve, 0);
            for (int stops : {-90, -31, -29, -10, 10, 29, 31, 90}) {
                SCOPED_TRACE(testing::Message() << name << " at " << stops << " stops");
                HdrImage far = image, out(32, 1);
                for (auto& p : far.plane)
                    for (float& v : p)
                        v = std::ldexp(v, -stops);
                float* to[3] = {out.plane[0].data(), out.plane[1].data(), out.plane[2].data()};
                tone_map_pixels(far.view().plane, to, 32, curve, std::ldexp(1.0f, stops));
                for (int c = 0; c < 3; ++c)
                    for (size_t i = 0; i < 32; ++i)
                        ASSERT_NEAR(out.plane[c][i], expected.plane[c][i], 6e-7);
            }
        }
    });
}

TEST(ToneMapPixels, MayWorkInPlace) {
    const HdrImage image = make_image(Content::Noise, 29, 1, 62);
    HdrImage out(29, 1), in_place = image;
    float* to[3] = {out.plane[0].data(), out.plane[1].data(), out.plane[2].data()};
    float* same[3] = {in_place.plane[0].data(), in_place.plane[1].data(), in_place.plane[2].data()};
    const ToneCurve curve = curve_of("reinhard");
    tone_map_pixels(image.view().plane, to, 29, curve, 0.5f);
    tone_map_pixels(same, same, 29, curve, 0.5f);
    for (int c = 0; c < 3; ++c)
        EXPECT_EQ(out.plane[c], in_place.plane[c]);
}

TEST(HugeValues, SaturateToWhite) {
    HdrImage pixels(3, 1);
    for (auto& p : pixels.plane)
        p = {1e30f, FLT_MAX, 1e6f};
    on_every_target([&] {
        for (const char* name : {"ldr", "aces", "hable", "reinhard"}) {
            SCOPED_TRACE(name);
            HdrImage out(3, 1);
            float* to[3] = {out.plane[0].data(), out.plane[1].data(), out.plane[2].data()};
            for (double stops : {-3.0, 0.0, 20.0, 127.0}) {
                tone_map_pixels(pixels.view().plane, to, 3, curve_of(name),
                                float(std::exp2(stops)));
                for (const auto& p : out.plane)
                    for (float v : p) // 1 - 1/(1 + 1e6/8) is the least of them
                        EXPECT_NEAR(v, 1.0f, 1e-5f) << "at " << stops << " stops";
            }
        }
    });
}

TEST(HugeValues, DifferFromBlackAsWhiteDoes) {
    const auto taps = flip::make_taps(67);
    HdrImage huge(5, 5), white(5, 5);
    const HdrImage black(5, 5);
    for (int c = 0; c < 3; ++c) {
        huge.plane[c].assign(25, FLT_MAX);
        white.plane[c].assign(25, 1e9f);
    }
    on_every_target([&] {
        const ToneCurve aces = curve_of("aces");
        const auto of_huge = run_lanes(black, huge, taps, aces, {0, 4}).error;
        EXPECT_EQ(of_huge, run_lanes(black, white, taps, aces, {0, 4}).error);
        EXPECT_NEAR(of_huge[12], 0.9673883, 1e-5); // published: black against white
    });
}

TEST(FlipTile, CompareRaisesTheMaximumStrictly) {
    const auto taps = flip::make_taps(20);
    const HdrImage a = make_image(Content::Noise, 19, 6, 71), b = disturbed(a, 0.5, 72);
    const ToneCurve aces = curve_of("aces");
    const Maps once = run_lanes(a, b, taps, aces, {1.0});
    const Maps repeated = run_lanes(a, b, taps, aces, {1.0, 1.0, 1.0});
    EXPECT_EQ(once.error, repeated.error);
    EXPECT_EQ(once.index, repeated.index) << "the first exposure wins ties";
}

} // namespace
} // namespace tonetool::kernels
