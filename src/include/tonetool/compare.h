// SPDX-License-Identifier: BSD-3-Clause
// Options and results that all comparisons of two images have in common.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>
#include <vector>

#include "tonetool/numbers.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// How a reference and a test image are brought together.
struct PairOptions {
    PixelOptions pixels;                 ///< layer and colour space, for both images
    SizePolicy size = SizePolicy::Match; ///< for images with different display windows
    AlphaPolicy alpha = AlphaPolicy::Ignore;
    /// The most memory, in bytes, that a process with no other work needs for the call. Where the
    /// images as planes (13 bytes per pixel and image) do not fit, they are read in scanline
    /// blocks, twice if the reference is measured: the same bits in more time. See "Memory" at
    /// ldr_flip in flip.h. 0: scanline blocks only where half of the physical memory is not enough.
    uint64_t memory = 0;
    /// Further quantities of the map to pool: "p99.95" (any percentile, 0 to 100) and "above0.2"
    /// (the share of the pixels whose error is above 0.2).
    std::vector<std::string> quantities;
};

/// How one image was read, and counts of its unusual pixels.
struct FlipSide {
    std::string layer;     ///< "" for plain R,G,B
    std::string space;     ///< colour space the stored values were read in
    int64_t nonfinite = 0; ///< pixels with NaN or Inf in R, G or B (or in a compared alpha)
    int64_t negative = 0;  ///< pixels with a negative R, G or B in linear Rec.709, set to 0
    /// Compared pixels outside this image's data window, which count as black.
    int64_t uncovered = 0;
};

/// What was compared, and the result.
struct PairSummary {
    FlipPool pool;
    FlipSide reference, test;
    int64_t nonfinite_both = 0; ///< pixels that are non-finite in both images and alike: error 0
    /// Pixels that are non-finite in both images but not alike (Inf against NaN or -Inf, or other
    /// components that differ): they count as if one alone were non-finite.
    int64_t nonfinite_unlike = 0;
    /// Pixels whose alpha differs, where alpha is ignored.
    int64_t alpha_ignored = 0;
    OIIO::ROI region; ///< pixels compared
    bool alpha_compared = false;
    double alpha_mean = 0, alpha_max = 0; ///< |alpha difference|
    int alpha_max_x = 0, alpha_max_y = 0;
    /// Warnings for the user, one sentence each (non-finite pixels, pixels outside the data window,
    /// ...).
    std::vector<std::string> warnings;
};

} // namespace tonetool
