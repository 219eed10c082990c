// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/fingerprints.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace tonetool::metrics {
namespace {

std::vector<int64_t> squares(int64_t from, int64_t size, size_t cells) {
    std::vector<int64_t> begins;
    for (size_t i = 0; i < cells; ++i)
        begins.push_back(from + (2 * int64_t(i) + 1) * size / (2 * int64_t(cells)) -
                         FingerprintScan::kSize / 2);
    return begins;
}

} // namespace

FingerprintScan::FingerprintScan(int64_t x, int64_t y, int64_t width, int64_t height, size_t wide,
                                 size_t high)
    : m_columns(squares(x, width, wide)),
      m_rows(squares(y, height, high)),
      m_points(wide * high) {}

bool FingerprintScan::wants(int64_t y) const {
    return std::any_of(m_rows.begin(), m_rows.end(),
                       [&](int64_t begin) { return y >= begin && y < begin + kSize; });
}

// The multiplier and the increment of a linear congruential generator (Knuth, MMIX).
void FingerprintScan::add(Point& point, const std::vector<float>& rgb, int64_t at) const {
    constexpr uint64_t multiplier = 6364136223846793005U, increment = 1442695040888963407U;
    const auto width = int64_t(rgb.size() / 3);
    for (int64_t x = at; x < at + kSize; ++x) {
        std::array<uint32_t, 3> bits{};
        if (x >= 0 && x < width)
            std::memcpy(bits.data(), &rgb[3 * size_t(x)], sizeof bits);
        const bool is_first = point.rows == 0 && x == at;
        for (size_t c = 0; c < 3; ++c) {
            point.hash = (point.hash + bits[c]) * multiplier + increment;
            if (is_first)
                point.first[c] = bits[c];
            point.constant = point.constant && bits[c] == point.first[c];
        }
    }
    ++point.rows;
}

void FingerprintScan::add_row(int64_t y, const std::vector<float>& rgb, int64_t x) {
    for (size_t j = 0; j < m_rows.size(); ++j) {
        if (y < m_rows[j] || y >= m_rows[j] + kSize)
            continue;
        for (size_t i = 0; i < m_columns.size(); ++i)
            add(m_points[j * m_columns.size() + i], rgb, m_columns[i] - x);
    }
}

std::vector<uint16_t> FingerprintScan::codes() const {
    std::vector<uint16_t> codes;
    for (const Point& point : m_points) {
        const auto code = uint16_t((point.hash >> 33) & 0xffff);
        const bool is_known = !point.constant && point.rows == kSize;
        codes.push_back(is_known ? std::max<uint16_t>(code, 1) : uint16_t(0));
    }
    return codes;
}

} // namespace tonetool::metrics
