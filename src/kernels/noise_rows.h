// SPDX-License-Identifier: BSD-3-Clause
// Where an image is flat, and what varies there: the noise of a renderer, in float lanes (Google
// Highway, dynamic dispatch).
#pragma once

#include "kernels/guided.h"

namespace tonetool::kernels {

/// Standard deviations of the weights that say how flat a pixel's neighbourhood is.
inline constexpr double kFlatNormal = 0.05, kFlatAlbedo = 0.02;
/// Of a step of the logarithm of luminance that counts as an edge: exp(-(h / this)^4).
inline constexpr double kFlatStep = 0.3;

/// Of the pixels of row y: the weight f with which they are flat, and f h^2, where h is what the
/// value differs by from the mean of its four neighbours; pixels beyond the border are those at it.
/// The value is a natural logarithm of luminance; normals are of unit length and albedo is finite,
/// 0 on the background. Both are 0 where a value is not finite.
void noise_row(const GuidePlanes& image, int y, float* flat, float* square);

/// The reference implementation for one pixel, in double precision: f and f h^2.
struct NoiseShare {
    double flat, square;
};
NoiseShare noise_reference(const GuidePlanes& image, int x, int y);

} // namespace tonetool::kernels
