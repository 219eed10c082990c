// SPDX-License-Identifier: BSD-3-Clause
// Runs functions that take whole vectors only over rows of any length.
#pragma once

#include <algorithm>

#include "kernels/flip_rows.h"

namespace tonetool::kernels {

/// Calls run(in, out, count) on as many pixels as fill vectors of `lanes`, and on the rest in a
/// buffer of whole vectors: the same instructions for all. In and out may be the same.
template <class Run>
void in_whole_vectors(const float* const in[3], float* const out[3], ptrdiff_t count,
                      ptrdiff_t lanes, const Run& run) {
    const ptrdiff_t whole = count - count % lanes;
    run(in, out, whole);
    if (whole == count)
        return;
    float rest[3][kMostLanes] = {};
    for (int c = 0; c < 3; ++c)
        std::copy(in[c] + whole, in[c] + count, rest[c]);
    float* at[3] = {rest[0], rest[1], rest[2]};
    run(at, at, count - whole);
    for (int c = 0; c < 3; ++c)
        std::copy(rest[c], rest[c] + (count - whole), out[c] + whole);
}

} // namespace tonetool::kernels
