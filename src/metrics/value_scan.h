// SPDX-License-Identifier: BSD-3-Clause
// How exactly values repeat in a picture: from column to column where a smaller one was enlarged,
// all over it where it went through few bits, and at the top where it was clamped.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::metrics {

struct ValueScan {
    /// More different values are not counted.
    static constexpr size_t kMost = 1000;

    int64_t pixels = 0, lit = 0;
    std::array<int64_t, 2> pairs{}; ///< of neighbours in a row, the first in an even or odd column
    std::array<int64_t, 2> same{};  ///< those of them that are equal and lit
    int64_t greens = 0;             ///< pixels whose green is above 0.01 and below 1
    std::vector<float> values;      ///< the different ones of these, ascending; at most kMost
    /// Pixels that a clamp of each channel at 1 leaves: all channels lit, one of them exactly 1 and
    /// another not. Those beside: a channel has one of the two half floats next to 1, by chance.
    int64_t at_one = 0, beside_one = 0;
    int64_t at_largest_half = 0; ///< pixels with a channel at 65504

    void add(const ValueScan& later);
    /// The shares of equal pairs among those that are lit.
    std::array<double, 2> shares() const;
};
/// A row of interleaved colours; without `values` it only counts.
ValueScan scan_values(const float* rgb, int64_t width, bool values);

} // namespace tonetool::metrics
