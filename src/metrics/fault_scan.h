// What is looked for in the pixels of a picture that may be broken: rows in, sums and places out.
// Rows are scanned on their own and added up in their order, so that threads do not matter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::metrics {

struct Hit {
    int64_t x = 0, y = 0;
    double value = 0;
};

/// Pixels that have something, and the first few.
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

/// A layer, but for its alpha, which only counts where it is no number.
struct LayerScan {
    Hits nan, inf, negative; ///< pixels where any channel is
    int64_t finite = 0, lit = 0;
    double sum = 0;                ///< weighted, of finite pixels
    std::vector<double> low, high; ///< of each channel

    void add(const LayerScan& later);
    double min() const;
    double max() const;
    /// Each channel has one value, and is finite.
    bool constant() const;
};
/// `alpha`: its channel; -1 if it has none.
LayerScan scan_layer(const ChannelRow& row, const std::vector<int>& channels,
                     const std::vector<double>& weights, int alpha = -1);

struct RangeScan {
    Hits below, above;
    void add(const RangeScan& later);
};
/// Finite values of one channel beyond [low, high].
RangeScan scan_range(const ChannelRow& row, int channel, double low, double high);

/// A pixel that is much larger than all that are kReach away, and the largest on the way.
struct Spike {
    static constexpr int kReach = 3;
    static constexpr float kTimes = 8;
    int64_t x = 0, y = 0;
    double value = 0, around = 0;
};
/// Spikes of a row among its neighbours kReach above and below (null where there are none).
void find_spikes(const float* const (&rows)[2 * Spike::kReach + 1], int64_t width, int64_t x,
                 int64_t y, std::vector<Spike>& out);
/// The `most` largest of them, by value, then place.
void keep_largest(std::vector<Spike>& spikes, size_t most);

/// Whether light groups add up to a picture. Pixels at the picture's largest component may be
/// clamped: they count only where there are no others.
class GroupScan {
public:
    /// Adds a pixel of the picture and the sum of its groups.
    void add(const float (&picture)[3], const double (&groups)[3], int64_t x, int64_t y);
    void add(const GroupScan& later);

    double sum() const;        ///< light of the groups over that of the picture
    double difference() const; ///< sum of absolute differences, over the same
    Hit worst() const { return chosen().worst; }

private:
    struct Sums {
        double picture = 0, groups = 0, off = 0;
        Hit worst;
        void add(const Sums& later);
    };
    const Sums& chosen() const { return m_below.picture > 0 ? m_below : m_at; }

    float m_ceiling = -1;
    Sums m_below, m_at;
};

/// Sums over the cells of a grid in one row.
struct CellRow {
    std::vector<double> sum;
    std::vector<float> largest;
    std::vector<int64_t> missing; ///< pixels that are not finite
};

/// Where a picture is looked at as a viewer does.
struct PictureRow {
    std::vector<float> largest; ///< component of each pixel, 0 where it is not finite
    CellRow cells;
};
/// Of interleaved colours. `cell_of` gives the cell of each pixel, or -1.
PictureRow scan_picture(const float* rgb, int64_t width, const double (&weights)[3],
                        const int* cell_of, size_t cells);

} // namespace tonetool::metrics
