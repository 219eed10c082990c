// SPDX-License-Identifier: BSD-3-Clause
// What a header tells of the light: the unit of the pixels, and the settings of the camera.
#pragma once

#include <OpenImageIO/imageio.h>
#include <optional>
#include <string>
#include <vector>

#include "tonemap/camera.h"
#include "tonetool/camera_numbers.h"

namespace tonetool {

/// A number above 0 under the first of these names that has one, or 0.
double header_number(const OIIO::ImageSpec& spec, std::initializer_list<const char*> names);

/// cd/m2 of a pixel value of 1; 0: the header does not say.
double header_unit(const OIIO::ImageSpec& spec);

/// The unit that is given, else the header's, else 1, which is told in a note.
double unit_or_1(std::optional<double> given, double of_header, std::vector<std::string>& notes);

/// The settings that are given, else the header's. One that is in neither is refused.
tonemap::CameraSettings camera_settings(const CameraOptions& options, const OIIO::ImageSpec& spec);

/// Refuses settings of a camera where there is none.
void refuse_camera(const CameraOptions& options, const std::string& method);

} // namespace tonetool
