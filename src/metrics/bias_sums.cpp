// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/bias_sums.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace tonetool::metrics::bias {
namespace {

// A pixel whose difference is above this many times the level of its 16-block is a firefly.
constexpr double kOutlier = 10;

// Four sums by turns, so that an addition need not wait for the one before; a compiler turns them
// into vectors. Of rows that begin with the same colour, lanes 0 and 2 have this colour.
struct Lanes {
    double d[4] = {}, r[4] = {}, dd[4] = {}, dr[4] = {}, rr[4] = {};

    void add(int lane, double a, double b) {
        d[lane] += a;
        r[lane] += b;
        dd[lane] += a * a;
        dr[lane] += a * b;
        rr[lane] += b * b;
    }
    void add_to(ColourSums& sums, int lane) const {
        sums.d += d[lane] + d[lane + 2];
        sums.r += r[lane] + r[lane + 2];
        sums.dd += dd[lane] + dd[lane + 2];
        sums.dr += dr[lane] + dr[lane + 2];
        sums.rr += rr[lane] + rr[lane + 2];
    }
};

// A cell of a strip.
struct Cell {
    int x0, y0, width, height;
    const double* d[kBiasChannels];
    const double* r[kBiasChannels];
    const uint8_t* ignored; ///< as in Strip
    ptrdiff_t ignored_step;

