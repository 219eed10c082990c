// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/camera.h"

#include <cmath>

namespace tonetool::tonemap {

double ev100(const CameraSettings& camera) {
    return std::log2(100 * camera.fnumber * camera.fnumber / (camera.iso * camera.shutter));
}

double saturation_luminance(const CameraSettings& camera) {
    constexpr double saturation = 78; // lx s at ISO 1
    // A lens that lets 0.9 of the light through, with 0.98 for its vignetting, 10 degrees off the
    // axis: pi/4 x 0.9 x 0.98 x cos(10 degrees)^4.
    constexpr double lens = 0.65;
    return saturation * camera.fnumber * camera.fnumber / (lens * camera.iso * camera.shutter);
}

} // namespace tonetool::tonemap
