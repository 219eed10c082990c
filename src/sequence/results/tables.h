// SPDX-License-Identifier: BSD-3-Clause
// Results as texts for other programs: CSV, JUnit's XML, and numbers of frames.
#pragma once

#include <string>

#include "sequence/results/case_files.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// A line per frame under a line of names: of cases name and method first, then frame, view,
/// status, message, reference, test, faults, then for each measurement COMMAND.threshold (for
/// further thresholds COMMAND.threshold.QUANTITY) and COMMAND.QUANTITY ("hdrflip#2.mean" for the
/// second of the same name). RFC 4180; a text that a spreadsheet would take for a formula gets an
/// apostrophe before it. Numbers come back to the bit.
std::string csv_text(const ShotResult& shot);

/// A test case per frame: failed frames are failures, frames that could not be checked errors, and
/// frames that were measured without a threshold are skipped, not passed. The images of a frame are
/// its attachments. No two test cases have the same names: GitLab reads only the first of those.
std::string junit_text(const ShotResult& shot, const CaseFiles& images = {});

/// The numbers of the frames to render again, those of the tests, in one line:
/// "1004,1006,1009-1011"; empty where there is none. `from`: the least status that counts, Warning
/// or Failed.
std::string bad_frames_text(const ShotResult& shot, Status from);

} // namespace tonetool::sequence
