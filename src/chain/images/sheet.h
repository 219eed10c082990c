// SPDX-License-Identifier: BSD-3-Clause
// Images assembled from several: pasted over each other, or side by side.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <vector>

#include "chain/images/windows.h"

namespace tonetool::chain {

using Pictures = std::vector<const OIIO::ImageBuf*>;

/// Pastes images over the last one at that position, the deepest of the stack on top. `merge`: the
/// windows hold all images; else they are the background's. Throws a CommandError if that fails.
OIIO::ImageBuf pasted(const Pictures& images, int x, int y, bool merge);

/// The layout of a contact sheet.
struct Sheet {
    int columns = 0, rows = 0;
    int pad = 0;                  ///< pixels between images
    std::optional<Size> fit = {}; ///< the size that each image is fitted to first
};

/// Each cell is as large as the largest display window, and black where there is no image.
OIIO::ImageBuf mosaic(const Sheet& sheet, const Pictures& images);

} // namespace tonetool::chain
