// SPDX-License-Identifier: BSD-3-Clause
// 8-bit images, by look-up tables that the library's own functions fill.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

namespace tonetool::sequence {

/// Encodes display-linear values in [0,1] of three channels to sRGB.
OIIO::ImageBuf srgb_bytes(const OIIO::ImageBuf& linear);

/// One channel from `low` to `high` in 256 colours of a colour map of ToneAlgo::color_maps().
OIIO::ImageBuf colored_bytes(const OIIO::ImageBuf& map, const std::string& colors, double low = 0,
                             double high = 1);

/// One channel from `low` to `high` as grey codes from 0 to 255.
OIIO::ImageBuf coded_bytes(const OIIO::ImageBuf& map, double low = 0, double high = 1);

} // namespace tonetool::sequence
