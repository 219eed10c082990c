// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/cell_mean.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tonetool::tonemap {
namespace {

// Along the side of a square image: 48 x 48 cells are as many as the pixels of a panorama of 64 x
// 32 about a camera, which the authors take the mean of.
constexpr double kCellsAcross = 48;

int64_t count_surface(const float* plane, int width, int height,
                      const kernels::ParallelFor& parallel) {
    std::vector<int64_t> rows(size_t(height), 0);
    parallel(height, [&](int64_t y) {
        const float* const row = plane + y * width;
        rows[size_t(y)] =
            std::count_if(row, row + width, [](float v) { return v >= 0 || v == kBlackSurface; });
    });
    int64_t all = 0;
    for (int64_t n : rows)
        all += n;
    return all;
}

struct Sums {
    double logs = 0;
    int64_t cells = 0;
};

// Of the cells whose upper row is y.
Sums row_of_cells(const float* plane, int width, int height, int y, int side) {
    const size_t across = size_t((width + side - 1) / side);
    std::vector<double> light(across, 0);
    std::vector<int64_t> count(across, 0);
    for (int row = y; row < std::min(y + side, height); ++row)
        for (int x = 0; x < width; ++x) {
            const float v = plane[ptrdiff_t(row) * width + x];
            if (!std::isfinite(v))
                continue;
            light[size_t(x / side)] += std::max(double(v), 0.0);
            ++count[size_t(x / side)];
        }
    Sums out;
    for (size_t i = 0; i < across; ++i)
        if (light[i] > 0) {
            out.logs += std::log(light[i] / double(count[i]));
            ++out.cells;
        }
    return out;
}

} // namespace

CellMean cell_mean(const float* plane, int width, int height,
                   const kernels::ParallelFor& parallel) {
    CellMean out;
    const auto n = double(count_surface(plane, width, height, parallel));
    out.side = std::max(1, int(std::floor(std::sqrt(n) / kCellsAcross + 0.5)));
    std::vector<Sums> rows(size_t((height + out.side - 1) / out.side));
    parallel(int64_t(rows.size()), [&](int64_t i) {
        rows[size_t(i)] = row_of_cells(plane, width, height, int(i) * out.side, out.side);
    });
    double logs = 0;
    for (const Sums& row : rows) {
        logs += row.logs;
        out.cells += row.cells;
    }
    if (out.cells > 0)
        out.mean = std::exp(logs / double(out.cells));
    return out;
}

} // namespace tonetool::tonemap
