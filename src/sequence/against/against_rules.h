// SPDX-License-Identifier: BSD-3-Clause
// The differences from the approved version that --against looks for, each with its severity and
// limit.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/fault_limits.h"

namespace tonetool::sequence {

const FaultRules& against_rules();

/// A quantity of a kind of layers. Its rule's threshold is the limit of an error; a warning is due
/// at a share of it.
struct AgainstQuantity {
    std::string kind, quantity; ///< of AgainstLayer; "" for any kind with an alpha
    std::string code;           ///< of its rule
    double warning_share;
};
const std::vector<AgainstQuantity>& against_quantities();

} // namespace tonetool::sequence
