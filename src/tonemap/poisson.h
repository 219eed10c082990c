// SPDX-License-Identifier: BSD-3-Clause
// Subsets of a filter's window: F. Banterle, M. Corsini, P. Cignoni, R. Scopigno, "A Low-Memory,
// Straightforward and Fast Bilateral Filter Through Subsampling in Spatial Domain" (2012).
#pragma once

#include <vector>

#include "kernels/guided.h"

namespace tonetool::tonemap {

/// The number of samples that the authors' programs take for a window of 41 x 41.
inline constexpr int kPoissonSamples = 80, kPoissonSets = 64;

/// `count` different offsets, |dx|, |dy| <= half, the first of them (0, 0), well apart from one
/// another: each is the farthest from the others of several random candidates (D. P. Mitchell,
/// "Spectrally Optimal Sampling for Distribution Ray Tracing", 1991). The authors spread them
/// evenly; most of them then get next to no weight from a Gaussian of sigma half / 2.5. Here their
/// density falls as 1 / (1 + 8 r^2 / half^2)^2, like the product of that Gaussian with the one of
/// positions, which leaves less than half of the error. The same on every machine: integers alone.
/// At most as many as the window holds.
std::vector<kernels::Offset> poisson_set(int half, int count, unsigned seed);

/// As many sets as TapSets takes; no two are the same unless there are too few offsets for that.
/// The result of the last call is cached.
std::vector<std::vector<kernels::Offset>> poisson_sets(int half, int count);

} // namespace tonetool::tonemap
