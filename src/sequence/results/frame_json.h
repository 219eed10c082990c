// SPDX-License-Identifier: BSD-3-Clause
// The frames in the JSON of a check, and its exposures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The name, method and view of a frame, as far as it has them.
void put_names(nlohmann::ordered_json& to, const Item& item);

/// A frame as it lies in a file, `depth` deep, without a line break at its end; with its record of
/// --qc or without.
std::string frame_text(const FrameResult& frame, bool record, size_t depth);
/// A frame whose record may be an index into `records` (records.h).
FrameResult frame_from(const nlohmann::ordered_json& from,
                       const std::vector<std::string>& records = {});
/// The "status" of a frame or measurement.
Status status_from(const nlohmann::ordered_json& from);

nlohmann::ordered_json exposures_json(const ShotExposures& exposures);
ShotExposures exposures_from(const nlohmann::ordered_json& from);

nlohmann::ordered_json suite_json(const SuiteOrigin& suite);
SuiteOrigin suite_from_json(const nlohmann::ordered_json& from);

} // namespace tonetool::sequence
