// SPDX-License-Identifier: BSD-3-Clause
// What did not pass, as continuous integration shows it.
#pragma once

#include <string>

#include "sequence/results/case_files.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// --github: a line "::error title=...::message" or "::warning ..." for each frame that did not
/// pass, in
/// their order. GitHub shows ten of a kind for a step: of more the tenth counts the rest, and the
/// nine are the worst.
std::string github_text(const ShotResult& shot);

/// --summary: a heading with the verdict, the sentence, and a table in Markdown of the frames that
/// did not pass. GitHub refuses a summary of more than 1 MiB as a whole: it is cut at 200 rows or
/// 900 kB, with a line that counts the rest. `json`: the file that --approve is to read.
std::string summary_text(const ShotResult& shot, const std::string& json);

/// --ctest: a line for each number that has a limit (or the first where none has), for the verdict
/// and for each image, as CTest finds them in what a test prints. Of several cases the names begin
/// with the case's, and only the worst has images: CDash compares what is called TestImage,
/// ValidImage and DifferenceImage2.
std::string ctest_text(const ShotResult& shot, const CaseFiles& images);

/// Adds the text to the end of a file, which may hold others' already. Throws a runtime_error where
/// it cannot be written.
void append_text(const std::string& text, const std::string& file);

} // namespace tonetool::sequence
