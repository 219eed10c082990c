// SPDX-License-Identifier: BSD-3-Clause
// --approve and --approved: the only lines that write to a store of approved images, and that list
// one.
#pragma once

#include <iosfwd>

#include "chain/language/line.h"

namespace tonetool::runs {

/// Whether the line is one of the two.
bool is_of_store(const chain::ParsedLine& line);

/// Runs it. A CommandError where something is refused: then nothing is approved.
int run_store_line(const chain::ParsedLine& line, std::ostream& out);

} // namespace tonetool::runs
