// SPDX-License-Identifier: BSD-3-Clause
// What a file of results says of all its frames together.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// How many frames have each status.
nlohmann::ordered_json counts_of(const std::vector<Status>& frames);
nlohmann::ordered_json counts_of(const ShotResult& shot);

/// Number and view of the worst frames.
nlohmann::ordered_json worst_of(const ShotResult& shot);

/// A runtime_error unless what the file says of all frames is of those that it has: none was taken
/// out or put in since. `said` is what it calls each; where numbers were believed rather than that
/// word, only what the words make is known.
void check_summary(const nlohmann::ordered_json& from, const std::vector<Status>& said,
                   const ShotResult& shot);

} // namespace tonetool::sequence
