// Pictures of 8 bits, by tables that the library's own functions fill.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

namespace tonetool::sequence {

/// Display-linear light in [0,1], three channels, sRGB-encoded.
OIIO::ImageBuf srgb_bytes(const OIIO::ImageBuf& linear);

/// One channel between `low` and `high` in 256 colours of a map of ToneAlgo::color_maps().
OIIO::ImageBuf colored_bytes(const OIIO::ImageBuf& map, const std::string& colors, double low = 0,
                             double high = 1);

} // namespace tonetool::sequence