    bool counts(int x, int y) const {
        return !ignored || ignored[ptrdiff_t(y) * ignored_step + x] == 0;
    }
};

// Calls visit(cell, index of the cell) for a row of cells, from left to right.
template <class Visit>
void visit_cells(const Pixels& pixels, const Grid& grid, int row, const Visit& visit) {
    const auto strip = std::make_unique<Strip>();
    const int y0 = grid.y[size_t(row)], height = grid.y[size_t(row) + 1] - y0;
    for (int column = 0; column < grid.columns();) {
        const int x0 = grid.x[size_t(column)];
        int end = column + 1;
        while (end < grid.columns() && grid.x[size_t(end) + 1] - x0 <= Strip::kWidth)
            ++end;
        pixels.strip({x0, y0, grid.x[size_t(end)] - x0, height}, *strip);
        for (; column < end; ++column) {
            const int x = grid.x[size_t(column)];
            Cell cell{x, y0, grid.x[size_t(column) + 1] - x, height, {}, {}, nullptr, 0};
            if (strip->ignored) {
                cell.ignored = strip->ignored + (x - x0);
                cell.ignored_step = strip->ignored_step;
            }
            for (int c = 0; c < kBiasChannels; ++c) {
                cell.d[c] = strip->d[c] + (x - x0);
                cell.r[c] = strip->r[c] + (x - x0);
            }
            visit(cell, column);
        }
    }
}

// Rows first, first + 2, ... of a cell.
Lanes sums_of_rows(const Cell& cell, int channel, int first) {
    Lanes lanes;
    for (int y = first; y < cell.height; y += 2) {
        const double* a = cell.d[channel] + ptrdiff_t(y) * Strip::kWidth;
        const double* b = cell.r[channel] + ptrdiff_t(y) * Strip::kWidth;
        int x = 0;
        for (; x + 3 < cell.width; x += 4)
            for (int i = 0; i < 4; ++i)
                lanes.add(i, a[x + i], b[x + i]);
        for (int i = 0; x < cell.width; ++x, ++i)
            lanes.add(i, a[x], b[x]);
    }
    return lanes;
}

// Calls add(lane, value) for all values of a cell.
template <class Add>
void by_lanes(const Cell& cell, const double* values, const Add& add) {
    if (cell.ignored) {
        for (int y = 0; y < cell.height; ++y)
            for (int x = 0; x < cell.width; ++x)
                if (cell.counts(x, y))
                    add(x & 3, values[ptrdiff_t(y) * Strip::kWidth + x]);
        return;
    }
    for (int y = 0; y < cell.height; ++y, values += Strip::kWidth) {
        int x = 0;
        for (; x + 3 < cell.width; x += 4)
            for (int i = 0; i < 4; ++i)
                add(i, values[x + i]);
        for (; x < cell.width; ++x)
            add(0, values[x]);
    }
}

double all_lanes(const double* lane) {
    return (lane[0] + lane[1]) + (lane[2] + lane[3]);
}

void second_moment(const Cell& cell, const double* d, ChannelSums& out) {
    const double mean = out.mean;
    double squares[4] = {}, absolute[4] = {};
    by_lanes(cell, d, [&](int lane, double value) {
        const double e = value - mean;
        squares[lane] += e * e;
        absolute[lane] += std::abs(value);
    });
    out.m2 = all_lanes(squares);
    out.absolute = all_lanes(absolute);
}

void count_pixels(const Cell& cell, ChannelSums& out) {
    out.colour[0].pixels = out.colour[1].pixels = 0;
    for (int y = 0; y < cell.height; ++y)
        for (int x = 0; x < cell.width; ++x)
            out.colour[(cell.x0 + x + cell.y0 + y) & 1].pixels += cell.counts(x, y);
}

// 0 where no pixel counts.
double mean_of(const ChannelSums& sums) {
    return sums.pixels() > 0 ? sums.sum_d() / sums.pixels() : 0;
}

ChannelSums sums_of_cell(const Cell& cell, int channel) {
    ChannelSums out;
    for (int first = 0; first < 2; ++first) {
        const Lanes lanes = sums_of_rows(cell, channel, first);
        const int colour = (cell.x0 + cell.y0 + first) & 1; // of lanes 0 and 2
        const int rows = (cell.height + 1 - first) / 2;
        lanes.add_to(out.colour[colour], 0);
        lanes.add_to(out.colour[1 - colour], 1);
        out.colour[colour].pixels += rows * ((cell.width + 1) / 2);
        out.colour[1 - colour].pixels += rows * (cell.width / 2);
    }
    if (cell.ignored) // whose sums are 0
        count_pixels(cell, out);
    out.mean = mean_of(out);
    second_moment(cell, cell.d[channel], out);
    return out;
}

// Differences within the pairs of one row, added to its blocks.
void add_pairs(const double* r, const double* t, const std::vector<int>& edges, PairSums* out) {
    for (size_t block = 0; block + 1 < edges.size(); ++block) {
        PairSums sums;
        for (int i = edges[block]; i < edges[block + 1]; ++i) {
            const double a = t[2 * i + 1] - t[2 * i], b = r[2 * i + 1] - r[2 * i];
            const double c = (t[2 * i + 1] - r[2 * i + 1]) - (t[2 * i] - r[2 * i]);
            sums.t += a * a;
            sums.r += b * b;
            sums.d += c * c;
        }
        out[block].t += sums.t;
        out[block].r += sums.r;
        out[block].d += sums.d;
    }
}

// Every `step`th product of one row, added to its cells; those with pixels that do not count are 0.
void add_products(const double* x, int count, int step, const uint8_t* ignored,
                  const std::vector<int>& edges, ProductSums* out) {
    for (size_t cell = 0; cell + 1 < edges.size(); ++cell) {
        ProductSums sums;
        const int first = (edges[cell] + step - 1) / step * step;
        for (int i = first; i < std::min(edges[cell + 1], count); i += step) {
            sums.sum += x[i];
            sums.squares += x[i] * x[i];
            sums.used += !ignored || (ignored[i] == 0 && ignored[i + step - 1] == 0);
        }
        out[cell].sum += sums.sum;
        out[cell].squares += sums.squares;
        out[cell].used += sums.used;
    }
}

// Sums over the luminance of the rows of one row of cells.
class LuminanceRows {
public:
    explicit LuminanceRows(Pixels& pixels)
        : m_pixels(pixels),
          m_r(size_t(pixels.width())),
          m_t(size_t(pixels.width())),
          m_x(size_t(pixels.width())) {}

