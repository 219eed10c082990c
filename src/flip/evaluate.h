// SPDX-License-Identifier: BSD-3-Clause
// LDR-FLIP and HDR-FLIP of whole images or windows of them, tile by tile.
#pragma once

#include <vector>

#include "kernels/flip_rows.h"
#include "kernels/flip_taps.h"
#include "kernels/tone_curve.h"
#include "kernels/views.h"

namespace tonetool::flip {

struct Evaluation {
    kernels::LaneTaps taps;
    kernels::ToneCurve curve;
    std::vector<double> stops; ///< {0} with ToneKind::None is LDR-FLIP
    /// Instruction set to run on; null: the best of this machine.
    const kernels::FlipRows* functions = nullptr;
    int most_tile_rows = 0;           ///< to take less memory; 0: as many as is fast
    kernels::ToneRows rows = nullptr; ///< instead of the curve
};

/// Where the results of one test go: planes of the window's size, row stride `stride` floats.
struct Output {
    float* error = nullptr; ///< the maximum over the exposures
    float* index = nullptr; ///< the exposure that gave it, 0 where the error is 0; may be null
    std::vector<float*> per_exposure; ///< LDR-FLIP of each exposure; may be empty
    ptrdiff_t stride = 0;
};

/// FLIP of each test against the reference, all of one size with finite values >= 0. Only the
/// window is evaluated, but its neighbourhood is read from the whole image: the bits do not depend
/// on the window, nor on how `parallel` schedules. The reference is filtered once for all tests.
void evaluate(const Evaluation& what, const kernels::ConstRgb& reference,
              const std::vector<kernels::ConstRgb>& tests, const kernels::Window& window,
              const std::vector<Output>& outputs, const kernels::ParallelFor& parallel);

/// The work space of each thread in bytes, for windows at least as high as a tile.
size_t work_bytes(const Evaluation& what, int width, size_t tests, bool keep_each);

} // namespace tonetool::flip
