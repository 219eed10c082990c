// SPDX-License-Identifier: BSD-3-Clause
// Fingerprints of places of a picture: where two frames have the same, they show the same pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::metrics {

/// Of kSize x kSize pixels in the middle of each cell of a window. Pixels that are not in the
/// picture are black.
class FingerprintScan {
public:
    static constexpr int kSize = 4;

    FingerprintScan() = default;
    /// The window of the cells.
    FingerprintScan(int64_t x, int64_t y, int64_t width, int64_t height, size_t wide, size_t high);

    /// Whether the row takes part in any of them.
    bool wants(int64_t y) const;
    /// A row of interleaved colours, whose first pixel is at x. Rows are added from the top.
    void add_row(int64_t y, const std::vector<float>& rgb, int64_t x);
    /// By row, then column: 16 bits of a hash, at least 1; 0 where all pixels have one colour.
    std::vector<uint16_t> codes() const;

private:
    struct Point {
        uint64_t hash = 0;
        uint32_t first[3] = {0, 0, 0};
        bool constant = true;
        int rows = 0;
    };
    void add(Point& point, const std::vector<float>& rgb, int64_t at) const;

    std::vector<int64_t> m_columns, m_rows; ///< where the squares begin
    std::vector<Point> m_points;
};

} // namespace tonetool::metrics
