// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/calibration.h"

#include <algorithm>
#include <cmath>

namespace tonetool::tonemap {
namespace {

// The cells [first, last] that a pixel of an axis touches, and the share of the pixel in the first
// one. Cells are no narrower than pixels, so that there are two at most.
struct Cover {
    int first, last;
    double share;
};

Cover cover(int pixel, int pixels, int cells) {
    const double scale = double(cells) / pixels;
    const double from = pixel * scale, to = (pixel + 1) * scale;
    const int first = std::min(int(from), cells - 1);
    const int last = std::min(int(std::ceil(to)) - 1, cells - 1);
    if (last <= first)
        return {first, first, 1.0};
    return {first, last, (first + 1 - from) / (to - from)};
}

// The position of a pixel between the centres of two cells of an axis.
struct Between {
    int first, second;
    double share; ///< of the second
};

Between between(int pixel, int pixels, int cells) {
    const double at = (pixel + 0.5) * cells / pixels - 0.5;
    const double low = std::floor(at);
    return {std::clamp(int(low), 0, cells - 1), std::clamp(int(low) + 1, 0, cells - 1), at - low};
}

} // namespace

double auto_key(double mean) {
    return 1.03 - 2.0 / (2.0 + std::log10(1.0 + mean));
}

double gain(double key, double mean) {
    return std::max(key / std::max(mean, kLeastMean), kLeastGain);
}

int LocalMeans::most_levels(int width, int height) {
    int level = 0;
    while ((2 << level) <= std::min(width, height))
        ++level;
    return level;
}

LocalMeans::LocalMeans(const float* plane, int width, int height, int level, double epsilon,
                       const kernels::ParallelFor& parallel)
    : m_width(width),
      m_height(height),
      m_cells(1 << level) {
    const auto cells = size_t(m_cells);
    std::vector<Sum> rows(cells * size_t(height));
    parallel(height, [&](int64_t y) {
        add_row(plane + y * width, epsilon, rows.data() + size_t(y) * cells);
    });
    add_up(rows);
}

void LocalMeans::add_row(const float* row, double epsilon, Sum* cells) const {
    for (int x = 0; x < m_width; ++x) {
        if (std::isnan(row[x]))
            continue;
        const double log = std::log(double(row[x]) + epsilon);
        const Cover c = cover(x, m_width, m_cells);
        cells[c.first].logs += c.share * log;
        cells[c.first].weight += c.share;
        if (c.last != c.first) {
            cells[c.last].logs += (1 - c.share) * log;
            cells[c.last].weight += 1 - c.share;
        }
    }
}

void LocalMeans::add_up(const std::vector<Sum>& rows) {
    const auto cells = size_t(m_cells);
    std::vector<Sum> sums(cells * cells);
    Sum all;
    for (int y = 0; y < m_height; ++y) {
        const Cover c = cover(y, m_height, m_cells);
        for (size_t x = 0; x < cells; ++x) {
            const Sum& row = rows[size_t(y) * cells + x];
            all.logs += row.logs;
            all.weight += row.weight;
            Sum& first = sums[size_t(c.first) * cells + x];
            first.logs += c.share * row.logs;
            first.weight += c.share * row.weight;
            if (c.last != c.first) {
                Sum& last = sums[size_t(c.last) * cells + x];
                last.logs += (1 - c.share) * row.logs;
                last.weight += (1 - c.share) * row.weight;
            }
        }
    }
    // The shares of a pixel add up to 1 within rounding.
    m_pixels = std::llround(all.weight);
    const double whole = m_pixels > 0 ? all.logs / all.weight : 0;
    m_mean = m_pixels > 0 ? std::exp(whole) : 0;
    for (const Sum& sum : sums)
        m_logs.push_back(sum.weight > 0 ? sum.logs / sum.weight : whole);
}

void LocalMeans::row(int y, double* out) const {
    const Between v = between(y, m_height, m_cells);
    const double* upper = m_logs.data() + ptrdiff_t(v.first) * m_cells;
    const double* lower = m_logs.data() + ptrdiff_t(v.second) * m_cells;
    for (int x = 0; x < m_width; ++x) {
        const Between h = between(x, m_width, m_cells);
        const double above = upper[h.first] + h.share * (upper[h.second] - upper[h.first]);
        const double below = lower[h.first] + h.share * (lower[h.second] - lower[h.first]);
        out[x] = std::exp(above + v.share * (below - above));
    }
}

} // namespace tonetool::tonemap
