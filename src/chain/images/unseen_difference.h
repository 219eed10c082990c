// SPDX-License-Identifier: BSD-3-Clause
// Where two images differ in what OpenImageIO's comparisons of their pixels do not look at.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

namespace tonetool::chain {

/// The pixels with a value that is NaN in one image alone, or infinite in one alone, or infinite
/// with opposite signs.
struct NonfiniteMismatch {
    OIIO::imagesize_t pixels = 0;
    int x = 0, y = 0, z = 0, channel = 0; ///< position of the first one, by rows
};

/// Finds the mismatches that OpenImageIO's comparison lets pass: it does not look at the sign of
/// infinities, and counts a NaN in one image against a NaN at another place in the other. Channels
/// correspond by their index; a missing pixel, channel or deep sample counts as 0.
NonfiniteMismatch find_nonfinite_mismatch(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b);

/// Pixels that differ by more than `limit` where the perceptual comparison does not look: in the
/// channels behind its three, and beside a NaN or Inf. The images are of one size, and flat.
OIIO::imagesize_t unseen_differences(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, float limit);

/// What makes two headers those of different images, as a sentence; empty where nothing does.
std::string difference_of_headers(const OIIO::ImageSpec& a, const OIIO::ImageSpec& b);

} // namespace tonetool::chain
