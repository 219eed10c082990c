// SPDX-License-Identifier: BSD-3-Clause
// Footprints of pixels from the positions around them, row by row, in float lanes (Google Highway,
// dynamic dispatch).
#pragma once

#include "kernels/guided.h"

namespace tonetool::kernels {

/// Rows have a margin of this many floats before their first and behind their last pixel.
inline constexpr int kFootprintMargin = 64;

/// How far from the local median a footprint may be, as a factor; and the neighbourhood of that
/// median, 5 x 5 pixels.
inline constexpr float kFootprintSpread = 4;
inline constexpr int kFootprintReach = 2;

struct FootprintRows {
    const char* name;

    /// A row of positions, NaN in all three where there is no surface, and in the margins.
    void (*clean)(const GuidePlanes& image, int y, float* const to[3]);

    /// The geometric mean of the steps along x and y to the nearer of two neighbours, from the rows
    /// above, at and below; of one where the other has no neighbours; NaN if it is 0 or unknown,
    /// and in the margins.
    void (*raw)(const float* const (&rows)[3][3], int width, float* to);

    /// From the raw footprints of the rows around: those within kFootprintSpread of their local
    /// median, raised to at least `step` times the largest coordinate. kNotSettled where they are
    /// not or it is unknown, 0 where there is no surface.
    void (*settle)(const float* const (&raw)[2 * kFootprintReach + 1], const float* const row[3],
                   float step, int width, float* to);
};

inline constexpr float kNotSettled = -1;

/// The functions for the best instruction set of this machine.
const FootprintRows& footprint_rows();

} // namespace tonetool::kernels