    void add(int y, const Sums& sums, PairSums* pairs, ProductSums* products) {
        m_pixels.luminance(y, m_r.data(), m_t.data());
        const uint8_t* ignored = m_pixels.ignored(y);
        if (ignored)
            clear_pairs(ignored);
        add_pairs(m_r.data(), m_t.data(), sums.pair_grid.x, pairs);
        const int width = m_pixels.width();
        if (m_pixels.has_halves()) {
            m_pixels.half_products(y, m_x.data());
            add_products(m_x.data(), width, 1, ignored, sums.cells.grid.x, products);
            return;
        }
        for (size_t x = 0; x + 1 < size_t(width); x += 2)
            m_x[x] = (m_t[x] - m_r[x]) * (m_t[x + 1] - m_r[x + 1]);
        add_products(m_x.data(), width / 2 * 2, 2, ignored, sums.cells.grid.x, products);
    }

private:
    // A pair tells nothing where one of its pixels does not count.
    void clear_pairs(const uint8_t* ignored) {
        for (size_t x = 0; x + 1 < m_r.size(); x += 2)
            if (ignored[x] != 0 || ignored[x + 1] != 0)
                m_r[x] = m_r[x + 1] = m_t[x] = m_t[x + 1] = 0;
    }

    Pixels& m_pixels;
    std::vector<double> m_r, m_t, m_x;
};

// Rows of cells to rows of blocks of pairs.
void join_pairs(const std::vector<PairSums>& rows, const Cells& cells, Sums& out) {
    const auto columns = size_t(out.pair_grid.columns());
    const std::vector<int>& first = cells.scale[0].y;
    for (size_t row = 0; row + 1 < first.size(); ++row)
        for (auto y = size_t(first[row]); y < size_t(first[row + 1]); ++y)
            for (size_t x = 0; x < columns; ++x) {
                PairSums& to = out.pairs[row * columns + x];
                to.t += rows[y * columns + x].t;
                to.r += rows[y * columns + x].r;
                to.d += rows[y * columns + x].d;
            }
}

void higher_moments(const Cell& cell, const double* d, ChannelSums& out) {
    const double mean = out.mean;
    double cubes[4] = {}, fourths[4] = {};
    by_lanes(cell, d, [&](int lane, double value) {
        const double e = value - mean, square = e * e;
        cubes[lane] += square * e;
        fourths[lane] += square * square;
    });
    out.m3 = all_lanes(cubes);
    out.m4 = all_lanes(fourths);
}

void add_outliers(const Cell& cell, const double* d, int unlike, double threshold,
                  ChannelSums& out) {
    double light[4] = {};
    int64_t count[4] = {};
    by_lanes(cell, d, [&](int lane, double value) {
        const double x = value * unlike;
        const bool seen = x > threshold;
        light[lane] += seen ? x : 0;
        count[lane] += seen;
    });
    out.outlier_light = all_lanes(light);
    out.outliers = (count[0] + count[1]) + (count[2] + count[3]);
}

// What is a firefly in the blocks of a row, by channel and column.
std::vector<double> thresholds(const Sums& sums, int unlike, int row) {
    std::vector<double> out;
    const Grid& blocks = sums.cells.scale[0].grid;
    for (int c = 0; c < kBiasChannels; ++c)
        for (int column = 0; column < blocks.columns(); ++column) {
            const ChannelSums block = block_sums(sums, c, 0, column, row);
            const double light = std::max(clean_sum(block, unlike), 0.0);
            out.push_back(kOutlier * light / std::max(block.pixels(), 1.0));
        }
    return out;
}

} // namespace

void ColourSums::add(const ColourSums& other) {
    d += other.d;
    r += other.r;
    dd += other.dd;
    dr += other.dr;
    rr += other.rr;
    pixels += other.pixels;
}

