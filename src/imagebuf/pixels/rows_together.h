// SPDX-License-Identifier: BSD-3-Clause
// Rows of files that can only be read as a whole. Header only: the rooms below the library's read
// files, too.
#pragma once

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <string>

namespace tonetool {

/// Rows of an image in a file that it gives only together: those of a tile, or of a strip of a
/// planar TIFF file, where compressed rows come in the order of the strip, a plane after another.
/// 0: rows are read as they are wanted.
inline int rows_together(const OIIO::ImageSpec& spec, const std::string& file_format) {
    if (spec.tile_width > 0)
        return spec.tile_height;
    if (file_format != "tiff" || spec.get_string_attribute("planarconfig") != "separate")
        return 0;
    // -1 stands for 2^32 - 1: the image is one strip.
    const auto rows = unsigned(spec.get_int_attribute("tiff:RowsPerStrip"));
    return rows > 1 ? int(std::min(rows, unsigned(spec.height))) : 0;
}

/// About `wanted` rows, such that those that belong together are read together.
inline int whole_rows(int wanted, const OIIO::ImageSpec& spec, const std::string& file_format) {
    const int block = std::max(rows_together(spec, file_format), 1);
    return std::max(wanted / block, 1) * block;
}

} // namespace tonetool
