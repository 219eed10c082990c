// SPDX-License-Identifier: BSD-3-Clause
// The verdict as the page's first sentence.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// Which frames need a look and why: "2 of 24 frames need a look: frame 1004: missing; frame 1006:
/// hole (48x48 at 160,64)". `result` is to_json(shot): places of faults are read from there.
std::string look_sentence(const ShotResult& shot, const nlohmann::ordered_json& result);

} // namespace tonetool::sequence
