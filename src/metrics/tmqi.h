// SPDX-License-Identifier: BSD-3-Clause
// TMQI: H. Yeganeh, Z. Wang, "Objective Quality Assessment of Tone-Mapped Images", IEEE
// Transactions on Image Processing 22(2), 2013.
#pragma once

#include <cmath>
#include <cstddef>

#include "kernels/views.h"
#include "tonetool/numbers.h"

namespace tonetool::metrics {

/// The window of the statistics; smaller images have no TMQI.
inline constexpr int kTmqiWindow = 11;

/// The index of an image of this structural fidelity and naturalness.
inline double tmqi_index(double structure, double naturalness) {
    constexpr double share = 0.8012, structure_power = 0.3046, naturalness_power = 0.7088;
    return share * std::pow(structure, structure_power) +
           (1 - share) * std::pow(naturalness, naturalness_power);
}

/// An HDR image and its tone-mapped image as planes of one size, row by row without padding.
struct TmqiPair {
    const float* hdr = nullptr; ///< linear luminance, in any unit
    const float* ldr = nullptr; ///< luminance of the display-encoded values, 0 to 255
    int width = 0, height = 0;
};

/// Smallest and largest of the finite values; both 0 if there are none.
struct LightRange {
    double low = 0, high = 0;
};
LightRange light_range(const float* plane, int width, int height,
                       const kernels::ParallelFor& parallel);

/// Scores the tone-mapped image. The HDR image is scaled by `range`, which is not empty. A
/// non-finite pixel enters as the low end of the range, in the tone-mapped image as 0; where only
/// one of the two is non-finite, the structure in the finest scale is 0. `structure` receives the
/// map of the finest scale, 1 where the tone-mapped image keeps the local structure of the HDR
/// image. The bits do not depend on how `parallel` schedules.
TmqiScore tmqi(const TmqiPair& pair, const LightRange& range, float* structure,
               const kernels::ParallelFor& parallel);

/// Bytes of work space of each thread; beside these, tmqi() holds 5 bytes per pixel.
size_t tmqi_work_bytes(int width, int height);

} // namespace tonetool::metrics
