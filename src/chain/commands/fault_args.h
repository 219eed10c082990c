// SPDX-License-Identifier: BSD-3-Clause
// The modifiers of commands that look for faults: --qc, --against.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chain/commands/commands.h"
#include "sequence/results/fault_limits.h"

namespace tonetool::chain {

/// One for each rule, with its limit where it has one.
Modifiers fault_modifiers(const sequence::FaultRules& rules);
sequence::FaultLimits fault_limits(const Call& call, const sequence::FaultRules& rules);

/// The types of channels that files had; only the stack still knows those of images that were read.
void take_types(const Image& image, std::vector<std::pair<std::string, std::string>>& channels);

} // namespace tonetool::chain
