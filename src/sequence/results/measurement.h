// SPDX-License-Identifier: BSD-3-Clause
// The library's summaries as measurements of a check.
#pragma once

#include "sequence/results/results.h"
#include "tonetool/tonetool.h"

namespace tonetool::sequence {

// Without command, names of the images and threshold, which only the caller knows.
Measurement measurement(const FlipSummary& summary);
Measurement measurement(const ErrorSummary& summary);
Measurement measurement(const TmqiSummary& summary);
Measurement measurement(const BiasSummary& summary);

} // namespace tonetool::sequence
