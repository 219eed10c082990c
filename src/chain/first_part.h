// Commands that work on one subimage say so where there are more.
#pragma once

#include "chain/call.h"
#include "chain/session.h"
#include "include/tonetool/pixels.h"

namespace tonetool::chain {

/// A warning if the image has subimages beyond the first.
void warn_of_other_parts(Session& session, const Call& call, const Image& image);

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

/// The pixels of the first subimage; a CommandError if it is deep.
const OIIO::ImageBuf& flat_pixels(const Image& image);

} // namespace tonetool::chain
