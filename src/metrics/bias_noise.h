// SPDX-License-Identifier: BSD-3-Clause
// What kind of noise the two sides have.
#pragma once

#include "metrics/bias_sums.h"

namespace tonetool::metrics::bias {

/// 0: noise alike; near 1: only the test has noise; near -1: only the reference.
double asymmetry(const Sums& sums);

/// Part of the light of the cleaner side that fireflies of the noisier one may carry and which none
/// of this image's brought, an upper limit. After sum_tails(), with the same `unlike`.
std::array<double, kBiasChannels> firefly_shares(const Sums& sums, int unlike);

/// Median over 32-blocks of the correlation of neighbours in d of Y.
double neighbour_correlation(Pixels& pixels, const Sums& sums,
                             const kernels::ParallelFor& parallel);

} // namespace tonetool::metrics::bias
