// SPDX-License-Identifier: BSD-3-Clause
// The faults of a shot for people.
#pragma once

#include <string>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// A line for each fault, in the order of the frames: "qc: frame 5: error blacklayer: ...". A
/// difference from the approved version that frames one after the other have is told once, by the
/// frame that has most of it; of the differences of one frame the first four, unless `all` are
/// asked for.
std::string faults_text(const ShotResult& shot, bool all = false);

} // namespace tonetool::sequence
