// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/guided_tile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tonetool::kernels {
namespace {

constexpr ptrdiff_t kLine = 16; // floats of a line of the cache

ptrdiff_t whole_lines(ptrdiff_t n) {
    return (n + kLine - 1) / kLine * kLine;
}

// Runs that windows of so many columns can touch.
ptrdiff_t run_columns(int columns) {
    return (columns + 2 * kGuidedRun - 2) / kGuidedRun * kGuidedRun;
}

ptrdiff_t pitch_of(const TapSets& taps, int columns) {
    // A vector is written beyond the last column.
    return run_columns(columns) + 2 * taps.most_before() + 2 * whole_lines(taps.half()) + kLine;
}

size_t floats(const GuidedLayout& layout, const TapSets& taps) {
    return size_t(layout.pitch) * size_t(layout.planes()) * size_t(2 * taps.half() + 1);
}

GuidedLayout layout_of(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                       int columns) {
    GuidedLayout layout(image, terms);
    layout.pitch = pitch_of(taps, columns);
    return layout;
}

} // namespace

GuidedTile::GuidedTile(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                       int columns)
    : m_image(image),
      m_taps(taps),
      m_rows(guided_rows()),
      m_layout(layout_of(image, terms, taps, columns)),
      m_scales(image, terms),
      m_lead(whole_lines(taps.half())),
      m_data(hwy::AllocateAligned<float>(floats(m_layout, taps))),
      m_table(size_t(2 * taps.half() + 1)),
      m_filtered(size_t(columns)) {}

size_t GuidedTile::bytes(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                         int columns) {
    return floats(layout_of(image, terms, taps, columns), taps) * sizeof(float);
}

float* GuidedTile::row_of(int y) const {
    const int rows = 2 * m_taps.half() + 1;
    return m_data.get() + ((y % rows + rows) % rows) * m_layout.planes() * m_layout.pitch;
}

// Row y in the columns of the tile and `half` beside them.
void GuidedTile::prepare(int y, int x0, int columns) {
    const int half = m_taps.half();
    float* const row = row_of(y) + m_lead - half;
    const ptrdiff_t first = x0 - half, end = ptrdiff_t(x0) + columns + half;
    const ptrdiff_t from = std::max<ptrdiff_t>(first, 0);
    const ptrdiff_t to = std::min<ptrdiff_t>(end, m_image.width);
    if (y < 0 || y >= m_image.height || from >= to)
        return m_rows.prepare_outside(m_layout, end - first, row);
    const ptrdiff_t at = (y - m_image.first_row) * m_image.stride + from;
    m_rows.prepare(m_image, m_layout, m_scales, at, to - from, row + (from - first));
    m_rows.prepare_outside(m_layout, from - first, row);
    m_rows.prepare_outside(m_layout, end - to, row + (to - first));
}

// Calls run() on the rows of a window while those around them are prepared.
void GuidedTile::each_row(const Window& window, const std::function<void(int y, int x0)>& run) {
    const int half = m_taps.half(), before = m_taps.most_before();
    const int x0 = window.x0 / kGuidedRun * kGuidedRun - before;
    const int end = window.x0 + window.width + before;
    const int runs = (end - x0 + kGuidedRun - 1) / kGuidedRun;
    for (int y = window.y0 - half; y < window.y0 + half; ++y)
        prepare(y, x0, runs * kGuidedRun);
    for (int y = window.y0; y < window.y0 + window.height; ++y) {
        prepare(y + half, x0, runs * kGuidedRun);
        for (int dy = -half; dy <= half; ++dy)
            *(m_table.begin() + dy + half) = row_of(y + dy) + m_lead;
        run(y, x0);
    }
}

void GuidedTile::filter(const Window& window, const GuidedRow& row) {
    each_row(window, [&](int y, int x0) {
        filter_row(y, window, x0, m_filtered.data(), nullptr);
        row(window.x0, y, window.width, m_filtered.data());
    });
}

void GuidedTile::moments(const Window& window, const MomentsRow& row) {
    m_variance.resize(m_filtered.size());
    each_row(window, [&](int y, int x0) {
        filter_row(y, window, x0, m_filtered.data(), m_variance.data());
        row(window.x0, y, window.width, m_filtered.data(), m_variance.data());
    });
}

// Prefetches a run of a row, and at the ends of the tile what is beside it: spread over the time
// that a row takes, this costs nothing.
void GuidedTile::fetch(int y, int x, bool leftmost, bool rightmost) const {
    const int from = std::max(0, leftmost ? x - m_taps.half() : x);
    const int to = std::min(m_image.width, x + kGuidedRun + (rightmost ? m_taps.half() : 0));
    if (y < m_image.height && from < to)
        m_rows.fetch(m_image, (y - m_image.first_row) * m_image.stride + from, to - from);
}

bool GuidedTile::counts(float value, float range) const {
    constexpr float largest = std::numeric_limits<float>::max();
    return value >= m_scales.least && value <= largest && std::abs(range) <= largest;
}

void GuidedTile::filter_row(int y, const Window& window, int x0, float* out, float* variance) {
    alignas(64) float means[kGuidedRun], variances[kGuidedRun];
    const int end = window.x0 + window.width;
    const float* const values = m_image.value + (y - m_image.first_row) * m_image.stride;
    const float* const range = m_image.range ? m_image.range + (values - m_image.value) : nullptr;
    const int first = m_taps.run_of(window.x0, y);
    for (int x = first; x < end; x += kGuidedRun) {
        const auto& taps = m_taps.at(std::max(x, 0), y);
        if (y + 1 < window.y0 + window.height)
            fetch(y + m_taps.half() + 1, x, x == first, x + kGuidedRun >= end);
        const GuidedRun run{m_table.data() + m_taps.half(), x - x0, m_layout.pitch, taps.data(),
                            ptrdiff_t(taps.size())};
        if (variance)
            m_rows.moments(m_layout, m_scales, run, means, variances);
        else
            m_rows.filter(m_layout, m_scales, run, means);
        for (int i = std::max(x, window.x0); i < std::min(x + kGuidedRun, end); ++i) {
            const bool valid = counts(values[i], range ? range[i] : 0);
            out[i - window.x0] = valid ? means[i - x] : values[i];
            if (variance)
                variance[i - window.x0] = valid ? variances[i - x] : 0;
        }
    }
}

} // namespace tonetool::kernels
