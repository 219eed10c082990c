// SPDX-License-Identifier: BSD-3-Clause
// Alpha that a comparison does not look at.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <string>

#include "imagebuf/pixels/ignored_pixels.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// How many pixels that both images cover differ in alpha by more than rounding to the data types
/// of their files explains; an image without alpha is opaque. `ignored` do not count; may be null.
int64_t count_alpha_differences(const OIIO::ImageBuf& reference, const ColorChoice& of_reference,
                                const OIIO::ImageBuf& test, const ColorChoice& of_test,
                                const OIIO::ROI& region, const IgnoredPixels* ignored);

} // namespace tonetool
