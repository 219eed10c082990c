// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a measurement that contradict each other. What is wrong is the end of a sentence,
// empty where nothing is.
#pragma once

#include <string>

#include "sequence/results/results.h"
#include "sequence/verdict/asked.h"

namespace tonetool::sequence {

/// Thresholds that are not of the quantities that were measured, or not in their direction.
std::string contradictory_thresholds(const Measurement& measured);

/// Quantities that do not follow from each other, as far as the word's options say how they do.
std::string contradictory_numbers(const Measurement& measured, const Asked& asked);

} // namespace tonetool::sequence
