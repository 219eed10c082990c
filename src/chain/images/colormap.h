// SPDX-License-Identifier: BSD-3-Clause
// False colours.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

namespace tonetool::chain {

/// Throws a CommandError unless `map` is the name of a colour map or a list of RGB triples.
void check_colormap(const std::string& map);

/// One channel (or the luminance of three) in the colours of `map`: R,G,B, sRGB-encoded.
OIIO::ImageBuf colored(const OIIO::ImageBuf& pixels, const std::string& map);

/// The same upright, with a bar of the colours from 0 to 1 at the right.
OIIO::ImageBuf colored_with_bar(const OIIO::ImageBuf& pixels, const std::string& map);

/// The colours as oiiotool makes them: of the luminance, in linear light.
OIIO::ImageBuf linear_colored(const OIIO::ImageBuf& pixels, const std::string& map);

} // namespace tonetool::chain
