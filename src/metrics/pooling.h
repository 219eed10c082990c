// SPDX-License-Identifier: BSD-3-Clause
// From an error map to numbers.
#pragma once

#include <cstddef>
#include <vector>

#include "kernels/views.h"
#include "tonetool/numbers.h"

namespace tonetool::metrics {

/// The quantities that a pool holds beside the usual ones.
struct PoolRequest {
    std::vector<double> percentiles; ///< 0 to 100
    std::vector<double> above;       ///< errors: the share of the pixels above each
    std::vector<double> found_percentiles, found_above;
};

/// Whether a map has pixels that do not count, which are NaN.
enum class Gaps { None, Nan };

/// Pools a map of finite values >= 0 whose first pixel lies at (x0, y0), some of which may not
/// count. A map without a pixel that counts gives zeros.
/// The bits do not depend on how `parallel` schedules.
FlipPool pool(const float* map, int width, int height, ptrdiff_t stride, int x0, int y0,
              const kernels::ParallelFor& parallel, PoolRequest* further = nullptr,
              Gaps gaps = Gaps::None);

} // namespace tonetool::metrics
