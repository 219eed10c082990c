// SPDX-License-Identifier: BSD-3-Clause
// What a file of results says of itself, held against the numbers and faults in it.
#pragma once

#include "sequence/results/results.h"

namespace tonetool::sequence {

/// Draws the status of a frame that was read from a file anew. Where the file calls the frame
/// better than its numbers and faults do, they are believed, and a warning of the frame says so. A
/// runtime_error where it is called worse, or passed without a limit that held: the numbers are not
/// those of the check that was run.
void judge_from_numbers(FrameResult& frame);

/// A runtime_error unless every measurement is one that a word of the check asks for: of its
/// command, held to its limits in the direction of the quantity, and of numbers that do not
/// contradict each other. What an expression says is not known here. A frame that was checked has a
/// measurement of every word, unless the check has --if, --while or --for.
void check_limits(const ShotResult& shot);
/// Throws a runtime_error unless each frame has what --qc and --against of the check have kept,
/// with the limits that it gives them.
void check_searches(const ShotResult& shot);

} // namespace tonetool::sequence
