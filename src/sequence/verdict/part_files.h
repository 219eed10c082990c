// SPDX-License-Identifier: BSD-3-Clause
// The files that --merge joins: thousands of names are more than a command line may have.
#pragma once

#include <string>
#include <vector>

namespace tonetool::sequence {

/// What the words name, in their order: a file; all *.json of a folder; the files that a word with
/// * or ? fits. The last two in the order of their names, without hidden ones. A runtime_error
/// where there are none.
std::vector<std::string> part_files(const std::vector<std::string>& words);

/// The lines of a file; "-" is the standard input.
std::vector<std::string> lines_of(const std::string& file);

} // namespace tonetool::sequence
