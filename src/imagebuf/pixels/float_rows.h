// SPDX-License-Identifier: BSD-3-Clause
// The rows of an image as floats, whatever numbers it holds. OpenImageIO's iterators over floats
// take the memory of any image for floats. Header only, as has_pixels.h is.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <utility>
#include <vector>

#include "imagebuf/pixels/has_pixels.h"
#include "metrics/refusal.h"

namespace tonetool {

/// Calls visit(y, row) for the rows of a region, plane by plane: its channels interleaved, 0
/// outside the data window. A Refusal names the file of pixels that cannot be read.
template <class Visit>
void for_each_row(const OIIO::ImageBuf& image, const OIIO::ROI& region, const Visit& visit) {
    std::vector<float> row(size_t(region.width()) * size_t(region.nchannels()));
    for (int z = region.zbegin; z < region.zend; ++z) {
        for (int y = region.ybegin; y < region.yend; ++y) {
            const OIIO::ROI line(region.xbegin, region.xend, y, y + 1, z, z + 1, region.chbegin,
                                 region.chend);
            if (!image.get_pixels(line, OIIO::TypeFloat, row.data()))
                throw Refusal(with_name(image, image.geterror()));
            visit(y, std::as_const(row).data());
        }
    }
}

} // namespace tonetool
