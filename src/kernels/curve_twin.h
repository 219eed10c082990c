// Tone curves in double precision, written straight from their sources: the oracle of the tests,
// and what single values (inverses, exposures, look-up tables) are computed with.
#pragma once

#include <array>

#include "kernels/curve.h"

namespace tonetool::kernels {

/// A grey of this (exposed) value, unclamped; where channels mix, the luminance (Rec.709) of what
/// becomes of it, since their matrices leave greys not quite grey.
double curve_twin(const CurveNumbers& curve, double x);

/// A pixel, as curve_rows does it.
std::array<double, 3> curve_twin(const CurveNumbers& curve, const CurveUse& use,
                                 const std::array<double, 3>& rgb);

} // namespace tonetool::kernels
