// SPDX-License-Identifier: BSD-3-Clause
// The blocks of a picture. Blocks of all scales are unions of cells, so that pixels are summed
// once.
#pragma once

#include <cstddef>
#include <vector>

#include "metrics/bias.h"

namespace tonetool::metrics::bias {

/// Balanced: as many blocks as fit `size` best, at least one, that cover every pixel once. None
/// where there are no pixels.
std::vector<int> block_edges(int size, int block);

/// Rectangles between edges, row by row.
struct Grid {
    std::vector<int> x, y;

    int columns() const { return int(x.size()) - 1; }
    int rows() const { return int(y.size()) - 1; }
    size_t count() const { return size_t(columns()) * size_t(rows()); }
    size_t at(int column, int row) const {
        return size_t(row) * size_t(columns()) + size_t(column);
    }
    double pixels(int column, int row) const {
        return double(x[size_t(column) + 1] - x[size_t(column)]) *
               double(y[size_t(row) + 1] - y[size_t(row)]);
    }
};

Grid block_grid(int width, int height, int block);

/// The rectangles between the edges of all scales, and which of them each block is made of.
struct Cells {
    Cells(int width, int height);

    struct Scale {
        Grid grid;
        std::vector<int> x, y; ///< the first cell of each column and row of blocks, and the end
    };
    Grid grid;
    Scale scale[kBiasScales];
};

/// Calls visit(cell) for the cells of a block, row by row.
template <class Visit>
void for_each_cell(const Cells& cells, const Cells::Scale& scale, int column, int row,
                   const Visit& visit) {
    for (int y = scale.y[size_t(row)]; y < scale.y[size_t(row) + 1]; ++y)
        for (int x = scale.x[size_t(column)]; x < scale.x[size_t(column) + 1]; ++x)
            visit(cells.grid.at(x, y));
}

} // namespace tonetool::metrics::bias
