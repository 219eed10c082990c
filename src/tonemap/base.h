// SPDX-License-Identifier: BSD-3-Clause
// The base that an operator compresses: luminance under the cross bilateral filter of CG-TMO.
#pragma once

#include "kernels/guided.h"
#include "kernels/guided_tile.h"
#include "kernels/views.h"

namespace tonetool::tonemap {

/// Filters a window of the image. `row` receives parts of rows, from several threads and in any
/// order.
void filter_base(const kernels::GuidePlanes& image, const kernels::GuidedTerms& terms,
                 const kernels::TapSets& taps, const kernels::Window& window,
                 const kernels::GuidedRow& row, const kernels::ParallelFor& parallel);

/// Filters a window of the image into `out`, row stride in floats. The bits depend neither on the
/// window nor on how `parallel` schedules.
void filter_base(const kernels::GuidePlanes& image, const kernels::GuidedTerms& terms,
                 const kernels::TapSets& taps, const kernels::Window& window, float* out,
                 ptrdiff_t stride, const kernels::ParallelFor& parallel);

/// The means of a window and their variances; the image has no range.
void filter_moments(const kernels::GuidePlanes& image, const kernels::GuidedTerms& terms,
                    const kernels::TapSets& taps, const kernels::Window& window,
                    const kernels::MomentsRow& row, const kernels::ParallelFor& parallel);

} // namespace tonetool::tonemap
