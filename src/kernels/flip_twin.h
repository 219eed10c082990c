// LDR-FLIP in double precision, written straight from the papers: the oracle of the tests.
#pragma once

#include <vector>

#include "kernels/flip_taps.h"
#include "kernels/tone_curve.h"
#include "kernels/views.h"

namespace tonetool::kernels {

/// An image as three planes of doubles, row by row.
struct TwinImage {
    int width = 0, height = 0;
    std::vector<double> plane[3];
};

/// `image` multiplied by 2^stops, tone mapped and clamped to [0,1].
TwinImage tone_map_twin(const ConstRgb& image, const ToneCurve& curve, double stops);

/// LDR-FLIP of two images of linear Rec.709 in [0,1].
std::vector<double> ldr_flip_twin(const TwinImage& reference, const TwinImage& test,
                                  const FlipTaps<double>& taps);

/// Maximum over the exposures; `index`, if given, receives the first exposure that reached it.
std::vector<double> hdr_flip_twin(const ConstRgb& reference, const ConstRgb& test,
                                  const FlipTaps<double>& taps, const ToneCurve& curve,
                                  const std::vector<double>& stops, std::vector<int>* index);

} // namespace tonetool::kernels
