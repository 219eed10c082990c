// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/bias_grid.h"

#include <algorithm>
#include <iterator>

namespace tonetool::metrics::bias {
namespace {

std::vector<int> joined(const std::vector<int>& a, const std::vector<int>& b) {
    std::vector<int> out;
    std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(out));
    return out;
}

// Of each edge, its place among all.
std::vector<int> places(const std::vector<int>& edges, const std::vector<int>& all) {
    std::vector<int> out;
    for (int edge : edges)
        out.push_back(int(std::lower_bound(all.begin(), all.end(), edge) - all.begin()));
    return out;
}

} // namespace

std::vector<int> block_edges(int size, int block) {
    if (size <= 0)
        return {0};
    const int count = std::max(1, int((2 * int64_t(size) + block) / (2 * int64_t(block))));
    std::vector<int> edges;
    for (int64_t i = 0; i <= count; ++i)
        edges.push_back(int(i * size / count));
    return edges;
}

Grid block_grid(int width, int height, int block) {
    return {block_edges(width, block), block_edges(height, block)};
}

Cells::Cells(int width, int height) {
    for (int s = 0; s < kBiasScales; ++s) {
        scale[s].grid = block_grid(width, height, kBiasBlocks[s]);
        grid.x = joined(grid.x, scale[s].grid.x);
        grid.y = joined(grid.y, scale[s].grid.y);
    }
    for (Scale& one : scale) {
        one.x = places(one.grid.x, grid.x);
        one.y = places(one.grid.y, grid.y);
    }
}

} // namespace tonetool::metrics::bias
