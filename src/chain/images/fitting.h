// SPDX-License-Identifier: BSD-3-Clause
// Fits an image to the limits of a file format, and to its display on a screen.
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

/// For formats that cannot store both windows: crops to the display window, and moves its corner to
/// 0 where the format cannot store a negative origin, either. If lenient, as oiiotool: cuts off
/// what lies left of or above 0. False where the image is fine as it is.
bool fit_windows(const OIIO::ImageBuf& image, const OIIO::ImageOutput& writer, bool lenient,
                 OIIO::ImageBuf& fitted);

/// For formats that hold fewer channels, or that would read the channel behind the colours as
/// alpha: keeps the displayed layer, with its alpha if it has one. Makes oiiotool's choice if the
/// writer is lenient.
void fit_channels(Outgoing& image, const OIIO::ImageOutput& writer, const Writer& from);

/// Tells the writer which channel behind one or three colour channels is the alpha ("C.A"), since
/// it divides the colour by alpha.
void mark_alpha(OIIO::ImageSpec& spec);

/// Warns where alpha hides pixels of an image that is written as integers. In files of floats,
/// colour at alpha 0 is light that is added.
void warn_of_unseen(const Warn& warn, const OIIO::ImageBuf& pixels, const OIIO::ImageSpec& written,
                    const OIIO::ImageOutput& writer);

} // namespace tonetool::chain
