// SPDX-License-Identifier: BSD-3-Clause
// The commands of tonetool itself, as rows of the registry.
#pragma once

#include <vector>

#include "chain/session/call.h"
#include "chain/session/session.h"

namespace tonetool::chain {

std::vector<Command> compare_commands();
std::vector<Command> diff_commands();
std::vector<Command> qc_commands();
std::vector<Command> exposure_commands();
std::vector<Command> tone_commands();
std::vector<Command> cgtmo_commands();
std::vector<Command> light_commands();
std::vector<Command> memory_commands();

/// All rows of these commands.
std::vector<Command> own_commands();

} // namespace tonetool::chain
