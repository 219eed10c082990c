// SPDX-License-Identifier: BSD-3-Clause
// The files that a check writes at its end.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sequence/results/case_files.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// File names by the command that asks for them: "json", "csv", "junit". Others are not looked at.
using CheckFiles = std::map<std::string, std::string>;

/// Throws a runtime_error for files that could not be written anyway, before the work and not after
/// it.
void check_places(const CheckFiles& files);

/// Makes and removes a file in the folder of each result, without touching what is there. Throws a
/// runtime_error where that cannot be done.
void try_places(const CheckFiles& files);
/// The same in one folder, or where it will be made; `what` begins the error.
void try_folder(const std::string& folder, const std::string& what);

/// Writes each file whole or not at all; `records`: the JSON has those of --qc; `images`: of
/// --images. Returns why some files could not be written.
std::vector<std::string> write_results(const ShotResult& shot, const CheckFiles& files,
                                       bool records, const CaseFiles& images = {});

/// Runs `write` and adds the exception that it throws to the errors.
void attempt(std::vector<std::string>& errors, const std::function<void()>& write);

/// Whether one of the files is "-": nothing else may then go to the standard output.
bool has_standard_output(const CheckFiles& files);

/// Writes a text to a file, or to the standard output if the file is "-". Throws a runtime_error
/// with the reason on failure.
void write_text(const std::string& text, const std::string& file);

} // namespace tonetool::sequence
