// SPDX-License-Identifier: BSD-3-Clause
// The light of a shot as texts, and what a run does with it before its frames.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "runs/frames.h"
#include "tonetool/shot_numbers.h"

namespace tonetool::runs {

/// As ToneAlgo's, but that errors are thrown.
std::string shot_text(const ShotStatistics& shot);
ShotStatistics shot_of_text(const std::string& text);

/// The commands of a line that measure a shot before its frames run: those that ask for it by name,
/// the others where there are several frames, or the statistics are what is asked for.
std::vector<ShotCommand> shots_to_measure(const FramePlan& plan);

/// Whether a file is the statistics of a shot, and not of exposures=.
bool is_shot_file(const std::string& file);
/// The statistics of all parts as one text. A CommandError where frames of `expected` are in none.
std::string merged_shots(const std::vector<std::string>& parts,
                         const std::vector<sequence::Item>& expected);

/// Why a shot must not be measured without the frames that could not be: "frame 3: ...", or what is
/// said of them where they are left out.
std::string unmeasured_text(const FramePlan& plan, const std::vector<size_t>& failed,
                            const std::string& first_error);

} // namespace tonetool::runs
