// SPDX-License-Identifier: BSD-3-Clause
// Modifiers of the lights of a scene, for all commands that have them.
#pragma once

#include <vector>

#include "chain/commands/commands.h"
#include "tonetool/lights.h"

namespace tonetool::chain {

/// lights=, lightunit=, index=, groups=.
LightOptions light_options(const Call& call);

} // namespace tonetool::chain
