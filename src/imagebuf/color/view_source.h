// SPDX-License-Identifier: BSD-3-Clause
// Colour spaces of OpenColorIO configurations as what images are stored in.
#pragma once

#include <string>

#include "imagebuf/pixels/colorimetry.h"
#include "tonetool/pixels.h"

namespace tonetool {

/// The space that `options.from` names in the configuration `options.config`, to linear Rec.709.
ColorSpace config_space(const PixelOptions& options);

} // namespace tonetool
