// SPDX-License-Identifier: BSD-3-Clause
// Files beside the frames of a sequence that look like frames of it and are none.
#pragma once

#include <string>
#include <vector>

namespace tonetool::sequence {

struct StrayFiles {
    /// Of this frame number, in the order of their names: with other padding, with a sub-frame,
    /// copies, and what an interrupted transfer has left.
    std::vector<std::string> names;
    /// The first and the last number of the sequence in its folder; equal to the frame's without
    /// others.
    int first = 0, last = 0;
    int digits = 0; ///< of the number in the frame's own name
};

/// Of a frame by its file and number. Where the name has no such number, or the folder cannot be
/// read, there are none.
StrayFiles stray_files(const std::string& file, int number);

} // namespace tonetool::sequence
