// SPDX-License-Identifier: BSD-3-Clause
// Equality, shown and not assumed.
#pragma once

#include "metrics/bias_sums.h"

namespace tonetool::metrics::bias {

/// Whether any of the largest blocks is judged: in all others too few pixels count.
bool any_judged(const Sums& sums);

/// Fills bound, absolute, shown, contradicted and `more` of a result that has its tests and `dark`;
/// `more` as if no more samples than there are were needed at least.
void bound_differences(const Sums& sums, BiasResult& result);

} // namespace tonetool::metrics::bias
