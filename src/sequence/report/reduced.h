// SPDX-License-Identifier: BSD-3-Clause
// Images reduced in size for a page.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <vector>

#include "tonetool/pixels.h"

namespace tonetool::sequence {

struct PixelSize {
    int width = 0, height = 0;
};

/// The size of a region whose longer side is at most `longest`; never larger than the region.
PixelSize fitted(const OIIO::ROI& region, int longest);

/// Of each of `from` pixels the one of `to` that it falls on when it is reduced.
std::vector<size_t> targets(int from, int to);

/// The region of `to` that corresponds to the region `part` of `from`.
OIIO::ROI scaled(const OIIO::ROI& part, const OIIO::ROI& from, const OIIO::ROI& to);

/// Whether `from` names a colour space of a configuration that no header can name: readers of a
/// reduced image must pass it again.
bool says_space_again(const PixelOptions& options);

/// R, G, B of a region, moved to the origin. Each pixel is the mean of the finite pixels beneath
/// it, in the colour space that they are stored in, which the result's header names. Pixels outside
/// the data window are black. Throws a runtime_error if the image has no colour.
OIIO::ImageBuf reduced_color(const OIIO::ImageBuf& image, const PixelOptions& options,
                             const OIIO::ROI& region, const PixelSize& side);

OIIO::ImageBuf resized(const OIIO::ImageBuf& image, const PixelSize& side);

/// A reduced error map, whose pixels are the largest errors beneath them, and the exposures of
/// those.
struct ReducedMaps {
    OIIO::ImageBuf error, stops;
};
ReducedMaps reduced_maps(const OIIO::ImageBuf& error, const OIIO::ImageBuf* stops,
                         const PixelSize& side);

/// Paints `shown`, which lies at the origin, magenta where a pixel of the image's region is not
/// finite.
void mark_nonfinite(OIIO::ImageBuf& shown, const OIIO::ImageBuf& image, const PixelOptions& options,
                    const OIIO::ROI& region);

} // namespace tonetool::sequence
