// SPDX-License-Identifier: BSD-3-Clause
// What attribute() found, in the results of a check: a line of JSON, which is passed on as it is.
#pragma once

#include <string>
#include <vector>

#include "tonetool/attribute.h"

namespace tonetool::sequence {

/// "findings" (sentences), "lights", "mattes" by type, "layers", "manifest_only" by type.
std::string attribution_json(const AttributeResult& result);

/// The sentences of such a line; none where it has no list of them.
std::vector<std::string> attribution_findings(const std::string& json);

} // namespace tonetool::sequence
