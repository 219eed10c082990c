// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/camera_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace tonetool::tonemap {
namespace {

constexpr int kWidth = 90, kHeight = 60;

// Positions of a hilly surface that a camera at `eye`, turned about y, sees through each pixel.
struct Seen {
    std::vector<float> plane[3];
    std::vector<uint8_t> background;

    Seen(double eye, double turn, double relief = 0.3, double distortion = 0) {
        for (auto& one : plane)
            one.resize(size_t(kWidth) * kHeight);
        background.resize(plane[0].size(), 0);
        for (size_t i = 0; i < background.size(); ++i) {
            const double u = (double(i % kWidth) + 0.5 - kWidth / 2.0) / kWidth;
            const double v = (double(i / kWidth) + 0.5 - kHeight / 2.0) / kWidth;
            const double wide = 1 + distortion * (u * u + v * v);
            const double depth = 5 + relief * std::sin(9 * u) + relief * std::cos(7 * v);
            const double x = u * wide * depth, y = v * wide * depth;
            plane[0][i] = float(std::cos(turn) * x + std::sin(turn) * depth + eye);
            plane[1][i] = float(y - 2 * eye);
            plane[2][i] = float(std::cos(turn) * depth - std::sin(turn) * x);
        }
    }
    SeenPositions view() const {
        return {{plane[0].data(), plane[1].data(), plane[2].data()},
                background.data(),
                kWidth,
                kHeight};
    }
    double farthest(const Projection& camera) const {
        double most = 0;
        for (size_t i = 0; i < background.size(); ++i) {
            const float point[3] = {plane[0][i], plane[1][i], plane[2][i]};
            double x = 0, y = 0;
            if (!project(camera, point, kWidth, kHeight, x, y))
                return std::numeric_limits<double>::infinity();
            most = std::max(most,
                            std::hypot(x - double(i % kWidth) - 0.5, y - double(i / kWidth) - 0.5));
        }
        return most;
    }
};

TEST(CameraFit, SeesPositionsWhereTheyAre) {
    for (const double eye : {0.0, 3.0, 1000.0}) {
        const Seen seen(eye, 0.4);
        const CameraFit fit = fit_camera(seen.view());
        ASSERT_TRUE(fit.camera) << eye;
        EXPECT_EQ(fit.lack, NoCamera::None);
        // Positions are float: a step of theirs is 6e-5 at 1000, and a pixel 0.05.
        EXPECT_LT(seen.farthest(*fit.camera), eye > 100 ? 0.02 : 1e-3) << eye;
        EXPECT_LE(fit.residual, seen.farthest(*fit.camera));
        double norm = 0;
        for (const double number : *fit.camera)
            norm += number * number;
        EXPECT_NEAR(norm, 1, 1e-12);
    }
}

TEST(CameraFit, IsThatOfTheScene) {
    const auto fit = fit_camera(Seen(3, 0).view());
    ASSERT_TRUE(fit.camera);
    const double norm = std::sqrt(3 + 9 + 36); // of (1 0 0 -3, 0 1 0 6, 0 0 1 0)
    const double rows[12] = {1, 0, 0, -3, 0, 1, 0, 6, 0, 0, 1, 0};
    for (size_t i = 0; i < 12; ++i)
        EXPECT_NEAR((*fit.camera)[i], rows[i] / norm, 1e-5) << i;
    const float behind[3] = {3, -6, -1};
    double x = 0, y = 0;
    EXPECT_FALSE(project(*fit.camera, behind, kWidth, kHeight, x, y));
}

TEST(CameraFit, SkipsWhatIsNoSurface) {
    Seen seen(3, 0.4);
    for (size_t i = 0; i < seen.background.size(); i += 3) {
        seen.background[i] = i % 2 == 0 ? 1 : 0;
        seen.plane[i % 3][i] = i % 2 == 0 ? 77 : std::numeric_limits<float>::quiet_NaN();
    }
    EXPECT_TRUE(fit_camera(seen.view()).camera);
    std::fill(seen.background.begin() + 100, seen.background.end(), uint8_t(1));
    EXPECT_TRUE(fit_camera(seen.view()).lack == NoCamera::None);
    std::fill(seen.background.begin() + 20, seen.background.end(), uint8_t(1));
    const CameraFit few = fit_camera(seen.view());
    EXPECT_EQ(few.lack, NoCamera::Few);
    EXPECT_FALSE(few.camera);
}

TEST(CameraFit, NoneSeesAPlaneOrThroughADistortingLens) {
    EXPECT_EQ(fit_camera(Seen(3, 0.4, 0).view()).lack, NoCamera::Flat);
    EXPECT_EQ(fit_camera(Seen(3, 0.4, 0.02).view()).lack, NoCamera::None);
    const CameraFit distorted = fit_camera(Seen(3, 0.4, 0.3, 0.5).view());
    EXPECT_EQ(distorted.lack, NoCamera::Inexact);
    EXPECT_GT(distorted.residual, kMostResidual);
    EXPECT_FALSE(distorted.camera);
    Seen own(3, 0.4);
    std::fill(own.plane[0].begin(), own.plane[0].begin() + 200, 0.5f); // of an object's own space
    EXPECT_EQ(fit_camera(own.view()).lack, NoCamera::Inexact);
}

} // namespace
} // namespace tonetool::tonemap
