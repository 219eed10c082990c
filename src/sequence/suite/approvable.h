// SPDX-License-Identifier: BSD-3-Clause
// Which cases of a suite can be approved, and by which command line.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// Why the image of a case cannot be approved; empty where it can. `again`: though it passed.
std::string approval_refusal(const FrameResult& frame, bool again);

/// Whether the case is of a suite with approved images, and could be approved.
bool is_approvable(const ShotResult& shot, const FrameResult& frame);
/// The cases of a suite with approved images that could be; empty for anything else.
std::vector<const FrameResult*> approvable_cases(const ShotResult& shot);

/// "tonetool --approve run.json", quoted as a shell wants it. `json`: the file of --json.
std::string approve_start(const std::string& json);
/// The whole line, whose reason is to be filled in; `names`: of cases, quoted.
std::string approve_line(const std::string& json, const std::string& names);

/// The whole command line of the cases that failed, whose reason is to be filled in; empty where
/// none did, or nothing can be approved.
std::string approve_command(const ShotResult& shot, const std::string& json);

} // namespace tonetool::sequence
