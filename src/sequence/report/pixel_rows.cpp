// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/pixel_rows.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace tonetool::sequence {

namespace {

OIIO::ROI with_channels(OIIO::ROI region, const std::vector<int>& channels) {
    region.chbegin = *std::min_element(channels.begin(), channels.end());
    region.chend = *std::max_element(channels.begin(), channels.end()) + 1;
    return region;
}

uint16_t half_of(float value) {
    constexpr uint32_t least_normal = 113U << 23, infinity = 255U << 23, overflow = 0x477ff000U;
    uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    const uint32_t sign = bits >> 16 & 0x8000U, magnitude = bits & 0x7fffffffU;
    if (magnitude > infinity) { // NaN: what is left of its number
        const uint32_t rest = magnitude >> 13 & 1023U;
        return uint16_t(sign | 0x7c00U | (rest == 0 ? 1U : rest));
    }
    if (magnitude >= overflow)
        return uint16_t(sign | 0x7c00U);
    if (magnitude >= least_normal) {
        const uint32_t odd = magnitude >> 13 & 1U;
        return uint16_t(sign | ((magnitude - (112U << 23) + 0xfffU + odd) >> 13));
    }
    // Beside 0.5 a float's last digit is 2^-24, that of the halves here.
    float small = 0;
    std::memcpy(&small, &magnitude, sizeof small);
    small += 0.5f;
    std::memcpy(&bits, &small, sizeof bits);
    return uint16_t(sign | (bits & 0x7ffU));
}

} // namespace

PixelRows::PixelRows(const OIIO::ImageBuf& image, const OIIO::ROI& region,
                     std::vector<int> channels)
    : m_image(image),
      m_region(with_channels(region, channels)),
      m_channels(std::move(channels)),
      m_floats(image.localpixels() && image.spec().format == OIIO::TypeFloat &&
               image.spec().channelformats.empty() && image.roi().contains(m_region)),
      m_values(size_t(region.width()) * m_channels.size()) {}

void PixelRows::gather(const float* pixel, size_t stride, int first) {
    const size_t count = m_channels.size();
    for (size_t c = 0; c < count; ++c) {
        const float* from = pixel + (m_channels[c] - first);
        for (size_t i = c; i < m_values.size(); i += count, from += stride)
            m_values[i] = *from;
    }
}

const std::vector<float>& PixelRows::read(int y) {
    if (m_floats) {
        gather(static_cast<const float*>(m_image.pixeladdr(m_region.xbegin, y, m_region.zbegin)),
               size_t(m_image.pixel_stride()) / sizeof(float), 0);
        return m_values;
    }
    OIIO::ROI row = m_region;
    row.ybegin = y;
    row.yend = y + 1;
    m_read.resize(size_t(row.width()) * size_t(row.nchannels()));
    if (!m_image.get_pixels(row, OIIO::TypeFloat, m_read.data()))
        throw std::runtime_error(m_image.geterror());
    gather(m_read.data(), size_t(row.nchannels()), row.chbegin);
    return m_values;
}

void half_bits(const std::vector<float>& values, uint16_t* to) {
    std::transform(values.begin(), values.end(), to, half_of);
}

} // namespace tonetool::sequence
