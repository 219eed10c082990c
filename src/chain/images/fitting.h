// An image as a file format can hold it, and as a screen is to show it.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>

#include "chain/images/image.h"
#include "chain/images/output.h"

namespace tonetool::chain {

// One subimage on its way to the file: pixels (owned here where they had to change), data types.
struct Outgoing {
    OIIO::ImageBuf owned;
    const OIIO::ImageBuf* pixels;
    DataFormat format;
};

/// Formats that cannot hold both windows get the display window, with its corner at 0 where they
/// cannot hold its negative origin either. If lenient, as oiiotool: without what is left of or
/// above 0. False where the image is fine as it is.
bool fit_windows(const OIIO::ImageBuf& image, const OIIO::ImageOutput& writer, bool lenient,
                 OIIO::ImageBuf& fitted);

/// Where the format holds fewer channels, or would take the one behind the colours for its alpha:
/// the picture, with its alpha where it has one. oiiotool's choice if the writer is lenient.
void fit_channels(Outgoing& image, const OIIO::ImageOutput& writer, const Writer& from);

/// Tells the writer of the alpha behind one channel or three ("C.A"), by which it divides the
/// colour.
void mark_alpha(OIIO::ImageSpec& spec);

/// A warning where alpha hides pixels of a picture that is written as integers. In files of floats
/// light of alpha 0 adds up.
void warn_of_unseen(const Warn& warn, const OIIO::ImageBuf& pixels, const OIIO::ImageSpec& written,
                    const OIIO::ImageOutput& writer);

} // namespace tonetool::chain
