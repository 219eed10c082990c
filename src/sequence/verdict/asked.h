// SPDX-License-Identifier: BSD-3-Clause
// What the words of a check ask of its measurements.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "sequence/results/diff_limits.h"
#include "sequence/results/measuring.h"
#include "sequence/results/verdict_limits.h"

namespace tonetool::sequence {

using Limits = std::map<std::string, double>; ///< by the name of the quantity

/// A word of the check that measures.
struct Asked {
    bool limited = false; ///< it has a limit
    bool open = false;    ///< but its numbers are those of an expression, which is not known here
    Limits fail, warn;
    std::string metric; ///< of --errormap
    double peak = 1;
    DiffLimits diff;
    VerdictLimits verdict;        ///< of --biascheck, with the numbers
    double within = 0, alpha = 0; ///< that it is held to
};

struct Check {
    std::map<std::string, std::vector<Asked>> asked; ///< by the name of the command
    /// Of --qc and --against, if they are there: the limits of their faults.
    std::map<std::string, std::map<std::string, std::string>> searches;
    bool open = false;   ///< an expression stands for a command
    bool blocks = false; ///< not every word runs once
};

Check check_of(const std::vector<std::string>& words);

} // namespace tonetool::sequence
