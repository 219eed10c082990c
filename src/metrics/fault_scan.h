// SPDX-License-Identifier: BSD-3-Clause
// The measurements behind --qc: rows of pixels in, sums and positions of bad pixels out. Rows are
// scanned one by one and added up in their order, so results do not depend on threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::metrics {

struct Hit {
    int64_t x = 0, y = 0;
    double value = 0;
};

/// The number of pixels that have a property, and the first few of them.
struct Hits {
    static constexpr size_t kMost = 4;
    int64_t pixels = 0;
    std::vector<Hit> first;

    void add(const Hit& hit);
    void add(const Hits& later);
};

/// Some channels of one row of interleaved pixels.
struct ChannelRow {
    const float* pixels = nullptr;
    int stride = 1; ///< channels in a pixel
    int64_t width = 0, x = 0, y = 0;
};

/// A layer. Its alpha counts only where it is NaN.
struct LayerScan {
    Hits nan, inf, negative; ///< pixels where any channel is
    int64_t finite = 0, lit = 0;
    double sum = 0;                ///< weighted, of finite pixels
    std::vector<double> low, high; ///< of each channel

    void add(const LayerScan& later);
    double min() const;
    double max() const;
    /// Whether every channel has the same finite value in all pixels.
    bool constant() const;
};
/// `alpha`: the layer's alpha channel; -1 if it has none.
LayerScan scan_layer(const ChannelRow& row, const std::vector<int>& channels,
                     const std::vector<double>& weights, int alpha = -1);

struct RangeScan {
    Hits below, above;
    void add(const RangeScan& later);
};
/// Finds the finite values of one channel beyond [low, high].
RangeScan scan_range(const ChannelRow& row, int channel, double low, double high);

/// A firefly: a pixel that is kTimes as large as all pixels at the distance kRadius, and larger
/// than those in between. `around` is the neighbourhood maximum.
struct Spike {
    static constexpr int kRadius = 3;
    static constexpr float kTimes = 8;
    int64_t x = 0, y = 0;
    double value = 0, around = 0;
};
/// Finds the fireflies of the middle row; the other rows are those up to kRadius above and below it
/// (null outside the image).
void find_spikes(const float* const (&rows)[2 * Spike::kRadius + 1], int64_t width, int64_t x,
                 int64_t y, std::vector<Spike>& out);
/// Keeps the `most` largest fireflies, by value, then position.
void keep_largest(std::vector<Spike>& spikes, size_t most);

/// One channel of a row; 0 where the row has no pixel.
struct RowChannel {
    ChannelRow row;
    int channel = 0;
    float at(int64_t x) const {
        const bool inside = row.pixels && x >= row.x && x < row.x + row.width;
        return inside ? row.pixels[(x - row.x) * row.stride + channel] : 0;
    }
};

/// Whether light groups add up to the beauty. Pixels at the beauty's largest component may be
/// clamped: they count only where there are no others.
class GroupScan {
public:
    /// Adds a row of the beauty; `groups` are the red, green and blue of one group after the other.
    void add_row(const RowChannel (&picture)[3], const std::vector<RowChannel>& groups);
    void add(const GroupScan& later);

    double sum() const;        ///< light of the groups divided by that of the beauty
    double difference() const; ///< sum of absolute differences, divided by the same
    Hit worst() const { return chosen().worst; }

private:
    struct Sums {
        double picture = 0, groups = 0, off = 0;
        Hit worst;
        void add(const Sums& later);
    };
    // Adds a pixel of the beauty and the sum of its groups.
    void add(const float (&picture)[3], const double (&groups)[3], int64_t x, int64_t y);
    const Sums& chosen() const { return m_below.picture > 0 ? m_below : m_at; }

    float m_ceiling = -1;
    Sums m_below, m_at;
};

/// The columns of cells that the pixels of a row fall into, or -1: of the thumbnail, and of the
/// peaks.
struct CellColumns {
    std::vector<int> cell, peak;
    size_t cells = 0, peaks = 0;
};

/// Sums over the cells that one row of a thumbnail crosses.
struct CellRow {
    std::vector<double> light, color; ///< of colours the red, green and blue of each cell
    std::vector<float> peaks;         ///< the largest components
    std::vector<int64_t> missing;     ///< pixels that are not finite
};

/// The beauty as the thumbnail sees it.
struct PictureRow {
    std::vector<float> largest; ///< component of each pixel, 0 where it is not finite
    std::vector<float> light;   ///< luminance of each pixel, 0 where it is not finite
    CellRow cells;
};
/// Adds a row of interleaved colours.
PictureRow scan_picture(const float* rgb, int64_t width, const double (&weights)[3],
                        const CellColumns& columns);

} // namespace tonetool::metrics
