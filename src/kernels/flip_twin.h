// LDR-FLIP and HDR-FLIP written straight from the papers. In double precision they are the oracle
// of the tests; in float, operation by operation in the order of the papers, they show what plain
// single precision gives.
#pragma once

#include <vector>

#include "kernels/flip_taps.h"
#include "kernels/tone_curve.h"
#include "kernels/views.h"

namespace tonetool::kernels {

/// An image as three planes of numbers, row by row.
template <typename T = double>
struct TwinImage {
    int width = 0, height = 0;
    std::vector<T> plane[3];
};

/// `image` multiplied by 2^stops, tone mapped and clamped to [0,1].
template <typename T = double>
TwinImage<T> tone_map_twin(const ConstRgb& image, const ToneCurve& curve, double stops);

/// LDR-FLIP of two images of linear Rec.709 in [0,1].
template <typename T>
std::vector<T> ldr_flip_twin(const TwinImage<T>& reference, const TwinImage<T>& test,
                             const FlipTaps<T>& taps);

/// Maximum over the exposures; `index`, if given, receives the first exposure that reached it.
/// The number type is that of the taps: double or float.
template <typename T>
std::vector<T> hdr_flip_twin(const ConstRgb& reference, const ConstRgb& test,
                             const FlipTaps<T>& taps, const ToneCurve& curve,
                             const std::vector<double>& stops, std::vector<int>* index);

} // namespace tonetool::kernels
