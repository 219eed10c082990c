// SPDX-License-Identifier: BSD-3-Clause
// The report's files, written at the end of a check.
#pragma once

#include <string>
#include <vector>

#include "sequence/report/report_page.h"
#include "sequence/results/check_files.h"

namespace tonetool::sequence {

/// Writes "report" and "contactsheet", each whole or not at all; `errors` receives the reasons why
/// a file could not be written. Returns warnings about their content.
std::vector<std::string> write_reports(const ShotResult& shot, const PictureStore& pictures,
                                       const CheckFiles& files, const PageLimits& limits,
                                       std::vector<std::string>& errors);

} // namespace tonetool::sequence
