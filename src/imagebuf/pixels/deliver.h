// SPDX-License-Identifier: BSD-3-Clause
// Moves a finished map into the image of the caller.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

namespace tonetool {

/// Whether an image that the caller prepared can take the pixels of a map of this region.
bool takes_map(const OIIO::ImageBuf& dst, const OIIO::ROI& roi);

/// An image the caller prepared takes the map's pixels in place, and its attributes that begin with
/// `prefix`; any other becomes the map.
void deliver(OIIO::ImageBuf& dst, OIIO::ImageBuf&& map, const std::string& prefix);

} // namespace tonetool
