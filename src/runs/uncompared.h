// SPDX-License-Identifier: BSD-3-Clause
// Images of a check that no command looks at: such a line would pass without having compared them.
#pragma once

#include <vector>

#include "chain/language/line.h"
#include "runs/check_plan.h"

namespace tonetool::runs {

/// What becomes of the images of a line, as far as that is certain before it runs.
struct Reading {
    bool certain = false;             ///< no --if, expression or waiting command is in the way
    std::vector<size_t> unused{};     ///< places of the images that no command uses
    std::vector<size_t> references{}; ///< of those that a command compares others with
    std::vector<size_t> tests{};      ///< and of these others
};
Reading reading_of(const chain::ParsedLine& line, const CheckPlan& check);

/// A CommandError where the line of a check reads an image that no command uses, or names a folder
/// or a shell's wildcard in place of images.
void refuse_uncompared(const chain::ParsedLine& line, const CheckPlan& check);

} // namespace tonetool::runs
