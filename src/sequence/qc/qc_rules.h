// SPDX-License-Identifier: BSD-3-Clause
// The faults that --qc looks for, each with its severity and threshold.
#pragma once

#include "sequence/results/fault_limits.h"

namespace tonetool::sequence {

const FaultRules& qc_rules();

} // namespace tonetool::sequence
