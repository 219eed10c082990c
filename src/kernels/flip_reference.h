// SPDX-License-Identifier: BSD-3-Clause
// LDR-FLIP and HDR-FLIP written straight from the papers. In double precision they are the
// reference implementation of the tests; in float, operation by operation in the order of the
// papers, they show how exact plain single precision is.
#pragma once

#include <vector>

#include "kernels/flip_taps.h"
#include "kernels/tone_curve.h"
#include "kernels/views.h"

namespace tonetool::kernels {

/// An image as three planes of numbers, row by row.
template <typename T = double>
struct PlaneImage {
    int width = 0, height = 0;
    std::vector<T> plane[3];
};

/// `image` multiplied by 2^stops, tone mapped and clamped to [0,1].
template <typename T = double>
PlaneImage<T> tone_map_reference(const ConstRgb& image, const ToneCurve& curve, double stops);

/// LDR-FLIP of two images of linear Rec.709 in [0,1].
template <typename T>
std::vector<T> ldr_flip_reference(const PlaneImage<T>& reference, const PlaneImage<T>& test,
                                  const FlipTaps<T>& taps);

/// Maximum over the exposures; `index`, if given, receives the first exposure that reached it.
/// The number type is that of the taps: double or float.
template <typename T>
std::vector<T> hdr_flip_reference(const ConstRgb& reference, const ConstRgb& test,
                                  const FlipTaps<T>& taps, const ToneCurve& curve,
                                  const std::vector<double>& stops, std::vector<int>* index);

} // namespace tonetool::kernels
