// SPDX-License-Identifier: BSD-3-Clause
// Scene-linear pixels as the page holds them: half floats as two pictures of 8 bits, and codes of
// their logarithms.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <vector>

#include "sequence/report/reduced.h"

namespace tonetool::sequence {

/// Bits of half floats in linear Rec.709, row by row.
struct ScenePixels {
    int width = 0, height = 0;
    std::vector<uint16_t> color; ///< R, G, B of each pixel
    std::vector<uint16_t> alpha; ///< empty where the image has none
};

/// The pixels of a region. Colours that are stored in Rec.709 stay what they are; of others those
/// that are not finite do, and negative components become 0.
ScenePixels scene_pixels(const OIIO::ImageBuf& image, const PixelOptions& options,
                         const OIIO::ROI& region);

/// The same of a region that is shown in another size, without alpha: means of the finite pixels
/// beneath each pixel.
ScenePixels scene_means(const OIIO::ImageBuf& image, const PixelOptions& options,
                        const OIIO::ROI& region, const PixelSize& side);

/// Means of the finite pixels beneath each pixel of a smaller side, without alpha.
ScenePixels reduced(const ScenePixels& pixels, const PixelSize& side);

/// `part` is counted from the first pixel.
ScenePixels part_of(const ScenePixels& pixels, const OIIO::ROI& part);

/// The value of a half float.
float half_value(uint16_t half);

/// Finite halves with their mantissa rounded to so many bits, at most the largest that there is.
inline constexpr int kMantissaBits = 7;
void shorten(std::vector<uint16_t>& halves, int bits = kMantissaBits);

/// R, G, B of the high or the low bytes of halves, three for each pixel.
OIIO::ImageBuf high_bytes(const ScenePixels& pixels);
OIIO::ImageBuf low_bytes(const ScenePixels& pixels);

/// One half for each pixel: its high byte as R, its low one as G.
OIIO::ImageBuf both_bytes(const std::vector<uint16_t>& halves, int width, int height);

/// Logarithms of the colours from 0 to 255: 2^kLogLow and less is 0.
inline constexpr double kLogLow = -10, kLogHigh = 8;
OIIO::ImageBuf log_codes(const ScenePixels& pixels);

} // namespace tonetool::sequence
