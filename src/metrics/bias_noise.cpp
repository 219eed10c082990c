// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/bias_noise.h"

#include <algorithm>
#include <cmath>

namespace tonetool::metrics::bias {
namespace {

double median(std::vector<double> values) {
    if (values.empty())
        return 0;
    const auto middle = values.begin() + ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2)
        return *middle;
    return 0.5 * (*std::max_element(values.begin(), middle) + *middle);
}

// Luminance of d without the means of its 32-blocks, a row at a time.
class Residuals {
public:
    Residuals(Pixels& pixels, const Sums& sums)
        : m_pixels(pixels),
          m_sums(sums),
          m_grid(sums.cells.scale[1].grid),
          m_r(size_t(pixels.width())),
          m_t(size_t(pixels.width())) {}

    /// Row y, of this row of blocks.
    void row(int y, int block_row, std::vector<double>& out) {
        if (block_row != m_row) {
            m_row = block_row;
            m_means.clear();
            for (int column = 0; column < m_grid.columns(); ++column)
                m_means.push_back(block_sums(m_sums, 0, 1, column, block_row).mean);
        }
        m_pixels.luminance(y, m_r.data(), m_t.data());
        for (size_t column = 0; column < m_means.size(); ++column)
            for (auto x = size_t(m_grid.x[column]); x < size_t(m_grid.x[column + 1]); ++x)
                out[x] = (m_t[x] - m_r[x]) - m_means[column];
        const uint8_t* ignored = m_pixels.ignored(y);
        for (size_t x = 0; ignored && x < out.size(); ++x)
            out[x] = ignored[x] != 0 ? 0 : out[x];
    }

private:
    Pixels& m_pixels;
    const Sums& m_sums;
    const Grid& m_grid;
    std::vector<double> m_r, m_t, m_means;
    int m_row = -1;
};

// Sums of e(x) (e(x + 1) + e below) of the blocks of one row. The last column and the last row of
// the image have one neighbour only.
void lag_products(const std::vector<double>& e, const std::vector<double>* below,
                  const std::vector<int>& edges, double* out) {
    for (size_t column = 0; column + 1 < edges.size(); ++column) {
        const auto first = size_t(edges[column]), end = size_t(edges[column + 1]);
        double right[2] = {}, down[2] = {};
        const size_t pairs = std::min(end, e.size() - 1);
        for (size_t x = first; x < pairs; ++x)
            right[x % 2] += e[x] * e[x + 1];
        for (size_t x = first; below && x < end; ++x)
            down[x % 2] += e[x] * (*below)[x];
        out[column] += (right[0] + right[1]) + (down[0] + down[1]);
    }
}

} // namespace

// Squared differences of neighbours are noise, where texture cancels between the sides: v_T and v_R
// are sums over the same places, and their difference over v_d, which is free of texture, is
// (noise of T - noise of R) / (noise of T + noise of R). One decision for the image: decided by
// block it would follow the noise.
double asymmetry(const Sums& sums) {
    std::vector<double> values;
    for (const PairSums& v : sums.pairs)
        if (v.d > 0)
            values.push_back(std::clamp((v.t - v.r) / v.d, -1.0, 1.0));
    return median(std::move(values));
}

// Energy that rare paths have not brought yet is missing in most blocks of the noisier side:
// against a converged reference most of the image is darker. What those that were seen bring, times
// an upper limit (99 %) of how many were to be expected over how many were seen: k + 2.33 sqrt(k +
// 1) + 2.7 is about that of a Poisson distribution's mean.
std::array<double, kBiasChannels> firefly_shares(const Sums& sums, int unlike) {
    std::array<double, kBiasChannels> out{};
    for (size_t c = 0; c < kBiasChannels; ++c) {
        double light = 0, clean = 0, k = 0;
        for (const ChannelSums& cell : sums.channel[c]) {
            light += cell.outlier_light;
            k += double(cell.outliers);
            clean += clean_sum(cell, unlike);
        }
        if (k > 0 && clean > 0)
            out[c] = light / clean * (k + 2.33 * std::sqrt(k + 1) + 2.7) / k;
    }
    return out;
}

// As lag_products(), of 1 where a pixel counts: how many products there are.
std::vector<double> counted_pairs(const Pixels& pixels, const Grid& grid) {
    std::vector<double> out(grid.count());
    const auto row_of = [&](int y) {
        const uint8_t* ignored = pixels.ignored(y);
        std::vector<double> row(size_t(pixels.width()));
        std::transform(ignored, ignored + row.size(), row.begin(),
                       [](uint8_t one) { return double(one == 0); });
        return row;
    };
    for (int row = 0; row < grid.rows(); ++row)
        for (int y = grid.y[size_t(row)]; y < grid.y[size_t(row) + 1]; ++y) {
            const std::vector<double> here = row_of(y);
            const std::vector<double> below = y + 1 < pixels.height() ? row_of(y + 1) : here;
            lag_products(here, y + 1 < pixels.height() ? &below : nullptr, grid.x,
                         out.data() + grid.at(0, row));
        }
    return out;
}

double neighbour_correlation(Pixels& pixels, const Sums& sums,
                             const kernels::ParallelFor& parallel) {
    const Grid& grid = sums.cells.scale[1].grid;
    std::vector<double> products(grid.count());
    parallel(grid.rows(), [&](int64_t row) {
        Residuals residuals(pixels, sums);
        std::vector<double> e(size_t(pixels.width())), next(size_t(pixels.width()));
        const int first = grid.y[size_t(row)], end = grid.y[size_t(row) + 1];
        residuals.row(first, int(row), e);
        for (int y = first; y < end; ++y) {
            const bool last = y + 1 == pixels.height();
            if (!last)
                residuals.row(y + 1, int(row) + (y + 1 == end), next);
            lag_products(e, last ? nullptr : &next, grid.x, products.data() + grid.at(0, int(row)));
            std::swap(e, next);
        }
    });
    const auto pairs = pixels.ignored(0) ? counted_pairs(pixels, grid) : std::vector<double>();
    std::vector<double> values;
    for (int row = 0; row < grid.rows(); ++row)
        for (int column = 0; column < grid.columns(); ++column) {
            const ChannelSums block = block_sums(sums, 0, 1, column, row);
            const size_t at = grid.at(column, row);
            double part = 0.5; // of two neighbours of each pixel
            if (!pairs.empty())
                part = pairs[at] > 0 ? block.pixels() / pairs[at] : 0;
            if (block.m2 > 0 && part > 0)
                values.push_back(part * products[at] / block.m2);
        }
    return median(std::move(values));
}

} // namespace tonetool::metrics::bias
