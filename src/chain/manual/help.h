// SPDX-License-Identifier: BSD-3-Clause
// --help, printed from the registry.
#pragma once

#include <string>
#include <vector>

#include "chain/language/registry.h"

namespace tonetool::chain {

using chain::Command;

/// A few lines about the use of the program.
std::string usage_text();
/// The list of all commands by group.
std::string help_text();
/// The help of one command with its modifiers.
std::string help_text(const Command& row);
/// The whole registry as "man" (troff), "bash" or "zsh" (completion), "json"; a CommandError for
/// any other format.
std::string registry_text(const std::string& format);
bool is_registry_format(const std::string& format);

/// The row of --help.
Rows help_commands();

} // namespace tonetool::chain
