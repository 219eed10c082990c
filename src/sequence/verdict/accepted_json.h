// SPDX-License-Identifier: BSD-3-Clause
// Accepted faults in a JSON file: that of --accept, and that of results.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// Throws where an item of the list is not one.
std::vector<Acceptance> acceptances_in(const nlohmann::ordered_json& list);

} // namespace tonetool::sequence
