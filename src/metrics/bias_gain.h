// SPDX-License-Identifier: BSD-3-Clause
// The overall difference of an image.
#pragma once

#include "metrics/bias_sums.h"

namespace tonetool::metrics::bias {

/// Differences of block means below this part of the block's level are no evidence: half a unit in
/// the last place of half, which one of the two files may have been rounded to.
inline constexpr double kRounding = 0x1p-11;

/// Gain, energy ratio and test of one channel, not yet rejected. `inflate`: the factor of every
/// variance, where neighbours are correlated.
BiasGain overall_gain(const Sums& sums, int channel, double inflate);

} // namespace tonetool::metrics::bias
