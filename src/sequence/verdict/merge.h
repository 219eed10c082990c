// SPDX-License-Identifier: BSD-3-Clause
// --merge: the results of parts of a shot as one.
#pragma once

#include <string>
#include <vector>

#include "sequence/frames/file_sequence.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The shot whose parts are these files (--json of the same command line over other frames).
/// Frames of `expected` that no part has are Errors; if it is empty, the frames of the parts and
/// those between them (fill_holes()) are expected, and a part that cannot be read is a
/// runtime_error, as are parts of different checks and frames that are there twice. With `expected`
/// an unreadable part only adds a line to `complaints`. Of several parts, frames whose images were
/// written after their part are Errors, where the images are to be found.
ShotResult merged(const std::vector<std::string>& parts, const std::vector<Item>& expected,
                  std::vector<std::string>& complaints);

/// Whether merged() has added the frame, since no part has a result of it.
bool is_of_no_part(const FrameResult& frame);

/// The samples of several exposure files as one file's text.
std::string merged_exposures(const std::vector<std::string>& parts);

} // namespace tonetool::sequence
