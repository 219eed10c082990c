// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/shot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace tonetool::tonemap {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
// The goldens have seven digits.
constexpr double kDigits = 1e-6;

FrameLight light(int number, double lwa, const std::string& view = "") {
    FrameLight out;
    out.frame = number;
    out.view = view;
    out.lwa = lwa;
    out.lwa_geometric = lwa / 2;
    out.lmax = 10 * lwa;
    out.maximum = 20 * lwa;
    out.counted = lwa > 0 ? 100 : 0;
    out.histogram.assign(kLightBins, 0);
    out.thumbnail.assign(size_t(kThumbnailWidth) * size_t(kThumbnailHeight), 0);
    return out;
}

std::vector<ShotFrame> frames(const std::vector<double>& lwa, int first = 1) {
    std::vector<FrameLight> lights;
    for (size_t i = 0; i < lwa.size(); ++i)
        lights.push_back(light(first + int(i), lwa[i]));
    std::vector<ShotFrame> out = frames_of(lights, {});
    for (ShotFrame& frame : out)
        frame.light = nullptr; // the lights are gone
    return out;
}

void expect_lwa(const std::vector<ShotFrame>& scene, const AdaptTerms& terms,
                const std::vector<double>& wanted) {
    for (size_t i = 0; i < scene.size(); ++i)
        EXPECT_NEAR(adapted(scene, i, terms).lwa / wanted[i], 1, kDigits) << i;
}

// golden/shot/shot.json: 0.1 for three frames, then 10, at 24 frames per second.
const std::vector<double> kStep{.1, .1, .1, 10, 10, 10, 10, 10, 10, 10, 10, 10};

TEST(Shot, EyesFollowAStepLate) {
    expect_lwa(frames(kStep), {"eye", {}, 24, {}, false},
               {.1, .1, .1, .4731667, 1.324971, 2.621005, 4.1185, 5.556066, 6.775014, 7.726436,
                8.429213, 8.92965});
}

TEST(Shot, SmoothIsAsFarBeforeAStepAsBehindIt) {
    const auto scene = frames(kStep);
    const AdaptTerms terms{"smooth", {}, 24, {}, false};
    expect_lwa(scene, terms,
               {1.768851, 1.910273, 2.201269, 2.698552, 3.165649, 3.593435, 3.976316, 4.310531,
                4.592798, 4.819081, 4.983152, 5.074481});
    auto back = kStep;
    std::reverse(back.begin(), back.end());
    const auto turned = frames(back);
    for (size_t i = 0; i < scene.size(); ++i)
        EXPECT_NEAR(adapted(turned, scene.size() - 1 - i, terms).lwa, adapted(scene, i, terms).lwa,
                    1e-12);
}

// golden/shot/shot.json, of the animation.
const std::vector<double> kAnim{.15263,   .1548102, .1529201, .150432,
                                .1433307, .1422502, .13531,   .1398778};

TEST(Shot, TheAnimationHasOneExposure) {
    const auto scene = frames(kAnim);
    for (size_t i = 0; i < scene.size(); ++i) {
        const ShotFrame found = adapted(scene, i, {});
        EXPECT_NEAR(found.lwa, 0.1462899, 1e-7);
        EXPECT_DOUBLE_EQ(found.lmax, 1.548102) << "the largest";
    }
    expect_lwa(scene, {"eye", {}, 24, {}, false},
               {.15263, .1531228, .1530769, .1524763, .150391, .1485431, .1455367, .1442659});
    expect_lwa(scene, {"eye", 0.4, 24, {}, false},
               {.15263, .1528443, .1528518, .1526107, .1516665, .1507079, .1491096, .1481698});
    expect_lwa(scene, {"smooth", 0.4, 24, {}, false},
               {.1477398, .1475762, .1472009, .146672, .1460382, .1454823, .1450019, .1448303});
}

TEST(Shot, MissingFramesCountInTime) {
    std::vector<FrameLight> lights{light(1, 1), light(4, 2)};
    const auto scene = frames_of(lights, {});
    const double share = 1 - std::exp(-3.0 / 24 / 0.4);
    EXPECT_NEAR(adapted(scene, 1, {"eye", 0.4, 24, {}, false}).lwa, std::exp2(share), 1e-12);
    EXPECT_NEAR(adapted(scene, 1, {"eye", 0.4, 24, {}, true}).lwa, 1 + share, 1e-12)
        << "luminance, not its logarithm";
}

// Krawczyk et al. (2005): golden/shot/numbers.json.
TEST(Shot, RodsAreSlowerThanCones) {
    EXPECT_DOUBLE_EQ(eye_time(0), 0.4);
    EXPECT_DOUBLE_EQ(eye_time(0.04), 0.25);
    EXPECT_NEAR(eye_time(1), 0.1115385, 1e-7);
    EXPECT_LT(eye_time(100), 0.1002);
    // A unit of 1000 cd/m2 makes day of the same picture.
    const auto scene = frames({.01, .02});
    const AdaptTerms night{"eye", {}, 24, {}, false}, day{"eye", {}, 24, 1000.0, false};
    EXPECT_LT(adapted(scene, 1, night).lwa, adapted(scene, 1, day).lwa);
}

