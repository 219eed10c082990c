// What a FLIP command prints, and what its thresholds say.
#pragma once

#include <string>

#include "chain/call.h"
#include "chain/flip_args.h"
#include "chain/session.h"

namespace tonetool::chain {

/// The summary, one fact a line, each with "LABEL: " before it.
std::string summary_text(const std::string& label, const FlipSummary& summary,
                         const std::string& reference, const std::string& test);

/// Prints PASS or FAIL with the name of the test image, warns, and counts in the session. Anything
/// but value <= threshold fails. Returns whether a fail threshold was exceeded.
bool judge(Session& session, const Call& call, const FlipPool& pool, const Thresholds& thresholds,
           size_t test = 0);

} // namespace tonetool::chain
