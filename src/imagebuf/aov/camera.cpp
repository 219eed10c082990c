// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/camera.h"

#include <cmath>

namespace tonetool {
namespace {

std::optional<Imath::M44d> matrix(const OIIO::ImageSpec& spec, const char* name) {
    const OIIO::ParamValue* found = spec.find_attribute(name, OIIO::TypeMatrix);
    if (!found)
        return std::nullopt;
    const auto* values = static_cast<const float*>(found->data());
    Imath::M44d out;
    for (int i = 0; i < 16; ++i)
        out[i / 4][i % 4] = double(values[i]);
    return out;
}

// A pixel's share of the picture's width, over what a step of 1 sideways is of it at depth 1.
bool find_step(const Imath::M44d& to_camera, const Imath::M44d& to_picture, double pixel,
               Camera& camera) {
    const Imath::M44d projection = to_camera.inverse() * to_picture;
    const double sideways = std::abs(projection[0][0]), deeper = std::abs(projection[2][3]);
    camera.parallel = deeper == 0;
    camera.step = pixel * (camera.parallel ? std::abs(projection[3][3]) : deeper) / sideways;
    return camera.step > 0 && std::isfinite(camera.step);
}

} // namespace

std::optional<Camera> find_camera(const OIIO::ImageSpec& spec, std::optional<double> fov) {
    Camera camera;
    camera.to_camera = matrix(spec, "worldToCamera");
    const double width = std::max(spec.full_width, 1);
    if (fov) {
        camera.step = 2 * std::tan(*fov * M_PI / 360) / width;
        return camera;
    }
    if (!camera.to_camera || camera.to_camera->determinant() == 0)
        return std::nullopt;
    // The picture is 1 wide in one of them, 2 in the other.
    if (const auto ndc = matrix(spec, "worldToNDC"))
        if (find_step(*camera.to_camera, *ndc, 1 / width, camera))
            return camera;
    if (const auto screen = matrix(spec, "worldToScreen"))
        if (find_step(*camera.to_camera, *screen, 2 / width, camera))
            return camera;
    return std::nullopt;
}

} // namespace tonetool
