// SPDX-License-Identifier: BSD-3-Clause
// Tone curves in double precision, written straight from their sources. The tests compare the lanes
// with them, and single values (inverses, exposures, look-up tables) are computed by them.
#pragma once

#include <array>

#include "kernels/curve.h"

namespace tonetool::kernels {

/// The curve's value for an exposed grey, unclamped. For curves that mix channels it is the Rec.709
/// luminance of the result, since their matrices leave greys not quite grey; where R, G and B have
/// curves of their own, it is their mean.
double curve_reference(const CurveNumbers& curve, double x);

/// The value of one channel, of curves that do not mix them.
double curve_reference(const CurveNumbers& curve, size_t channel, double x);

/// A pixel, as curve_rows does it.
std::array<double, 3> curve_reference(const CurveNumbers& curve, const CurveUse& use,
                                      const std::array<double, 3>& rgb);

} // namespace tonetool::kernels
