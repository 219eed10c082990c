// Where two images differ in kind: values that are no numbers on one side only.
#pragma once

#include <OpenImageIO/imagebuf.h>

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

} // namespace tonetool::chain
