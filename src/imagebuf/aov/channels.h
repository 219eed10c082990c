// SPDX-License-Identifier: BSD-3-Clause
// Which channels of an image are its colour, and what the name of a layer, or of a part of a file,
// says of its R, G, B.
#pragma once

#include <OpenImageIO/imageio.h>
#include <string>

#include "tonetool/pixels.h"

namespace tonetool {

/// It is a measurement ("N", "ViewLayer.Denoising Normal", "crypto00"), not a picture.
bool is_data_name(const std::string& layer);
/// It is what renderers call the final picture ("C", "rgba", "ViewLayer.Combined").
bool is_beauty_name(const std::string& layer);

/// Whether all layers of an image hold data by their names, so that it has no picture.
bool holds_only_data(const OIIO::ImageSpec& spec);

/// The channels of that layer, or of the picture (""); the space of the choice is left open. A
/// Refusal where there is none, or more than one.
ColorChoice chosen_channels(const OIIO::ImageSpec& spec, const std::string& layer);

} // namespace tonetool
