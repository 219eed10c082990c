// SPDX-License-Identifier: BSD-3-Clause
// A case that only the reference has, and one that only the test has, may be the same one.
#pragma once

#include <string>
#include <vector>

#include "sequence/frames/pairing.h"

namespace tonetool::sequence {

/// For each item ", renamed? "b" is there", or empty. Of those that one side lacks: files with the
/// same bytes belong together, else names that differ in at most two letters.
std::vector<std::string> renamed_hints(const Pairing& pairs, const std::vector<bool>& no_reference,
                                       const std::vector<bool>& no_test);

} // namespace tonetool::sequence
