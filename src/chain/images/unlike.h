// Where two images differ in what OpenImageIO's comparisons of their pixels do not look at.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

namespace tonetool::chain {

/// Pixels with a value that is NaN in one image alone, or infinite in one alone, or infinite with
/// both signs.
struct Unlike {
    OIIO::imagesize_t pixels = 0;
    int x = 0, y = 0, z = 0, channel = 0; ///< of the first one, by rows
};

/// Compares what OpenImageIO's comparison lets pass: for it infinities of both signs are the same,
/// and a second NaN that only one image has makes up for the first. Channels by their place; what
/// an image has no pixel, channel or deep sample for is 0.
Unlike unlike_values(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b);

/// Pixels that differ by more than `limit` where the perceptual comparison does not look: in the
/// channels behind its three, and beside a NaN or Inf. The images are of one size, and flat.
OIIO::imagesize_t unseen_differences(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, float limit);

/// What makes two headers ones of different pictures, as a sentence; empty where nothing does.
std::string difference_of_headers(const OIIO::ImageSpec& a, const OIIO::ImageSpec& b);

} // namespace tonetool::chain
