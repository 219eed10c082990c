// SPDX-License-Identifier: BSD-3-Clause
// The settings of a photographer's camera: plain numbers, no images.
#pragma once

#include <optional>

namespace tonetool {

/// What an exposure by a camera follows from. Unset: by the header, which OpenEXR calls aperture,
/// expTime and isoSpeed; a setting that is in neither is an error. All are above 0.
struct CameraOptions {
    std::optional<double> fnumber; ///< N, the focal length over the diameter of the aperture
    std::optional<double> shutter; ///< T, the time of exposure in seconds
    std::optional<double> iso;     ///< S, the speed by ISO 12232, such as 100
};

} // namespace tonetool
