// SPDX-License-Identifier: BSD-3-Clause
// The map of --biascheck as a picture.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include "sequence/report/reduced.h"

namespace tonetool::sequence {

/// The relative difference at which the colours end: the largest of a block that differs, at least
/// `least`, at most 1. `map` has the channels of bias_check()'s map "all".
double bias_range(const OIIO::ImageBuf& map, double least);

/// Blue where the test is darker, orange where it is brighter, the stronger the further to `range`;
/// plain grey where nothing differs beyond the noise, a hatching of greys where it could not be
/// tested, of white and grey where only the structure differs.
OIIO::ImageBuf bias_picture(const OIIO::ImageBuf& map, const PixelSize& side, double range);

/// The colours from -range to range, from left to right.
OIIO::ImageBuf bias_ramp();

} // namespace tonetool::sequence
