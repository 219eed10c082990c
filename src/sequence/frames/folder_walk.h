// SPDX-License-Identifier: BSD-3-Clause
// All files below a folder.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace tonetool::sequence {

/// Paths below the folder, sorted by bytes, at most `depth` folders down; none where it is no
/// folder. `pattern` is for the message of the runtime_error where a folder cannot be listed.
std::vector<std::string> files_below(const std::string& folder, size_t depth,
                                     const std::string& pattern);

} // namespace tonetool::sequence
