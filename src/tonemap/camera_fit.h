// SPDX-License-Identifier: BSD-3-Clause
// The camera that an image was seen by, from the positions of its pixels.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

namespace tonetool::tonemap {

/// A projection: three rows of four numbers, of norm 1. With (a, b, c) = rows (x, y, z, 1), a point
/// is seen at a/c and b/c in widths of the image from its middle, x to the right and y down, and is
/// in front of the camera where c > 0.
using Projection = std::array<double, 12>;

/// Surfaces of an image of width x height, packed.
struct SeenPositions {
    const float* plane[3] = {nullptr, nullptr, nullptr};
    const uint8_t* background = nullptr; ///< not 0: no surface; null: all are
    int width = 0, height = 0;
};

/// Why there is no camera.
enum class NoCamera {
    None,   ///< there is one
    Few,    ///< too few pixels show a surface
    Flat,   ///< all of it is in a plane, which any number of cameras would see alike
    Inexact ///< no camera sees the positions where they are
};

struct CameraFit {
    std::optional<Projection> camera;
    NoCamera lack = NoCamera::Few;
    double residual = 0; ///< pixels that 99 % of the surfaces are seen within
};

/// Of residuals: lens distortion, motion blur and positions of an object's own space have more.
inline constexpr double kMostResidual = 0.25;

/// The direct linear transform of up to 4000 pixels, at even steps, and where they are seen: the
/// rows of least squares by the smallest singular vector (R. Hartley, A. Zisserman, "Multiple View
/// Geometry in Computer Vision", 2003, section 7.1), points scaled to a deviation of 1. Positions
/// that are not finite are no surface. The same bits wherever it runs.
CameraFit fit_camera(const SeenPositions& seen);

/// Where a camera sees a point, in pixels from the corner of an image; pixel 0 has its centre at
/// 0.5. False behind the camera.
inline bool project(const Projection& camera, const float (&point)[3], int width, int height,
                    double& x, double& y) {
    double to[3];
    for (size_t row = 0; row < 3; ++row)
        to[row] = camera[4 * row] * double(point[0]) + camera[4 * row + 1] * double(point[1]) +
                  camera[4 * row + 2] * double(point[2]) + camera[4 * row + 3];
    if (!(to[2] > 0))
        return false;
    x = to[0] / to[2] * width + 0.5 * width;
    y = to[1] / to[2] * width + 0.5 * height;
    return true;
}

} // namespace tonetool::tonemap
