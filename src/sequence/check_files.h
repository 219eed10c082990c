// The files that a check writes at its end.
#pragma once

#include <map>
#include <string>

#include "sequence/results.h"

namespace tonetool::sequence {

/// File names by the command that asks for them: "json", "csv", "junit". Others are not looked at.
using CheckFiles = std::map<std::string, std::string>;

/// A runtime_error for files that could not be written anyway: before the work and not after it.
void check_places(const CheckFiles& files);

/// Each is written whole or not at all; a runtime_error names the first that could not be.
void write_results(const ShotResult& shot, const CheckFiles& files);

/// A text as a file; a runtime_error says why not.
void write_text(const std::string& text, const std::string& file);

} // namespace tonetool::sequence
