// SPDX-License-Identifier: BSD-3-Clause
// Cases that have names: the files that "refs/%N.exr" and "out/%M/%N.exr" stand for, and which of
// them are compared.
#pragma once

#include <string>
#include <vector>

#include "sequence/frames/file_sequence.h"
#include "sequence/frames/pairing.h"

namespace tonetool::sequence {

/// The files on the disk that the pattern stands for, in folders of any depth where it has %N. What
/// begins with a dot is left out, below the fixed part of the pattern. Links to folders are
/// followed, each folder once, by the path without links if there is one. Throws a runtime_error
/// where a folder cannot be listed.
Files list_named(const std::string& pattern, const PatternOptions& options);

/// The union of what the sides have: a case that one of them lacks is missing there. A side without
/// %M, # or %V is the same for all methods, frames or views. Throws a runtime_error where there is
/// no case at all, which says what is in the folder.
Pairing pair_named(const std::vector<Side>& sides, const PatternOptions& options);

} // namespace tonetool::sequence
