// The filters of LDR-FLIP as one-sided lists of taps: element i weighs the pixels at +i and -i.
#pragma once

#include <vector>

namespace tonetool::kernels {

/// All filters are separable. `d1` is odd (its value at -i is -d1[i]), the others are even.
/// Lists may be shorter than the radius where the tail is below the precision of T.
template <typename T>
struct FlipTaps {
    std::vector<T> y, cx;     ///< contrast sensitivity, achromatic and red-green
    std::vector<T> cz1, cz2;  ///< blue-yellow, a sum of two separable Gaussians
    std::vector<T> g, d1, d2; ///< features: Gaussian, its first and second derivative
};

} // namespace tonetool::kernels