TEST(Shot, BlackFramesLeaveTheExposureToTheOthers) {
    const auto scene = frames({0, 2, 0, 8, 0});
    for (size_t i = 0; i < scene.size(); ++i)
        EXPECT_NEAR(adapted(scene, i, {}).lwa, 4, 1e-12);
    const AdaptTerms eye{"eye", 0.4, 24, {}, false};
    EXPECT_NEAR(adapted(scene, 0, eye).lwa, 2, 1e-12) << "before the first light";
    EXPECT_NEAR(adapted(scene, 2, eye).lwa, 2, 1e-12) << "as before";
    EXPECT_NEAR(adapted(scene, 3, eye).lwa, 2 * std::exp2(2 * (1 - std::exp(-2 / 24.0 / 0.4))),
                1e-12)
        << "two frames later";
    EXPECT_EQ(adapted(frames({0, 0}), 0, {}).lwa, 0);
}

TEST(Shot, BothViewsOfAFrameAreExposedAlike) {
    const auto scene =
        frames_of({light(1, 8, "right"), light(1, 2, "left"), light(2, 4, "left")}, {});
    ASSERT_EQ(scene.size(), 2U);
    EXPECT_NEAR(scene[0].lwa, 4, 1e-12);
    EXPECT_EQ(scene[0].lmax, 80);
    EXPECT_EQ(scene[0].counted, 200);
}

// ---- cuts

std::vector<double> picture(int kind, int shift = 0, double gain = 0) {
    std::vector<double> cells;
    for (int y = 0; y < kThumbnailHeight; ++y)
        for (int x = 0; x < kThumbnailWidth; ++x)
            cells.push_back(gain + (kind == 0   ? std::sin(0.5 * (x + shift)) + 0.1 * y
                                    : kind == 1 ? std::cos(0.9 * y) - 0.05 * (x + shift)
                                                : 0.0));
    return cells;
}

TEST(Likeness, IsOfTheSameSceneWhateverItsLight) {
    EXPECT_NEAR(likeness(picture(0), picture(0)), 1, 1e-12);
    EXPECT_NEAR(likeness(picture(0), picture(0, 2)), 1, 1e-12) << "the camera turns";
    EXPECT_NEAR(likeness(picture(0), picture(0, 0, -3)), 1, 1e-12) << "three e-folds darker";
    EXPECT_LT(likeness(picture(0), picture(1)), kAlike);
    EXPECT_EQ(likeness(picture(2), picture(2)), 1) << "nothing to see in both";
    EXPECT_EQ(likeness(picture(2), picture(0)), 0);
}

TEST(Cuts, AreBetweenScenesAndNotAtBlackFrames) {
    std::vector<FrameLight> lights;
    const std::vector<int> kinds{0, 0, -1, 0, 1, 1, -1, 0};
    for (size_t i = 0; i < kinds.size(); ++i) {
        lights.push_back(light(int(i) + 1, kinds[i] < 0 ? 0 : 1));
        lights.back().thumbnail = picture(kinds[i] < 0 ? 2 : kinds[i]);
    }
    EXPECT_EQ(find_cuts(frames_of(lights, {})), (std::vector<size_t>{0, 4, 7}));
}

TEST(Lacking, IsWhatTheSmallestStepSays) {
    const auto of = [](const std::vector<int>& numbers) {
        std::vector<ShotFrame> scene;
        for (int number : numbers)
            scene.emplace_back().number = number;
        return lacking(scene);
    };
    EXPECT_EQ(of({1, 2, 3}), "");
    EXPECT_EQ(of({7}), "");
    EXPECT_EQ(of({1, 11, 21}), "") << "every tenth";
    EXPECT_EQ(of({1, 2, 4, 5, 8}), "3, 6-7");
    EXPECT_EQ(of({10, 20, 50}), "30-40");
    EXPECT_EQ(of({-2, -1, 1}), "0");
}

// ---- what is kept of a picture

TEST(Thumbnail, HasTheLogarithmsOfMeans) {
    std::vector<float> plane(64 * 36, 3);
    plane[0] = 7;
    plane[1] = kNone;
    plane[64] = -5;
    const auto cells = thumbnail_of(plane.data(), 64, 36);
    ASSERT_EQ(cells.size(), 576U);
    EXPECT_NEAR(cells[0], std::log((7 + 0 + 0 + 3) / 4.0), 1e-12);
    EXPECT_NEAR(cells[575], std::log(3.0), 1e-12);
    const std::vector<float> one(1, 0);
    for (double v : thumbnail_of(one.data(), 1, 1))
        EXPECT_DOUBLE_EQ(v, std::log(1e-6)) << "of one pixel all cells are";
}

TEST(Histogram, HasEveryLitPixelOnce) {
    const std::vector<float> plane{kNone, -1, 0, 1, 1.4F, 1.5F, 1e-20F, 1e20F};
    const auto bins = light_histogram(plane.data(), int64_t(plane.size()));
    EXPECT_EQ(std::accumulate(bins.begin(), bins.end(), int64_t(0)), 5);
    EXPECT_EQ(bins[40], 2) << "half a stop from 1";
    EXPECT_EQ(bins[41], 1);
    EXPECT_EQ(bins.front(), 1);
    EXPECT_EQ(bins.back(), 1);
}

TEST(Histogram, PercentilesAreWithinHalfAStop) {
    std::vector<float> plane;
    for (int i = 1; i <= 1000; ++i)
        plane.push_back(float(i));
    const auto bins = light_histogram(plane.data(), int64_t(plane.size()));
    for (double percentile : {1.0, 25.0, 50.0, 90.0, 99.0, 100.0})
        EXPECT_LE(std::abs(std::log2(percentile_of(bins, percentile) / (10 * percentile))), 0.5)
            << percentile;
    EXPECT_EQ(percentile_of(std::vector<int64_t>(kLightBins, 0), 50), 0);
}

} // namespace
} // namespace tonetool::tonemap
