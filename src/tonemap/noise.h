// SPDX-License-Identifier: BSD-3-Clause
// The noise of a rendered image: the variance of its logarithms of luminance where surfaces are
// flat, which is what a base must not take for detail.
#pragma once

#include "kernels/guided.h"
#include "kernels/views.h"

namespace tonetool::tonemap {

/// The variance about each pixel, in a packed plane of the image's size: over the flat pixels of a
/// box of 17 x 17, or NaN where these are too few. The value of `image` is a natural logarithm of
/// luminance, its guides are as the G-buffer gives them. The bits do not depend on how `parallel`
/// schedules.
void noise_plane(const kernels::GuidePlanes& image, float* noise,
                 const kernels::ParallelFor& parallel);

} // namespace tonetool::tonemap
