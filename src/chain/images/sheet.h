// Images made of several: pasted over each other, or side by side.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <vector>

#include "chain/images/windows.h"

namespace tonetool::chain {

using Pictures = std::vector<const OIIO::ImageBuf*>;

/// The last image is the background, on which the others go at that place, the deepest on top.
/// `merge`: windows that hold all of them; else the background's. A CommandError if that fails.
OIIO::ImageBuf pasted(const Pictures& images, int x, int y, bool merge);

/// Rows of images.
struct Sheet {
    int columns = 0, rows = 0;
    int pad = 0;                  ///< pixels between them
    std::optional<Size> fit = {}; ///< that each is made to fit first
};

/// As large as the largest display window needs in each cell, black where there is no image.
OIIO::ImageBuf mosaic(const Sheet& sheet, const Pictures& images);

} // namespace tonetool::chain
