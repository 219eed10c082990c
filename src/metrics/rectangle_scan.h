// SPDX-License-Identifier: BSD-3-Clause
// Rectangles of one exact colour, which a renderer's noise never makes: buckets that were not
// rendered, rows that were not written, matte bars. Rows are cut into runs, and runs one below the
// other are a rectangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::metrics {

/// Pixels of one row that have one exact colour. NaN is equal to NaN, -0 to 0.
struct FlatRun {
    static constexpr int64_t kShortest = 8;
    int64_t x = 0, width = 0;
    std::array<uint32_t, 3> color{}; ///< the bits of its floats, with one NaN and no -0
    int64_t background = 0;          ///< pixels with nothing behind them

    bool is_above(const FlatRun& below) const {
        return x == below.x && width == below.width && color == below.color;
    }
};
/// The maximal runs of a row of interleaved colours, of at least kShortest pixels.
std::vector<FlatRun> scan_runs(const float* rgb, int64_t width, int64_t x);

struct FlatRectangle {
    static constexpr int64_t kLowest = 8;
    FlatRun run; ///< its background: of all rows
    int64_t y = 0, height = 0;
    int64_t pixels() const { return run.width * height; }
};

/// Rectangles of at least kLowest rows with the same run. Rows are added from the top.
class RectangleScan {
public:
    explicit RectangleScan(size_t most) : m_most(most) {}

    void add_row(int64_t y, const std::vector<FlatRun>& runs);
    /// After the last row: the largest of those that have fewer pixels than this, at most as many
    /// as were asked for, by row, then column.
    std::vector<FlatRectangle> finish(int64_t pixels);

private:
    void close(const FlatRectangle& rectangle);
    void keep_largest(size_t most);

    size_t m_most;
    std::vector<FlatRectangle> m_open, m_closed; ///< the open ones from left to right
};

/// The share of pixels of a border that equal the pixel inside of them, in kParts parts of it: the
/// plain wall or sky at the end of a set goes on beyond the picture.
struct BorderScan {
    static constexpr int kParts = 32;
    std::array<int64_t, kParts> same{}, all{};
    void add(int64_t at, int64_t length, bool is_same);
    /// In per cent.
    std::array<int, kParts> shares() const;
};

/// Whether two colours are equal; NaN is not.
inline bool same_color(const float* a, const float* b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

} // namespace tonetool::metrics
