// SPDX-License-Identifier: BSD-3-Clause
// Results that would be written over what a line reads or writes itself.
#pragma once

#include "runs/frames.h"

namespace tonetool::runs {

/// A CommandError where a file that is written at the end is one that the line, with the words of
/// one of its runs, reads or writes itself, by whatever name. `parts`: of --merge.
void refuse_to_write_over(const FramePlan& plan, const Strings& parts = {});

} // namespace tonetool::runs
