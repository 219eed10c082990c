// The command language: runs one command line.
#pragma once

#include <iosfwd>

#include "chain/text.h"

namespace tonetool::chain {

/// Run the words of a command line (without the program's name) from left to right. Returns the
/// exit status: 0 passed; 1 an error; 2 only warnings, with --warnings-exit; 3 a threshold was
/// exceeded. No exception leaves it.
int run(const Strings& words, std::ostream& out, std::ostream& err);

} // namespace tonetool::chain
