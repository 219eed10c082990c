// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tonetool::tonemap {
namespace {

TEST(Camera, SunnySixteen) {
    const CameraSettings sunny{16, 1.0 / 125, 100};
    EXPECT_NEAR(ev100(sunny), 14.966, 5e-4); // three decimals
    EXPECT_NEAR(saturation_luminance(sunny), 38400, 1e-8 * 38400);
}

TEST(Camera, SaturationIsOfTheExposureValueAlone) {
    for (const CameraSettings& camera :
         {CameraSettings{1.4, 30, 3200}, {2.8, 1.0 / 60, 800}, {22, 1e-4, 50}})
        EXPECT_NEAR(saturation_luminance(camera) / (1.2 * std::exp2(ev100(camera))), 1, 1e-12);
}

TEST(Camera, EachStopIsAFactorOfTwo) {
    const CameraSettings camera{4, 1.0 / 50, 200};
    EXPECT_NEAR(ev100({8, 1.0 / 50, 200}), ev100(camera) + 2, 1e-12);
    EXPECT_NEAR(ev100({4, 1.0 / 100, 200}), ev100(camera) + 1, 1e-12);
    EXPECT_NEAR(ev100({4, 1.0 / 50, 400}), ev100(camera) - 1, 1e-12);
}

} // namespace
} // namespace tonetool::tonemap
