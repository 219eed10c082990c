// SPDX-License-Identifier: BSD-3-Clause
// The cross bilateral filter on rows, in float lanes (Google Highway): one table of functions per
// instruction set, guided_tile.h puts them together.
#pragma once

#include "kernels/guided.h"

namespace tonetool::kernels {

/// How a prepared row lies in memory: planes of `pitch` floats, one after the other. First the
/// value; then the position, of which the first plane also says what kind of pixel it is (the only
/// plane there is without positions); then planes whose differences count as they are: normal,
/// albedo, range; then those of them that are two to a word; then the normal whose angle counts;
/// last, log2 e / 2 s1^2.
struct GuidedLayout {
    GuidedLayout(const GuidePlanes& image, const GuidedTerms& terms);

    bool position, angle, range_of_value;
    int plain = 0, pairs = 0;
    ptrdiff_t pitch = 0;

    int first_plain() const { return position ? 4 : 2; }
    int first_pair() const { return first_plain() + plain; }
    int range() const { return first_pair() - 1; } ///< if it has a plane of its own
    int first_angle() const { return first_pair() + pairs; }
    int nearness() const { return first_angle() + (angle ? 3 : 0); }
    int planes() const { return nearness() + 1; }
};

/// The terms as what differences are multiplied by, for weights that are powers of 2.
struct GuidedScales {
    GuidedScales(const GuidePlanes& image, const GuidedTerms& terms);

    float nearness, footprint, normal, albedo, range, angle, range_of_value, least;
    float square_of_steps; ///< what a squared difference of pairs is multiplied by
};

/// Pixels [column, column + kGuidedRun) of a row and their neighbours: rows[dy] is the prepared row
/// dy below theirs.
struct GuidedRun {
    const float* const* rows;
    ptrdiff_t column, pitch;
    const Tap* taps;
    ptrdiff_t count;
};

struct GuidedRows {
    const char* name;

    /// Prefetches pixels that will be prepared soon.
    void (*fetch)(const GuidePlanes& image, ptrdiff_t from, ptrdiff_t count);

    /// `count` pixels of a row that begins at `from` in the planes; up to a vector more is written.
    void (*prepare)(const GuidePlanes& image, const GuidedLayout& layout,
                    const GuidedScales& scales, ptrdiff_t from, ptrdiff_t count, float* to);

    /// Pixels outside the image, which are no pixel's neighbours.
    void (*prepare_outside)(const GuidedLayout& layout, ptrdiff_t count, float* to);

    /// The weighted means of a run. A pixel without any valid neighbour (it counts as its own)
    /// keeps its value.
    void (*filter)(const GuidedLayout& layout, const GuidedScales& scales, const GuidedRun& run,
                   float* out);

    /// The weighted means and variances of a run, for layouts without a range. A pixel without any
    /// valid neighbour keeps its value, with variance 0.
    void (*moments)(const GuidedLayout& layout, const GuidedScales& scales, const GuidedRun& run,
                    float* mean, float* variance);
};

/// The functions for the best instruction set of this machine.
const GuidedRows& guided_rows();

} // namespace tonetool::kernels
