// SPDX-License-Identifier: BSD-3-Clause
// The filters of LDR-FLIP as one-sided lists of taps: element i weighs the pixels at +i and -i.
#pragma once

#include <vector>

namespace tonetool::kernels {

/// The taps as the papers define them. All filters are separable. `d1` is odd (its value at -i is
/// -d1[i]), the others are even.
template <typename T>
struct FlipTaps {
    std::vector<T> y, cx;     ///< contrast sensitivity, achromatic and red-green
    std::vector<T> cz1, cz2;  ///< blue-yellow, a sum of two separable Gaussians
    std::vector<T> g, d1, d2; ///< features: Gaussian, its first and second derivative
};

/// The taps as the lanes apply them. Lists may be shorter than the radius where the tail is below
/// the precision of float. `y` and `cx` are of one length, not longer than `g`; so are `cz1` and
/// `cz2`. All of these have two taps or more.
///
/// The taps of both detectors sum to 0, so that they can be applied to the steps between
/// neighbours, s[i] = v[i + 1] - v[i]: a flat area then gives exactly 0, which matters since the
/// square root of the result enters the error. Element i weighs s[i] and s[-1 - i].
struct LaneTaps {
    std::vector<float> y, cx, cz1, cz2, g;
    std::vector<float> d1, d2; ///< on steps: d1 weighs s[i] + s[-1 - i], d2 s[i] - s[-1 - i]
};

} // namespace tonetool::kernels
