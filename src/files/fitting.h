// An image as a file format can hold it, and as a screen is to show it.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>

#include "files/image.h"
#include "files/output.h"

namespace tonetool::files {

// One subimage on its way to the file: pixels (owned here where they had to change), data types.
struct Outgoing {
    OIIO::ImageBuf owned;
    const OIIO::ImageBuf* pixels;
    DataFormat format;
};

/// Formats without a data window get the display window; those without a negative origin get the
/// part of it that they can hold.
void fit_windows(Outgoing& image, const OIIO::ImageOutput& writer);

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

} // namespace tonetool::files
