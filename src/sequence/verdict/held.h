// SPDX-License-Identifier: BSD-3-Clause
// Whether a measurement was held to the limits that its check asks for.
#pragma once

#include <string>

#include "sequence/results/results.h"
#include "sequence/verdict/asked.h"

namespace tonetool::sequence {

/// What other limits than the word's it was held to, as the end of a sentence; empty where they are
/// the same.
std::string not_held(const Measurement& measured, const Asked& asked);

} // namespace tonetool::sequence
