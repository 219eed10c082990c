// --help, printed from the registry.
#pragma once

#include <string>

#include "chain/registry.h"

namespace tonetool::chain {

/// How the program is called, in a few lines.
std::string usage_text();
/// All commands by group.
std::string help_text();
/// One command with its modifiers.
std::string help_text(const Command& row);

} // namespace tonetool::chain
