// SPDX-License-Identifier: BSD-3-Clause
// Which objects cover each pixel, and how much of it: Cryptomatte 1.2.0, decoded.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "metrics/light_ratio.h"

namespace tonetool::metrics {

/// The id of a name: MurmurHash3_x86_32 of its UTF-8 bytes, seed 0, with bit 23 flipped where as
/// the bits of a float it would be a denormal, an infinity or no number.
uint32_t cryptomatte_id(std::string_view name);

/// The objects in each pixel. Their coverages add up to 1: what is missing is kNone's.
class Coverage {
public:
    static constexpr uint32_t kNone = 0;
    struct Share {
        uint32_t id = kNone;
        double coverage = 0;
    };
    struct Row {
        std::vector<uint32_t> counts; ///< shares of each pixel
        std::vector<Share> shares;
    };

    /// Ranks are pairs of an id, by its bits, and its coverage, interleaved by pixel. Coverages
    /// that are NaN, infinite or negative are 0; where they add up to more than 1 all are divided.
    /// Where `ignored` is not 0, which may be null, a pixel has no share at all.
    static Row decode(const std::vector<float>& ranks, size_t pairs,
                      const uint8_t* ignored = nullptr);
    void add(const Row& row);

    size_t pixels() const { return m_ends.size(); }
    const Share* begin(size_t pixel) const {
        return m_shares.data() + (pixel > 0 ? m_ends[pixel - 1] : 0);
    }
    const Share* end(size_t pixel) const { return m_shares.data() + m_ends[pixel]; }
    /// Of an id in a pixel.
    double of(size_t pixel, uint32_t id) const;

private:
    std::vector<size_t> m_ends;
    std::vector<Share> m_shares;
};

/// The pictures beside two coverages.
struct CoveredPixels {
    size_t width = 0;
    const float* error = nullptr;     ///< of each pixel
    const float* reference = nullptr; ///< R, G, B of each pixel
    const float* test = nullptr;
};

/// One id in both: a and b its coverages of a pixel, E the error.
struct CoveragePair {
    uint32_t id = Coverage::kNone;
    double a = 0, b = 0;         ///< sums
    double error = 0;            ///< sum (a + b) / 2 E
    double gained = 0, lost = 0; ///< sums of b - a above and below 0
    double x[2] = {}, y[2] = {}; ///< sums of columns and rows, weighted by a and by b
    LightRatio light[3];         ///< of R, G, B, weighted by min(a, b)
    std::vector<std::pair<size_t, double>> changes; ///< pixels with |b - a| >= kChange, and that

    static constexpr double kChange = 0.5;
};

/// All ids of both, in ascending order.
std::vector<CoveragePair> compare_coverage(const Coverage& reference, const Coverage& test,
                                           const CoveredPixels& pixels);

} // namespace tonetool::metrics
