// SPDX-License-Identifier: BSD-3-Clause
// A threshold from the values that renders of the approved version have, with its rate of false
// alarms.
#pragma once

#include <vector>

#include "tonetool/bias_numbers.h"

namespace tonetool::metrics {

/// The smallest upper tolerance limit: with `confidence`, at least the part `content` of the
/// distribution that `values` are from lies below it (Hahn and Meeker, "Statistical Intervals",
/// 1991). Fewer than 4 values, values that are not finite, and a limit that cannot be exceeded are
/// refused.
NoiseFloor noise_floor(const std::vector<double>& values, const NoiseFloorOptions& options);

} // namespace tonetool::metrics
