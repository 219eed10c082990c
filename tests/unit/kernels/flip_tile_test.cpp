// Lanes on every instruction set of this machine against the double twin.
#include "kernels/flip_tile.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>

#include "flip/filters.h"
#include "hdr_image.h"
#include "kernels/flip_twin.h"
#include "tonemap/rational.h"

namespace tonetool::kernels {
namespace {

// E ~ h^0.7 has infinite slope at 0: float noise in Lab becomes up to 1e-4 there.
constexpr double kSmallError = 0.01, kClose = 1e-5, kCloseBelow = 1e-4;
// Two instruction sets, each within kClose of the twin.
constexpr double kAmongTargets = 2e-5;

struct Target {
    explicit Target(int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        EXPECT_STREQ(flip_tile_target(), hwy::TargetName(target));
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
    ~Target() {
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

ToneCurve curve_of(const std::string& name) {
    return name == "ldr" ? ToneCurve{} : *tonemap::rational_curve(name);
}

struct Maps {
    std::vector<float> error, index;
};

// The image as one tile.
Maps run_lanes(const HdrImage& reference, const HdrImage& test, const FlipTaps<float>& taps,
               const ToneCurve& curve, const std::vector<double>& stops) {
    const TileShape shape(reference.width, reference.height, flip::reach(taps));
    const TilePixels r(shape, reference.view(), 0, 0), t(shape, test.view(), 0, 0);
    FlipTile tile(shape, taps);
    Planes fr(kFeaturePlanes, shape.stride, shape.height);
    Planes ft(kFeaturePlanes, shape.stride, shape.height);
    Planes best(2, shape.stride, shape.height);
    for (size_t n = 0; n < stops.size(); ++n) {
        const auto scale = float(std::exp2(stops[n]));
        tile.prepare(r, curve, scale, fr);
        tile.prepare(t, curve, scale, ft);
        tile.compare(fr, ft, float(n), best[0], best[1], nullptr);
    }
    Maps out;
    for (int y = 0; y < shape.height; ++y)
        for (int x = 0; x < shape.width; ++x) {
            out.error.push_back(best[0][y * shape.stride + x]);
            out.index.push_back(best[1][y * shape.stride + x]);
        }
    return out;
}

// One failure for a map, at its worst pixel.
template <typename T>
void expect_close(const std::vector<float>& ours, const std::vector<T>& expected, double close,
                  double close_below, const char* what) {
    ASSERT_EQ(ours.size(), expected.size());
    const auto share_of_bound = [&](size_t i) {
        return std::abs(double(ours[i]) - double(expected[i])) /
               (double(expected[i]) >= kSmallError ? close : close_below);
    };
    size_t worst = 0;
    for (size_t i = 1; i < ours.size(); ++i)
        if (!(share_of_bound(i) <= share_of_bound(worst)))
            worst = i;
    EXPECT_LE(share_of_bound(worst), 1.0) << what << ": pixel " << worst << " is " << ours[worst]
                                          << " instead of " << expected[worst];
}

struct Case {
    const char* curve;
    double ppd;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.curve << " at " << c.ppd;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
    return std::string(info.param.curve) + "_" + std::to_string(std::lround(info.param.ppd));
}

class Lanes : public testing::TestWithParam<Case> {
protected:
    const FlipTaps<double> m_exact = flip::make_taps(GetParam().ppd);
    const FlipTaps<float> m_taps = flip::float_taps(m_exact);
    const ToneCurve m_curve = curve_of(GetParam().curve);
    const std::vector<double> m_stops = GetParam().curve == std::string("ldr")
                                            ? std::vector<double>{0.0}
                                            : std::vector<double>{-4.5, -1.25, 0.3, 3.0};

    // One pair of images on every target: against the twin, and against the first target.
    void compare(const HdrImage& reference, const HdrImage& test) const {
        const auto expected =
            hdr_flip_twin(reference.view(), test.view(), m_exact, m_curve, m_stops, nullptr);
        std::vector<float> first;
        for (int64_t id : hwy::SupportedAndGeneratedTargets()) {
            SCOPED_TRACE(hwy::TargetName(id));
            const Target target(id);
            const auto ours = run_lanes(reference, test, m_taps, m_curve, m_stops).error;
            expect_close(ours, expected, kClose, kCloseBelow, "twin");
            if (first.empty())
                first = ours;
            expect_close(ours, first, kAmongTargets, kCloseBelow, "first target");
        }
    }
};

// Beside the lengths of vectors (4, 8, 16 lanes), and thinner than any filter.
constexpr int kSizes[][2] = {{1, 1}, {1, 19}, {23, 1}, {7, 5}, {33, 17}, {65, 40}};

TEST_P(Lanes, MatchTheTwin) {
    for (const auto& size : kSizes)
        for (Content content : {Content::Noise, Content::Gradient, Content::Patches}) {
            SCOPED_TRACE(testing::Message() << content << " " << size[0] << "x" << size[1]);
            const HdrImage reference = make_image(content, size[0], size[1], 11);
            compare(reference, disturbed(reference, 0.5, 12));
        }
}

TEST_P(Lanes, MatchTheTwinOnSlightDifferences) {
    for (double amount : {1e-2, 1e-4, 1e-6}) {
        SCOPED_TRACE(amount);
        const HdrImage reference = make_image(Content::Noise, 33, 17, 21);
        compare(reference, disturbed(reference, amount, 22));
    }
}

TEST_P(Lanes, MatchTheTwinOnUnrelatedImages) {
    for (Content content : {Content::Noise, Content::Gradient, Content::Patches}) {
        SCOPED_TRACE(content);
        compare(make_image(content, 33, 17, 31), make_image(Content::Noise, 33, 17, 32));
    }
}

// No edge and no point in a flat image: what the detectors find there is rounding alone, and its
// root multiplies into the error.
TEST_P(Lanes, MatchTheTwinOnFlatImages) {
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
    for (int64_t id : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(id));
        const Target target(id);
        for (Content content : {Content::Noise, Content::Gradient, Content::Patches}) {
            const HdrImage image = make_image(content, 37, 11, 41);
            const Maps maps = run_lanes(image, image, m_taps, m_curve, m_stops);
            EXPECT_EQ(maps.error, std::vector<float>(image.size(), 0.0f));
            EXPECT_EQ(maps.index, std::vector<float>(image.size(), 0.0f));
        }
    }
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

TEST(TilePixels, ReplicateTheBorder) {
    const HdrImage image = make_image(Content::Noise, 9, 6, 51);
    // Tiles that lie inside, hang over each side, or see nothing but a replicated edge.
    const Window tiles[] = {{0, 0, 9, 6}, {3, 2, 2, 2}, {7, 4, 2, 2}, {0, 5, 9, 1}, {8, 0, 1, 6}};
    for (const Window& w : tiles)
        for (int halo : {0, 1, 4, 13}) {
            const TileShape shape(w.width, w.height, halo);
            const TilePixels tile(shape, image.view(), w.x0, w.y0);
            for (int c = 0; c < 3; ++c)
                for (int y = 0; y < shape.padded_height(); ++y)
                    for (int x = 0; x < shape.padded_width(); ++x) {
                        const int sx = std::clamp(w.x0 - halo + x, 0, 8);
                        const int sy = std::clamp(w.y0 - halo + y, 0, 5);
                        ASSERT_EQ(tile.rgb[c][y * shape.padded_stride + x],
                                  image.plane[c][size_t(sy * 9 + sx)])
                            << "tile " << w.x0 << "," << w.y0 << " halo " << halo << " at " << x
                            << "," << y;
                    }
        }
}

TEST(TilePixels, SameAsSeesEveryBit) {
    HdrImage image = make_image(Content::Patches, 9, 6, 52);
    image.plane[1][7] = 0.0f;
    const TileShape shape(4, 4, 3);
    const TilePixels tile(shape, image.view(), 1, 1);
    EXPECT_TRUE(tile.same_as(TilePixels(shape, image.view(), 1, 1)));
    HdrImage other = image;
    other.plane[2][0] = std::nextafter(other.plane[2][0], 100.0f); // in the halo
    EXPECT_FALSE(tile.same_as(TilePixels(shape, other.view(), 1, 1)));
}

TEST(ToneMapPixels, MatchTheTwinForEveryCount) {
    const HdrImage image = make_image(Content::Noise, 40, 1, 61);
    for (int64_t id : hwy::SupportedAndGeneratedTargets())
        for (const char* name : {"ldr", "aces", "hable", "reinhard"}) {
            SCOPED_TRACE(std::string(name) + " " + hwy::TargetName(id));
            const Target target(id);
            const ToneCurve curve = curve_of(name);
            const TwinImage expected = tone_map_twin(image.view(), curve, 1.25);
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
    for (int64_t id : hwy::SupportedAndGeneratedTargets())
        for (const char* name : {"ldr", "aces", "hable", "reinhard"}) {
            SCOPED_TRACE(std::string(name) + " " + hwy::TargetName(id));
            const Target target(id);
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
}

TEST(HugeValues, DifferFromBlackAsWhiteDoes) {
    const auto taps = flip::float_taps(flip::make_taps(67));
    HdrImage huge(5, 5), white(5, 5);
    const HdrImage black(5, 5);
    for (int c = 0; c < 3; ++c) {
        huge.plane[c].assign(25, FLT_MAX);
        white.plane[c].assign(25, 1e9f);
    }
    for (int64_t id : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(id));
        const Target target(id);
        const ToneCurve aces = curve_of("aces");
        const auto of_huge = run_lanes(black, huge, taps, aces, {0, 4}).error;
        EXPECT_EQ(of_huge, run_lanes(black, white, taps, aces, {0, 4}).error);
        EXPECT_NEAR(of_huge[12], 0.9673883, 1e-5); // published: black against white
    }
}

TEST(FlipTile, CompareRaisesTheMaximumStrictly) {
    const auto taps = flip::float_taps(flip::make_taps(20));
    const HdrImage a = make_image(Content::Noise, 19, 6, 71), b = disturbed(a, 0.5, 72);
    const ToneCurve aces = curve_of("aces");
    const Maps once = run_lanes(a, b, taps, aces, {1.0});
    const Maps repeated = run_lanes(a, b, taps, aces, {1.0, 1.0, 1.0});
    EXPECT_EQ(once.error, repeated.error);
    EXPECT_EQ(once.index, repeated.index) << "the first exposure wins ties";
}

} // namespace
} // namespace tonetool::kernels
