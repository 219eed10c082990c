// SPDX-License-Identifier: BSD-3-Clause
// What an image tells of the camera that made it.
#pragma once

#include <Imath/ImathMatrix.h>
#include <OpenImageIO/imageio.h>
#include <optional>
#include <string>

namespace tonetool {

struct Camera {
    /// The width of a pixel at depth 1, in the unit of positions; of parallel projections at any
    /// depth.
    double step = 0;
    bool parallel = false;
    std::optional<Imath::M44d> to_camera; ///< from world space, points on the left
};

/// The field of view in degrees where nothing tells: Blender's default, and not far from what
/// others have.
inline constexpr double kUsualView = 40;

/// From the attributes worldToCamera and worldToNDC or worldToScreen, as OpenEXR has them; `fov`,
/// the horizontal field of view in degrees, overrides. nullopt if neither is there or of use.
std::optional<Camera> find_camera(const OIIO::ImageSpec& spec, std::optional<double> fov);

} // namespace tonetool
