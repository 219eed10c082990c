// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a command line over frames before the first of them is read.
#pragma once

#include <iosfwd>

#include "runs/frames.h"

namespace tonetool::runs {

/// Tries the places of everything that the line will write; a runtime_error where one is none.
void try_outputs(const FramePlan& plan);

/// A CommandError where --figure names a case or a method that there is not, or --table has no
/// names to write.
void check_cases_asked_for(const FramePlan& plan);

/// A CommandError where all frames of a shot are the same files in both sequences, by links or
/// other names: nothing would be compared. Some may be, as versions share frames that did not
/// change.
void refuse_shot_against_itself(const FramePlan& plan);

/// Prints what is wrong with the commands of the line, or with the layers that they ask for, as
/// their run would; false where something is. A layer is looked for in the headers of the first
/// frame that is there, and only where that lacks it in those of all others. `worker`: in a process
/// of its own, as libraries read files.
bool commands_are_right(const FramePlan& plan, std::ostream& err, bool worker);

/// --dry-run: the frames that are asked for and those that are there, and the places of results.
std::string plan_text(const FramePlan& plan);
/// The second part of it.
std::string places_text(const FramePlan& plan);

} // namespace tonetool::runs
