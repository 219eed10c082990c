// SPDX-License-Identifier: BSD-3-Clause
// A tone curve as a table: straight lines between its rows, ends held.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tonetool::kernels {

/// What a table is made of.
struct TableRows {
    std::vector<double> x;                ///< strictly rising; log2 of scene light if `log2`
    std::array<std::vector<double>, 3> y; ///< display light of R, G, B; all finite
    bool log2 = false;
};

/// The same rows in double, for the reference implementation, and in float, for the lanes.
class CurveTable {
public:
    explicit CurveTable(TableRows rows);

    const TableRows& rows() const { return m_rows; }
    /// Of scene light x >= 0, in double.
    double at(size_t channel, double x) const;

    // For the lanes: a power of two of entries, infinite ones behind the last row. Entry i holds
    // for knot i <= x < knot i + 1.
    size_t entries() const { return m_knots.size(); }
    const float* knots() const { return m_knots.data(); }
    const float* values(size_t channel) const { return m_values[channel].data(); }
    const float* slopes(size_t channel) const { return m_slopes[channel].data(); }

private:
    TableRows m_rows;
    std::vector<float> m_knots;
    std::array<std::vector<float>, 3> m_values, m_slopes;
};

} // namespace tonetool::kernels
