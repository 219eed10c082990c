// SPDX-License-Identifier: BSD-3-Clause
// The colour of an image and its space, as every function decides on them.
#pragma once

#include <OpenImageIO/imageio.h>

#include "imagebuf/pixels/colorimetry.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// A picture of one channel is grey: its three channels are the same, and no primaries apply to it.
/// `options.from` may name a space of their configuration.
void find_picture(const OIIO::ImageSpec& spec, const PixelOptions& options, ColorChoice& choice,
                  ColorSpace& space);

/// What ToneAlgo::find_color() finds.
ColorChoice chosen_color(const OIIO::ImageSpec& spec, const PixelOptions& options);

} // namespace tonetool
