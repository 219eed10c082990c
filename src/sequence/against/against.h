// SPDX-License-Identifier: BSD-3-Clause
// The faults that --against finds: what the frames of a shot have else than those of the approved
// version. As those of --qc, they follow from what is kept of the frames alone.
#pragma once

#include <vector>

#include "sequence/against/against_record.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The faults of a single image, the worst first.
std::vector<Fault> against_faults(const AgainstRecord& record);

/// Finds the faults of all frames that --against has compared, and sets the status of these frames.
/// The frames are sorted by number, then view. Throws a runtime_error where a record cannot be
/// read.
void judge_against(std::vector<FrameResult>& frames);

} // namespace tonetool::sequence
