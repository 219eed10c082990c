// SPDX-License-Identifier: BSD-3-Clause
// The base of WLS tone mapping: Z. Farbman et al., "Edge-Preserving Decompositions for Multi-Scale
// Tone and Detail Manipulation" (2008), section 3.
#pragma once

namespace tonetool::tonemap {

/// Minimises sum (u - g)^2 + lambda sum w |u_p - u_q|^2 over neighbours p, q in a row or column,
/// w = 1 / (|l_p - l_q|^alpha + 1e-4), l the natural logarithm of luminance.
struct WlsTerms {
    double alpha = 1.2, lambda = 0.125; ///< not negative
    bool logarithmic = false;           ///< g and u are l, not luminance
};

/// The tolerance of the equations: absolute for logarithms, relative to u for luminance. The error
/// of u has the same bound (for luminance relative to u smoothed once more), since the inverse of
/// the matrix has no negative element and rows of sum 1.
inline constexpr double kWlsTolerance = 1e-7;

/// Conjugate gradients behind multigrid, whose coarsest level is factorised.
struct WlsMethod {
    int direct = 16384;   ///< the most unknowns of that level; an image of fewer has no other
    int iterations = 200; ///< before they start anew
};

/// The base of a whole image; planes are packed and may be the same. Pixels whose luminance is not
/// a finite positive number take no part: they are neither data nor anyone's neighbour, and NaN in
/// `base`. Where the tolerance cannot be reached std::runtime_error. Runs on the calling thread.
void wls_base(const WlsTerms& terms, const float* luminance, int width, int height, float* base,
              const WlsMethod& method = {});

} // namespace tonetool::tonemap
