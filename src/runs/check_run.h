// SPDX-License-Identifier: BSD-3-Clause
// Command lines over frames, from the plan to the files that a check writes.
#pragma once

#include <iosfwd>

#include "runs/frames.h"

namespace tonetool::runs {

/// Runs the frames of the plan, measures the exposures of the shot before where they are asked
/// for, joins parts where that is asked for. The exit status; exceptions are errors of the whole.
/// `workers`: frames of a check run in worker processes (workers.h).
int run_plan(const FramePlan& plan, std::ostream& out, std::ostream& err, bool workers);

} // namespace tonetool::runs
