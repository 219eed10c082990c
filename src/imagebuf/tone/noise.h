// SPDX-License-Identifier: BSD-3-Clause
// How noisy each pixel of an image is: the variance of the natural logarithm of its luminance.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

#include "imagebuf/pixels/paged_array.h"
#include "kernels/guided.h"
#include "kernels/views.h"

namespace tonetool {

/// Measured where surfaces are flat; elsewhere it is the median of what was measured, 0 if nothing
/// was. A packed plane of the image's size; the value of `image` is a natural logarithm.
PagedArray<float> measured_noise(const kernels::GuidePlanes& image,
                                 const kernels::ParallelFor& parallel);

/// Of a layer that has the variance of the mean of luminance; at most 1. `logarithms` are those of
/// luminance in the region.
PagedArray<float> noise_of_layer(const OIIO::ImageBuf& image, const std::string& layer,
                                 OIIO::ROI region, const float* logarithms, int nthreads);

} // namespace tonetool
