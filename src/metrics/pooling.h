// From an error map to numbers.
#pragma once

#include <cstddef>

#include "include/tonetool/numbers.h"
#include "kernels/views.h"

namespace tonetool::metrics {

/// Pools a map of finite values >= 0 whose first pixel lies at (x0, y0). An empty map gives zeros.
/// The bits do not depend on how `parallel` schedules.
FlipPool pool(const float* map, int width, int height, ptrdiff_t stride, int x0, int y0,
              const kernels::ParallelFor& parallel);

} // namespace tonetool::metrics
