// SPDX-License-Identifier: BSD-3-Clause
// fail=auto: limits that follow from the shot itself.
#pragma once

#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// With fewer frames nobody knows what is usual.
constexpr size_t kEnoughForLimit = 5;

/// Sets the limits of fail=auto from the values of all frames, in each view: their median and five
/// standard deviations, which are estimated by the median distance from it; at least 1.15 times the
/// median. This finds frames that are unlike the others, never what all of them have.
void set_automatic_limits(std::vector<FrameResult>& frames);

/// Whether a limit is of that kind.
bool has_automatic_limit(const FrameResult& frame);

} // namespace tonetool::sequence
