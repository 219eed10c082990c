// Images made small for a page.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include "tonetool/pixels.h"

namespace tonetool::sequence {

struct PixelSize {
    int width = 0, height = 0;
};

/// The size of a region whose longer side is at most `longest`; never larger than the region.
PixelSize fitted(const OIIO::ROI& region, int longest);

/// The part of `to` that lies in it as `part` lies in `from`.
OIIO::ROI scaled(const OIIO::ROI& part, const OIIO::ROI& from, const OIIO::ROI& to);

/// Whether a colour space is one of a configuration that no header can name, so that who looks at a
/// reduced image must pass it again.
bool says_space_again(const PixelOptions& options);

/// R, G, B of a region at the origin, reduced by the mean of the finite pixels beneath each, in
/// the colour space they are stored in, which the result names. What the image does not cover is
/// black. A runtime_error without colour.
OIIO::ImageBuf reduced_color(const OIIO::ImageBuf& image, const PixelOptions& options,
                             const OIIO::ROI& region, const PixelSize& side);

OIIO::ImageBuf resized(const OIIO::ImageBuf& image, const PixelSize& side);

/// An error map of which each pixel is the largest error beneath it, and the exposure of that.
struct ReducedMaps {
    OIIO::ImageBuf error, stops;
};
ReducedMaps reduced_maps(const OIIO::ImageBuf& error, const OIIO::ImageBuf* stops,
                         const PixelSize& side);

/// Magenta where a pixel of the image's region is not finite. `shown` lies at the origin.
void mark_nonfinite(OIIO::ImageBuf& shown, const OIIO::ImageBuf& image, const PixelOptions& options,
                    const OIIO::ROI& region);

} // namespace tonetool::sequence