Sums::Sums(int width, int height)
    : cells(width, height),
      pair_grid(block_grid(width / 2, height, 16)),
      products(cells.grid.count()),
      pairs(pair_grid.count()) {
    for (auto& one : channel)
        one.resize(cells.grid.count());
}

Sums sum_pixels(Pixels& pixels, const kernels::ParallelFor& parallel) {
    Sums out(pixels.width(), pixels.height());
    const Grid& grid = out.cells.grid;
    const auto pair_columns = size_t(out.pair_grid.columns());
    std::vector<PairSums> pair_rows(pair_columns * size_t(grid.rows()));
    parallel(grid.rows(), [&](int64_t row) {
        LuminanceRows rows(pixels);
        for (int y = grid.y[size_t(row)]; y < grid.y[size_t(row) + 1]; ++y)
            rows.add(y, out, pair_rows.data() + size_t(row) * pair_columns,
                     out.products.data() + grid.at(0, int(row)));
        visit_cells(pixels, grid, int(row), [&](const Cell& cell, int column) {
            for (int c = 0; c < kBiasChannels; ++c)
                out.channel[c][grid.at(column, int(row))] = sums_of_cell(cell, c);
        });
    });
    join_pairs(pair_rows, out.cells, out);
    return out;
}

void sum_tails(const Pixels& pixels, int unlike, Sums& sums, const kernels::ParallelFor& parallel) {
    const Grid& grid = sums.cells.grid;
    const Cells::Scale& blocks = sums.cells.scale[0];
    const auto block_columns = size_t(blocks.grid.columns());
    parallel(blocks.grid.rows(), [&](int64_t block_row) {
        const std::vector<double> threshold = thresholds(sums, unlike, int(block_row));
        for (int row = blocks.y[size_t(block_row)]; row < blocks.y[size_t(block_row) + 1]; ++row) {
            size_t block = 0;
            visit_cells(pixels, grid, row, [&](const Cell& cell, int column) {
                block += column == blocks.x[block + 1];
                for (size_t c = 0; c < kBiasChannels; ++c) {
                    ChannelSums& out = sums.channel[c][grid.at(column, row)];
                    higher_moments(cell, cell.d[c], out);
                    add_outliers(cell, cell.d[c], unlike, threshold[c * block_columns + block],
                                 out);
                }
            });
        }
    });
}

// T is R + d.
double clean_sum(const ChannelSums& sums, int unlike) {
    return unlike > 0 ? sums.sum_r() : sums.sum_r() + sums.sum_d();
}

// Moments about the block's mean m from those about the means of cells, delta away from it: the
// sums of (e + delta)^k, expanded.
ChannelSums block_sums(const Sums& sums, int channel, int scale, int column, int row) {
    const std::vector<ChannelSums>& of = sums.channel[channel];
    const Cells::Scale& blocks = sums.cells.scale[scale];
    ChannelSums out;
    for_each_cell(sums.cells, blocks, column, row, [&](size_t cell) {
        for (int colour = 0; colour < 2; ++colour)
            out.colour[colour].add(of[cell].colour[colour]);
        out.absolute += of[cell].absolute;
    });
    out.mean = mean_of(out);
    for_each_cell(sums.cells, blocks, column, row, [&](size_t at) {
        const ChannelSums& cell = of[at];
        const double n = cell.pixels(), delta = cell.mean - out.mean, square = delta * delta;
        out.m2 += cell.m2 + n * square;
        out.m3 += cell.m3 + 3 * delta * cell.m2 + n * square * delta;
        out.m4 += cell.m4 + 4 * delta * cell.m3 + 6 * square * cell.m2 + n * square * square;
    });
    return out;
}

ProductSums block_products(const Sums& sums, int scale, int column, int row) {
    ProductSums out;
    for_each_cell(sums.cells, sums.cells.scale[scale], column, row, [&](size_t cell) {
        out.sum += sums.products[cell].sum;
        out.squares += sums.products[cell].squares;
        out.used += sums.products[cell].used;
    });
    return out;
}

} // namespace tonetool::metrics::bias
