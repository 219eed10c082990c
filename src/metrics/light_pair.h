// SPDX-License-Identifier: BSD-3-Clause
// Two pictures of the same light with other noise: by how many stops one is brighter, and in how
// much of it they differ by more than their noise. Means over blocks, whose standard error follows
// from the differences of neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::metrics {

class LightPair {
public:
    static constexpr int64_t kSide = 16;

    LightPair() = default;
    /// What is left over at the right and at the bottom counts in the sums alone.
    LightPair(int64_t width, int64_t height, size_t channels);

    /// What one row adds: of each column of blocks and each channel four sums, and those of all.
    struct Row {
        std::vector<double> sums;
        double a = 0, b = 0;
        int64_t one_finite = 0;  ///< pixels that are finite in only one
        int64_t first = -1;      ///< column of the first of them
        int64_t both_finite = 0; ///< and in both
    };
    /// Rows of interleaved channels. Pixels that are not finite in one of them count in neither.
    Row scan(const std::vector<float>& a, const std::vector<float>& b) const;
    void add(int64_t y, const Row& row);

    struct Result {
        double gain = 0;          ///< stops by which b is brighter; 0 unless median and sum agree
        double one_finite = 0;    ///< share of the pixels that are finite in only one
        bool none_finite = false; ///< no pixel is finite in both, so nothing was compared
        double blocks = 0;        ///< share of the blocks that differ by more than their noise
        int64_t x = 0, y = 0;     ///< the pixel where the block begins that differs most
        /// The first pixel that is finite in only one, by rows.
        int64_t one_finite_x = 0, one_finite_y = 0;
    };
    Result result() const;

private:
    struct Block {
        double a = 0, b = 0, error = 0; ///< means, and the standard error of their difference
    };
    Block block(size_t at, size_t channel) const;
    double mean_of_a() const;
    double gain(double mean_a) const;

    int64_t m_width = 0, m_height = 0;
    size_t m_channels = 0, m_columns = 0, m_rows = 0;
    std::vector<double> m_sums; ///< a, b, squared differences of neighbours in a, in b
    int64_t m_one_finite = 0, m_both_finite = 0;
    int64_t m_first_x = 0, m_first_y = 0; ///< the first pixel that is finite in only one
    double m_a = 0, m_b = 0;              ///< sums of absolute values of all pixels
};

} // namespace tonetool::metrics
