// Images for functions that look at their colour.
#pragma once

#include "include/tonetool/pixels.h"
#include "measure/commands.h"

namespace tonetool::measure {

/// A CommandError unless the first subimage has the colour that a function is to look at.
void check_color(Session& session, const Call& call, const Image& image,
                 const PixelOptions& options);

/// The first subimage for a function that looks at its colour, which is checked to be one; valid as
/// long as the image is.
OIIO::ImageBuf color_input(Session& session, const Call& call, const Image& image,
                           const PixelOptions& options);

/// The same for functions of the library that read what they need of the file themselves.
OIIO::ImageBuf color_source(Session& session, const Call& call, const Image& image,
                            const PixelOptions& options);

} // namespace tonetool::measure
