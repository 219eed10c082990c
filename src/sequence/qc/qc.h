// Faults of the pictures of a shot, without a reference: what --qc finds.
//
// They are drawn from the facts of the frames alone (FrameResult::qc), all anew, so that it does
// not matter in which order or on how many machines the frames were measured.
#pragma once

#include <vector>

#include "sequence/qc/qc_json.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The faults of one picture by itself, the worst first.
std::vector<Fault> picture_faults(const QcRecord& record);

/// Finds the faults of all frames that --qc has measured, and judges these frames. A frame whose
/// number is missing altogether is a fault of the next one. The frames come back sorted by number,
/// then view. A runtime_error where a record cannot be read.
void judge_qc(std::vector<FrameResult>& frames);

/// A line for each fault, in the order of the frames: "qc: frame 5: error blacklayer: ...".
std::string faults_text(const ShotResult& shot);

} // namespace tonetool::sequence
