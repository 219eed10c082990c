// SPDX-License-Identifier: BSD-3-Clause
// Some channels of an image, row by row.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <vector>

namespace tonetool::sequence {

/// Reads channels of a region in the order they are asked for. Pixels outside the data window are
/// black.
class PixelRows {
public:
    PixelRows(const OIIO::ImageBuf& image, const OIIO::ROI& region, std::vector<int> channels);

    /// The values of a row, one pixel after the other, until the next call. Throws a
    /// runtime_error where the pixels cannot be read.
    const std::vector<float>& read(int y);

private:
    void gather(const float* pixel, size_t stride, int first);

    const OIIO::ImageBuf& m_image;
    OIIO::ROI m_region; ///< with all channels that have to be read
    std::vector<int> m_channels;
    bool m_floats; ///< the pixels are floats in memory
    std::vector<float> m_values, m_read;
};

/// Bits of the half floats nearest to values; of the two nearest the even one.
void half_bits(const std::vector<float>& values, uint16_t* to);

} // namespace tonetool::sequence
