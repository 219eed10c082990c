// SPDX-License-Identifier: BSD-3-Clause
// Finds why a frame could not be checked, from its files alone.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

struct Probe {
    /// Missing, Unreadable, SizeMismatch, or Error if it is none of these.
    Status status = Status::Error;
    std::string message; ///< empty for Error
};

/// Reports the first file that does not exist. If all exist, the message is empty and the status
/// Error.
Probe missing_of(const std::vector<std::string>& files);

/// Reads every pixel of the files and reports the worst problem. Sizes are those of display
/// windows.
Probe probed(const std::vector<std::string>& files);

/// Sets status and message of a frame whose commands have run, from their measurements and
/// warnings. `error` is the first error of the run; if there is one, its cause is searched in
/// `files`.
void settle(FrameResult& frame, const std::string& error, const std::vector<std::string>& files);

} // namespace tonetool::sequence
