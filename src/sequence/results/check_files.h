// The files that a check writes at its end.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// File names by the command that asks for them: "json", "csv", "junit". Others are not looked at.
using CheckFiles = std::map<std::string, std::string>;

/// A runtime_error for files that could not be written anyway: before the work and not after it.
void check_places(const CheckFiles& files);

/// Each is written whole or not at all. Why some could not be, naming them.
std::vector<std::string> write_results(const ShotResult& shot, const CheckFiles& files);

/// Runs `write`; what it throws is added to the errors.
void attempt(std::vector<std::string>& errors, const std::function<void()>& write);

/// Whether one of the files is "-": the standard output is for it alone.
bool has_standard_output(const CheckFiles& files);

/// A text as a file, or as what the standard output gets of "-"; a runtime_error says why not.
void write_text(const std::string& text, const std::string& file);

} // namespace tonetool::sequence
