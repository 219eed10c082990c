// SPDX-License-Identifier: BSD-3-Clause
// Sizes, positions and windows as the command line gives them.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>

namespace tonetool::chain {

/// Position: only the origin may change; Scalable: also "50%", "0.5".
enum class Geometry { Position, Window, Scalable };

/// The problem of a geometry, and what oiiotool makes of it.
struct Adjusted {
    std::string error, warning;
};

/// A size or position as oiiotool takes it ("40x30+5+6", "x0,y0,x1,y1", "50%", "+5+6"), applied to
/// a window. If `lenient`, text behind it and invalid sizes are accepted, as oiiotool does.
Adjusted adjust_window(const std::string& text, Geometry allowed, OIIO::ROI& window, bool lenient);

/// The header of an image resized to another display window, in which the data window keeps its
/// place.
OIIO::ImageSpec scaled_spec(OIIO::ImageSpec spec, const OIIO::ROI& display);

/// "3x5"; nullopt for anything else.
struct Size {
    float width, height;
};
std::optional<Size> parsed_size(const std::string& text);

} // namespace tonetool::chain
