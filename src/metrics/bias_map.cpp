// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "metrics/bias_grid.h"

namespace tonetool::metrics {
namespace {

using namespace bias;

constexpr double kLeastLog = -300;

using Values = std::array<double, 3>;

double smallest_p(const BiasScale& scale, size_t at) {
    double p = 1;
    for (const auto& channel : scale.channel)
        p = std::min(p, channel.p[at]);
    return p;
}

bool any_rejected(const BiasScale& scale, size_t at) {
    return std::any_of(std::begin(scale.channel), std::end(scale.channel),
                       [at](const auto& channel) { return channel.rejected[at] != 0; });
}

double over(double value, double base) {
    if (base > 0)
        return value / base;
    return value == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), value);
}

using Place = std::array<size_t, kBiasScales>; // the block of each scale

Values signed_at(const BiasResult& result, const Place& place) {
    size_t s = 0;
    while (s < kBiasScales && !any_rejected(result.scales[s], place[s]))
        ++s;
    const bool found = s < kBiasScales;
    const BiasScale& scale = result.scales[found ? s : 1];
    const size_t at = place[found ? s : 1];
    const BiasScale::Channel& channel = found ? *rejected_channel(scale, at) : scale.channel[0];
    const double base = std::max(channel.level[at], result.dark);
    return {over(channel.mean[at], base), over(scale.t_alpha * channel.se[at], base),
            1 - channel.p[at]};
}

Values p_at(const BiasResult& result, const Place& place) {
    Values out{};
    for (size_t s = 0; s < kBiasScales; ++s)
        out[s] = std::max(std::log10(smallest_p(result.scales[s], place[s])), kLeastLog);
    return out;
}

Values rejected_at(const BiasResult& result, const Place& place) {
    int means = 0, structures = 0, tested = 0;
    bool structure = false;
    for (size_t s = 0; s < kBiasScales; ++s) {
        const BiasScale& scale = result.scales[s];
        means += any_rejected(scale, place[s]);
        tested += scale.channel[0].tested[place[s]];
        structure = structure || !scale.structure_p.empty();
        if (!scale.structure_rejected.empty())
            structures += scale.structure_rejected[place[s]];
    }
    return {double(means || tested ? means : -1), double(structure ? structures : -1)};
}

// Of pictures that were not judged: equal by every pixel, or too small.
Values without_tests(const BiasResult& result, BiasMap map) {
    if (map != BiasMap::Rejected || result.reason != BiasReason::TooSmall)
        return {};
    return {-1, -1};
}

Values at(const BiasResult& result, BiasMap map, const Place& place) {
    switch (map) {
    case BiasMap::Signed:
        return signed_at(result, place);
    case BiasMap::P:
        return p_at(result, place);
    case BiasMap::Rejected:
        break;
    }
    return rejected_at(result, place);
}

// For every place among the cells, the block that it is in.
std::vector<size_t> block_of_cells(const std::vector<int>& first) {
    std::vector<size_t> out;
    for (size_t block = 0; block + 1 < first.size(); ++block)
        out.resize(size_t(first[block + 1]), block);
    return out;
}

// Every value is constant over a cell.
class CellMap {
public:
    CellMap(const BiasResult& result, BiasMap map)
        : m_result(result),
          m_map(map),
          m_cells(result.width, result.height) {
        for (size_t s = 0; s < kBiasScales; ++s) {
            m_columns[s] = block_of_cells(m_cells.scale[s].x);
            m_rows[s] = block_of_cells(m_cells.scale[s].y);
        }
    }
    int rows() const { return m_cells.grid.rows(); }

    void row(size_t row, float* out, int step) const {
        const Grid& grid = m_cells.grid;
        const int channels = bias_map_channels(m_map);
        for (size_t column = 0; column < size_t(grid.columns()); ++column) {
            Place place{};
            for (size_t s = 0; s < kBiasScales; ++s)
                place[s] = m_cells.scale[s].grid.at(int(m_columns[s][column]), int(m_rows[s][row]));
            const Values values = at(m_result, m_map, place);
            for (ptrdiff_t y = grid.y[row]; y < grid.y[row + 1]; ++y) {
                float* pixel = out + (y * m_result.width + grid.x[column]) * step;
                for (int x = grid.x[column]; x < grid.x[column + 1]; ++x, pixel += step)
                    for (int c = 0; c < channels; ++c)
                        pixel[c] = float(values[size_t(c)]);
            }
        }
    }

private:
    const BiasResult& m_result;
    const BiasMap m_map;
    const Cells m_cells;
    std::array<std::vector<size_t>, kBiasScales> m_columns, m_rows;
};

} // namespace

const BiasScale::Channel* rejected_channel(const BiasScale& scale, size_t at) {
    if (!any_rejected(scale, at))
        return nullptr;
    return std::min_element(std::begin(scale.channel), std::end(scale.channel),
                            [at](const auto& a, const auto& b) { return a.p[at] < b.p[at]; });
}

void bias_map(const BiasResult& result, BiasMap map, float* out, int step,
              const kernels::ParallelFor& parallel) {
    if (result.judged) {
        const CellMap cells(result, map);
        parallel(cells.rows(), [&](int64_t row) { cells.row(size_t(row), out, step); });
        return;
    }
    const Values none = without_tests(result, map);
    for (int64_t i = 0; i < int64_t(result.width) * result.height; ++i)
        for (int c = 0; c < bias_map_channels(map); ++c)
            out[i * step + c] = float(none[size_t(c)]);
}

} // namespace tonetool::metrics
