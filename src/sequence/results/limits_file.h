// SPDX-License-Identifier: BSD-3-Clause
// The file that --noisefloor writes: limits that come from renders of the approved version.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"
#include "tonetool/bias.h"

namespace tonetool::sequence {

/// Of one quantity.
struct KeptLimit {
    std::string quantity;
    NoiseFloor floor;
    std::vector<double> values; ///< of the seeds, in their order
};

struct KeptLimits {
    std::string command; ///< "hdrflip"
    Texts modifiers;     ///< of that command, which decide what its numbers are
    NoiseFloorOptions options;
    std::vector<KeptLimit> limits;
    std::string reference;
    std::vector<std::string> seeds;
    std::string baseline; ///< whether the reference lies among the seeds, as a sentence
    std::vector<std::string> warnings;
};

std::string to_json(const KeptLimits& limits);

/// What fail=FILE needs of it: command, modifiers and limits. Of the JSON of a check, the limit of
/// `quantity` is 1.1 times the largest value in the frames that passed, by the measurements of
/// `command`. A runtime_error where the file is neither.
KeptLimits read_limits(const std::string& file, const std::string& command,
                       const std::string& quantity);

/// Whether the text of fail= or warn= names a file instead of numbers.
bool names_limits_file(const std::string& text);

/// "mean=0.01,p99=0.2", with every digit.
std::string limits_text(const KeptLimits& limits);

} // namespace tonetool::sequence
