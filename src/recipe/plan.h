// SPDX-License-Identifier: BSD-3-Clause
// The size of a recipe's picture where the headers of its inputs tell it.
#pragma once

#include <OpenImageIO/imageio.h>
#include <optional>

#include "recipe/picture.h"

namespace tonetool::recipe {

/// Size, windows, number of channels and data type of the first subimage, of a chain whose commands
/// keep them or make them in a known way; reads headers only. nullopt: the chain must be run to
/// know, or to say what is wrong with it.
std::optional<OIIO::ImageSpec> planned_header(const Source& source);

} // namespace tonetool::recipe
