// SPDX-License-Identifier: BSD-3-Clause
// Options and results that all comparisons of two images have in common.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/numbers.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// A mask: a file, or an image in memory.
struct Mask {
    std::string file;
    std::shared_ptr<const OIIO::ImageBuf> image; ///< instead of the file

    bool given() const { return image || !file.empty(); }
};

/// Which pixels of a comparison do not count.
///
/// A pixel counts where the first channel of the mask is 0.5 or more and no region of `ignore`
/// covers it. What does not count takes the reference's colour in the tests, so that neighbours see
/// no difference; the map is 0 there, and it is in no number: not in the pool and its pixels, the
/// exposures, the counts of pixels that are not finite, negative or not covered.
///
/// The mask lies on the reference's display window and must have its size (of its own display
/// window), wherever its own begins, and its Orientation. Its values are taken as they are stored,
/// integers as 0 to 1, without a conversion of colours; NaN does not count, and neither does what
/// lies outside the mask's data window. Compared pixels outside of both its windows (overscan,
/// which a mask of the display window cannot know of) count. No pixel that counts is an error; more
/// than half that does not, a warning.
struct IgnoreOptions {
    Mask mask;
    /// Regions that do not count, "WxH+X+Y" in the reference's pixels; one that holds no compared
    /// pixel is an error.
    std::vector<std::string> ignore;

    bool any() const { return mask.given() || !ignore.empty(); }
};

/// How a reference and a test image are brought together.
struct PairOptions : IgnoreOptions {
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
    /// The part of them that does not count, 0 to 1; unset: neither a mask nor a region was given.
    std::optional<double> ignored;
    bool alpha_compared = false;
    double alpha_mean = 0, alpha_max = 0; ///< |alpha difference|
    int alpha_max_x = 0, alpha_max_y = 0;
    /// Warnings for the user, one sentence each (non-finite pixels, pixels outside the data window,
    /// ...).
    std::vector<std::string> warnings;
};

namespace ToneAlgo {

/// The pixels of `region` that do not count, as every comparison with these options finds them: 1
/// for each, row by row, else 0. `reference` is its header. Adds to `warnings` if more than half do
/// not count. Returns false with the reason in `error`: a mask that cannot be read or is of another
/// size, a region that is none, no pixel that counts. The mask is read by the call itself, past
/// every ImageCache, unless it was read before.
TONETOOL_API bool ignored_pixels(std::vector<uint8_t>& ignored, const OIIO::ImageSpec& reference,
                                 const IgnoreOptions& options, OIIO::ROI region,
                                 std::vector<std::string>& warnings, std::string& error);

} // namespace ToneAlgo
} // namespace tonetool
