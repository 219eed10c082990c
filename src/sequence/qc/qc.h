// SPDX-License-Identifier: BSD-3-Clause
// The faults that --qc finds in the images of a shot, without a reference.
//
// They are computed from the facts of the frames alone (FrameResult::qc) and always for the whole
// shot, so it does not matter in which order or on how many machines the frames were measured.
#pragma once

#include <vector>

#include "sequence/qc/qc_json.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The faults of a single image, the worst first.
std::vector<Fault> picture_faults(const QcRecord& record);

/// Finds the faults of all frames that --qc has measured, and sets the status of these frames.
/// Where a frame number is missing altogether, the fault is reported at the next frame. The frames
/// are sorted by number, then view. Throws a runtime_error where a record cannot be read.
/// `keep_records`: in FrameResult::record.
void judge_qc(std::vector<FrameResult>& frames, bool keep_records = false);

} // namespace tonetool::sequence
