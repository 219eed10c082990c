// SPDX-License-Identifier: BSD-3-Clause
// The adaptation luminance of a noisy image: means of cells first, logarithms after.
#pragma once

#include <cstdint>

#include "kernels/views.h"

namespace tonetool::tonemap {

/// What stands for the luminance of black pixels in a plane of those that count: on a surface, and
/// where nothing tells a surface from the background. Every other statistic passes over them, as it
/// does over NaN, which is no pixel of the scene.
inline constexpr float kBlackSurface = -1, kBlackAnywhere = -2;

struct CellMean {
    double mean = 0;   ///< exp(mean of ln of the cells' means); 0 if no cell is lit
    int side = 1;      ///< of a cell, in pixels
    int64_t cells = 0; ///< that are lit
};

/// The logarithm is concave: the noisier pixels are, the less the mean of their logarithms. Here
/// each of about 2300 square cells counts by the logarithm of its mean luminance, in which black
/// pixels are 0; cells without light do not count. Cells begin at the first pixel of the plane,
/// which has no padding. Sums are of pixels in their order.
CellMean cell_mean(const float* plane, int width, int height, const kernels::ParallelFor& parallel);

} // namespace tonetool::tonemap
