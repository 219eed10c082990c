// SPDX-License-Identifier: BSD-3-Clause
// The tests of blocks.
#pragma once

#include "metrics/bias_sums.h"

namespace tonetool::metrics::bias {

/// What the tests need to know of the noise.
struct Noise {
    int unlike = 0;
    double inflate = 1; ///< the factor of every variance, where neighbours are correlated
    std::array<double, kBiasChannels> rare{};
};

/// Tests of the means of all blocks of a scale, at false discovery rate q.
BiasScale mean_tests(const Sums& sums, int scale, const Noise& noise, double q,
                     const kernels::ParallelFor& parallel);

/// Tests of the products, after those of the means.
void structure_tests(const Sums& sums, int scale, const Noise& noise, double q, BiasScale& out);

/// Which are rejected at false discovery rate q (Benjamini and Hochberg, 1995): all p up to the
/// largest of which the k-th smallest of m is at most q k / m. Returns -1 if none is.
double largest_rejected(const std::vector<const std::vector<double>*>& p, double q);

} // namespace tonetool::metrics::bias
