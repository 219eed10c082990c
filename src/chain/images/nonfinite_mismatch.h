// Non-finite mismatches: pixels where a NaN or an infinity is in one of two images only.
#pragma once

#include <OpenImageIO/imagebuf.h>

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

} // namespace tonetool::chain
