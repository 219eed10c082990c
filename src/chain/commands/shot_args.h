// SPDX-License-Identifier: BSD-3-Clause
// exposures=: where the range of exposures comes from.
#pragma once

#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"

namespace tonetool::chain {

/// Sets the luminances that the range follows from. In a run that only measures a shot, the
/// reference is measured instead and the run ends here.
void read_shot_exposures(Session& session, const Call& call, HdrFlipOptions& options);

} // namespace tonetool::chain
