// SPDX-License-Identifier: BSD-3-Clause
// The footprint of pixels in the scene, from their positions.
#pragma once

#include "kernels/guided.h"
#include "kernels/views.h"

namespace tonetool::tonemap {

/// Share of the largest coordinate of a position below which steps are rounding: the last place of
/// half, and a few of float. Footprints are at least as large.
inline constexpr double kHalfStep = 1.0 / 1024, kFloatStep = 4.0 / 8388608;

/// The footprint of each pixel: the geometric mean of the steps along x and y to the nearer of the
/// two neighbours in space, lest silhouettes count; of one where the other has no neighbours. It is
/// kept within 1/4 to 4 times the median of its neighbourhood, and is that median where it is not
/// known. 0 where there is no surface, and where nothing is known. `out` is packed, image.width
/// apart, and has the rows of the whole image; only positions and background of `image` are used.
void footprints(const kernels::GuidePlanes& image, double step, float* out,
                const kernels::ParallelFor& parallel);

/// The median of the footprints that are not 0 (the upper one of two); 0 if there are none.
double median_footprint(const float* plane, int width, int height);

} // namespace tonetool::tonemap
