// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/curve_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tonetool::kernels {

CurveTable::CurveTable(TableRows rows) : m_rows(std::move(rows)) {
    const size_t count = m_rows.x.size();
    size_t entries = 2;
    while (entries < count)
        entries *= 2;
    m_knots.assign(entries, std::numeric_limits<float>::infinity());
    for (size_t i = 0; i < count; ++i)
        m_knots[i] = float(m_rows.x[i]);
    for (size_t c = 0; c < 3; ++c) {
        const auto& y = m_rows.y[c];
        m_values[c].assign(entries, float(y.back()));
        m_slopes[c].assign(entries, 0.0f); // the last row's is held
        for (size_t i = 0; i < count; ++i)
            m_values[c][i] = float(y[i]);
        for (size_t i = 0; i + 1 < count; ++i) {
            // Rows that are one in float have no line between them.
            const double run = double(m_knots[i + 1]) - double(m_knots[i]);
            const double slope = run > 0 ? (y[i + 1] - y[i]) / run : 0;
            constexpr double most = std::numeric_limits<float>::max();
            m_slopes[c][i] = float(std::clamp(slope, -most, most));
        }
    }
}

double CurveTable::at(size_t channel, double x) const {
    const auto& knots = m_rows.x;
    const auto& y = m_rows.y[channel];
    const double u = m_rows.log2 ? std::log2(x) : x;
    if (!(u > knots.front()))
        return y.front();
    if (u >= knots.back())
        return y.back();
    const auto above = std::upper_bound(knots.begin(), knots.end(), u);
    const auto i = size_t(above - knots.begin());
    const double share = (u - knots[i - 1]) / (knots[i] - knots[i - 1]);
    return y[i - 1] + share * (y[i] - y[i - 1]);
}

} // namespace tonetool::kernels
