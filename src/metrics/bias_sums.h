// SPDX-License-Identifier: BSD-3-Clause
// The sums over pixels that all tests are made of. A pass over the pixels gives sums of cells;
// those of a block are made of its cells'. Moments are taken about the mean of a cell: raw ones
// cancel, and the rounding of floats would become skewness.
#pragma once

#include <algorithm>
#include <vector>

#include "metrics/bias_grid.h"
#include "metrics/bias_pixels.h"

namespace tonetool::metrics::bias {

/// Of the pixels of one colour of a chequerboard.
struct ColourSums {
    double d = 0, r = 0, dd = 0, dr = 0, rr = 0;
    int pixels = 0;

    void add(const ColourSums& other);
};

/// Of one channel in a cell or block.
struct ChannelSums {
    ColourSums colour[2];          ///< (x + y) even, odd
    double mean = 0;               ///< of d
    double m2 = 0, m3 = 0, m4 = 0; ///< sums of powers of d - mean
    double absolute = 0;           ///< sum of |d|
    double outlier_light = 0;      ///< sum of d, without its sign, of fireflies of the noisier side
    int64_t outliers = 0;          ///< their number

    double pixels() const { return colour[0].pixels + colour[1].pixels; }
    double sum_d() const { return colour[0].d + colour[1].d; }
    double sum_r() const { return colour[0].r + colour[1].r; }
    /// Of all its pixels so many must count for a cell or block to be judged by itself.
    bool judged(double all) const {
        constexpr double fewest = 32;
        return pixels() >= std::min(fewest, all);
    }
};

/// Products of independent differences in Y.
struct ProductSums {
    double sum = 0, squares = 0;
    int64_t used = 0;
};

/// Squared differences of horizontal pairs of pixels, in Y: of the test, the reference, and d.
struct PairSums {
    double t = 0, r = 0, d = 0;
};

struct Sums {
    explicit Sums(int width, int height);

    Cells cells;
    Grid pair_grid;                                  ///< blocks of pairs
    std::vector<ChannelSums> channel[kBiasChannels]; ///< of cells
    std::vector<ProductSums> products;               ///< of cells
    std::vector<PairSums> pairs;                     ///< of the blocks of pair_grid
};

/// All but what sum_tails() adds.
Sums sum_pixels(Pixels& pixels, const kernels::ParallelFor& parallel);

/// The third and fourth moments, and fireflies of the noisier side, the test where unlike = 1 and
/// the reference where it is -1: what only sides of unlike noise need.
void sum_tails(const Pixels& pixels, int unlike, Sums& sums, const kernels::ParallelFor& parallel);

/// Sum of the cleaner side.
double clean_sum(const ChannelSums& sums, int unlike);

/// The sums of a block.
ChannelSums block_sums(const Sums& sums, int channel, int scale, int column, int row);
ProductSums block_products(const Sums& sums, int scale, int column, int row);

} // namespace tonetool::metrics::bias
