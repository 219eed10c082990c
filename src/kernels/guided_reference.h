// SPDX-License-Identifier: BSD-3-Clause
// The cross bilateral filter in double precision, written straight from the paper's Eqs. 3 and 4:
// the reference implementation that the tests compare with.
#pragma once

#include "kernels/guided.h"

namespace tonetool::kernels {

/// The filtered value of pixel (x, y).
double guided_reference(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                        int x, int y);

/// Its weighted mean and variance.
struct GuidedMoments {
    double mean, variance;
};
GuidedMoments moments_reference(const GuidePlanes& image, const GuidedTerms& terms,
                                const TapSets& taps, int x, int y);

} // namespace tonetool::kernels
