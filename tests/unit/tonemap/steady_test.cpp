// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/steady.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "schedules.h"
#include "target.h"

namespace tonetool::tonemap {
namespace {

constexpr int kWidth = 40, kHeight = 20;
constexpr float kDepth = 2, kStep = kDepth / kWidth; // of the scene, from pixel to pixel
constexpr float kNoise = 0.01f;

// A wall that a camera goes along, a pixel to the right for each unit of `at`.
struct Frame {
    std::vector<SteadyPixel> pixels{size_t(kWidth) * kHeight};
    Projection camera{};
    int number;

    Frame(int its_number, double at, float brighter = 0) : number(its_number) {
        camera = {1, 0, 0, -at * double(kStep), 0, 1, 0, 0, 0, 0, 1, 0};
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                SteadyPixel& pixel = pixels[size_t(y * kWidth + x)];
                const float in_scene = float(x + at); // in pixels
                pixel.position[0] = (in_scene + 0.5f - kWidth / 2.0f) * kStep;
                pixel.position[1] = (float(y) + 0.5f - kHeight / 2.0f) * kStep;
                pixel.position[2] = kDepth;
                pixel.mean = 0.1f * in_scene + brighter;
                pixel.value = pixel.mean + 2 * brighter;
                pixel.variance = 0.02f + brighter;
                for (size_t c = 0; c < 3; ++c) {
                    pixel.normal[c] = int16_t(c == 2 ? kNormalSteps : 0);
                    pixel.albedo[c] = 30000;
                }
            }
    }
    SteadyView view() const {
        SteadyView view;
        view.number = number;
        view.width = kWidth;
        view.height = kHeight;
        view.pixels = pixels.data();
        view.has_normal = view.has_albedo = true;
        view.camera = &camera;
        return view;
    }
};

struct Result {
    std::vector<float> base, gain, share;
    Result() {
        for (auto* plane : {&base, &gain, &share})
            plane->assign(size_t(kWidth) * kHeight, -9);
    }
    bool operator==(const Result& o) const {
        return base == o.base && gain == o.gain && share == o.share;
    }
};

Result steady(const std::vector<SteadyView>& frames, size_t at,
              const kernels::ParallelFor& parallel = kernels::in_order()) {
    Result out;
    const std::vector<float> noise(out.base.size(), kNoise);
    steady_base(frames, {at, noise.data(), nullptr, double(kStep)}, EdgeTerms(),
                {0, 0, kWidth, kHeight},
                {out.base.data(), out.gain.data(), out.share.data(), kWidth}, parallel);
    return out;
}

Result alone(const Frame& frame) {
    return steady({frame.view()}, 0);
}

constexpr size_t kMiddle = size_t(9 * kWidth + 20);

TEST(Steady, FramesThatAreTheSameLeaveAFrameAsItIs) {
    const Frame a(1, 0), b(2, 0), c(3, 0);
    const Result found = steady({a.view(), b.view(), c.view()}, 1);
    EXPECT_EQ(found, alone(b));
    for (const float gain : found.gain)
        ASSERT_EQ(gain, 1);
}

TEST(Steady, IsAWeightedMeanAlongTheSurface) {
    const float brighter = 0.05f;
    for (const double moved : {0.0, 3.0, -2.5, 0.25}) {
        const Frame own(7, 0), other(9, moved, brighter);
        const Result found = steady({own.view(), other.view()}, 0);
        const double w = std::exp(-2 / 3.0) * std::exp(-0.05 * 0.05 / (2 * 0.1 * 0.1));
        const double g = w * std::exp(-0.15 * 0.15 / (2 * 9 * double(kNoise)));
        const double mean = 2 + w / (1 + w) * 0.05, variance = 0.02 + w / (1 + w) * 0.05;
        const double value = 2 + g / (1 + g) * 0.15;
        const double of_edge = variance / (variance + 0.16 * 0.16);
        const double share = 1 - (1 - of_edge) * (1 - 2 * double(kNoise) / variance);
        EXPECT_NEAR(double(found.gain[kMiddle]), std::exp(value - 2), 1e-5) << moved;
        EXPECT_NEAR(double(found.share[kMiddle]), share, 1e-5) << moved;
        EXPECT_NEAR(double(found.base[kMiddle]), mean + share * (value - mean), 1e-5) << moved;
    }
}

TEST(Steady, AChangeOfLightIsNotAveraged) {
    const Frame own(5, 0), other(6, 0, 0.6f);
    const Result found = steady({own.view(), other.view()}, 0);
    EXPECT_NEAR(double(found.gain[kMiddle]), 1, 1e-6);
    EXPECT_NEAR(double(found.base[kMiddle]), double(alone(own).base[kMiddle]), 1e-6);
}

TEST(Steady, WhatIsNotTheSameSurfaceHasNoPart) {
    const Frame own(5, 0), other(6, 0, 0.05f);
    const auto with = [&](const std::function<void(SteadyPixel&)>& change) {
        Frame changed = other;
        for (SteadyPixel& pixel : changed.pixels)
            change(pixel);
        return steady({own.view(), changed.view()}, 0);
    };
    const auto nearer = [](float pixels) {
        return [pixels](SteadyPixel& pixel) { pixel.position[2] -= pixels * kStep; };
    };
    const auto turned = [](float cosine) {
        return [cosine](SteadyPixel& pixel) {
            pixel.normal[2] = int16_t(cosine * kNormalSteps);
            pixel.normal[0] = int16_t(std::sqrt(1 - cosine * cosine) * kNormalSteps);
        };
    };
    const auto painted = [](float more) {
        return [more](SteadyPixel& pixel) { pixel.albedo[1] += uint16_t(more * kAlbedoSteps); };
    };
    const auto dark = [](SteadyPixel& pixel) {
        pixel.value = std::numeric_limits<float>::quiet_NaN();
    };
    const Result expected = alone(own);
    EXPECT_EQ(with(nearer(2.1f)), expected);
    EXPECT_EQ(with(turned(0.94f)), expected);
    EXPECT_EQ(with(painted(0.06f)), expected);
    EXPECT_EQ(with(dark), expected);
    for (const auto& change : {std::function<void(SteadyPixel&)>(nearer(1.9f)),
                               std::function<void(SteadyPixel&)>(turned(0.96f)),
                               std::function<void(SteadyPixel&)>(painted(0.04f))})
        EXPECT_GT(with(change).gain[kMiddle], 1.01f);
    const std::vector<uint8_t> sky(own.pixels.size(), 1);
    SteadyView view = other.view();
    view.background = sky.data();
    EXPECT_EQ(steady({own.view(), view}, 0), expected);
    SteadyView own_sky = own.view();
    own_sky.background = sky.data();
    EXPECT_EQ(steady({own_sky, other.view()}, 0), expected);
    view = other.view();
    view.camera = nullptr; // but what is at the same place needs none
    EXPECT_GT(steady({own.view(), view}, 0).gain[kMiddle], 1.01f);
    const Frame moved(6, 3, 0.05f);
    view = moved.view();
    view.camera = nullptr;
    EXPECT_EQ(steady({own.view(), view}, 0), expected);
}

TEST(Steady, FollowsTheMotionOfBlenderFromFrameToFrame) {
    // All goes 2 pixels to the right and 1 up in each frame, and away from the camera.
    std::vector<Frame> frames;
    for (int number = 3; number <= 6; ++number) {
        Frame& frame = frames.emplace_back(number, 0);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                SteadyPixel& pixel = frame.pixels[size_t(y * kWidth + x)];
                pixel.position[2] += float(number);
                const bool lit = x - 2 * number == 12 && y + number == 14;
                pixel.mean = pixel.value = lit ? 0.01f * float(number) : 0;
                pixel.variance = 0.02f;
            }
    }
    using Vector = float[4];
    const std::vector<std::array<float, 4>> motion(frames[0].pixels.size(), {-2, -1, -2, -1});
    std::vector<SteadyView> views;
    for (const Frame& frame : frames) {
        views.push_back(frame.view());
        views.back().motion = reinterpret_cast<const Vector*>(motion.data());
    }
    const size_t at = 9 * kWidth + 22; // of the lit pixel in frame 5
    ASSERT_FLOAT_EQ(frames[2].pixels[at].value, 0.05f);
    const auto gain = [](const std::vector<int>& numbers) {
        double weights = 1, sum = 0;
        for (const int number : numbers) {
            const double off = 0.01 * (number - 5), away = std::abs(number - 5);
            const double g = std::exp(-away / 3 - off * off / (2 * 0.1 * 0.1) -
                                      off * off / (2 * 9 * double(kNoise)));
            weights += g;
            sum += g * off;
        }
        return std::exp(sum / weights);
    };
    const Result found = steady(views, 2);
    EXPECT_NEAR(double(found.gain[at]), gain({3, 4, 6}), 1e-6);
    EXPECT_EQ(found.gain[at + 5], 1) << "what is the same in all frames";
    views.erase(views.begin() + 1); // and so the way to the frame behind it
    EXPECT_NEAR(double(steady(views, 1).gain[at]), gain({6}), 1e-6);
}

TEST(Steady, DoesNotDependOnTheSchedule) {
    const Frame a(1, 0.3, 0.02f), b(2, 0), c(4, 1.7, 0.03f);
    const std::vector<SteadyView> frames{a.view(), b.view(), c.view()};
    const Result expected = steady(frames, 1);
    EXPECT_EQ(steady(frames, 1, kernels::backwards()), expected);
    EXPECT_EQ(steady(frames, 1, kernels::on_threads(3)), expected);
    EXPECT_NE(expected.gain, alone(b).gain);
}

} // namespace
} // namespace tonetool::tonemap
