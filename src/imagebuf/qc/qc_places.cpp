// SPDX-License-Identifier: BSD-3-Clause
// What a scan keeps of the places of a picture: rectangles of one colour, and its borders.
#include <algorithm>
#include <cmath>

#include "imagebuf/qc/qc_scan.h"

namespace tonetool {
namespace {

using OIIO::ROI;

// Renderers write such a depth where there is nothing.
constexpr float kNothing = 1e9f;

} // namespace

void QcScan::scan_places(int y, const std::vector<float>& rgb, Row& row) const {
    const ROI& window = picture_window();
    const int64_t width = window.width();
    row.runs = metrics::scan_runs(rgb.data(), width, window.xbegin);
    row.values =
        metrics::scan_values(rgb.data(), width, m_values.values.size() < metrics::ValueScan::kMost);
    const auto depth = std::find_if(m_layers.begin(), m_layers.end(),
                                    [](const Layer& layer) { return layer.kind == "depth"; });
    if (depth != m_layers.end() && !row.runs.empty()) {
        const metrics::RowChannel values{m_reader.row_of(depth->part, y), depth->channels.front()};
        for (metrics::FlatRun& run : row.runs)
            for (int64_t x = run.x; x < run.x + run.width; ++x)
                run.background += !(values.at(x) < kNothing);
    }
    if (width > 1) {
        row.border = {metrics::same_color(&rgb[0], &rgb[3]),
                      metrics::same_color(&rgb[rgb.size() - 3], &rgb[rgb.size() - 6])};
    }
    if (y < window.ybegin + 2 || y >= window.yend - 2 || m_fingerprints.wants(y))
        row.colors = rgb;
}

void QcScan::add_places(int y, const Row& row) {
    if (row.picture.largest.empty())
        return;
    const ROI& window = picture_window();
    m_rectangle_scan.add_row(y, row.runs);
    m_values.add(row.values);
    for (size_t side = 0; side < 2; ++side)
        m_borders[side].add(y - window.ybegin, window.height(), row.border[side]);
    const auto compare = [&](metrics::BorderScan& border) {
        for (int64_t x = 0; x < window.width(); ++x)
            border.add(
                x, window.width(),
                metrics::same_color(&row.colors[3 * size_t(x)], &m_row_before[3 * size_t(x)]));
    };
    if (y == window.ybegin + 1)
        compare(m_borders[2]);
    if (y == window.yend - 1 && y > window.ybegin)
        compare(m_borders[3]);
    if (!row.colors.empty() && m_fingerprints.wants(y))
        m_fingerprints.add_row(y, row.colors, window.xbegin);
    m_row_before = row.colors;
}

// A black picture, or one of one colour, is another fault than a hole in it.
void QcScan::finish_places() {
    constexpr double all = 0.98;
    const ROI& window = picture_window();
    const double pixels = double(window.width()) * double(window.height());
    m_rectangles = m_rectangle_scan.finish(int64_t(std::ceil(all * pixels)));
}

} // namespace tonetool
