// SPDX-License-Identifier: BSD-3-Clause
// The quantities of an error map by their names.
#pragma once

#include <string>
#include <vector>

#include "metrics/pooling.h"
#include "tonetool/numbers.h"

namespace tonetool {

/// What the named quantities need beside the usual pool. A Refusal says what is valid where a name
/// is none.
void plan_pool(const std::vector<std::string>& names, metrics::PoolRequest& request);

/// The names of what was found, in the place of flip_quantity()'s.
void name_further(const metrics::PoolRequest& request, FlipPool& pool);

} // namespace tonetool
