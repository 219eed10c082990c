// SPDX-License-Identifier: BSD-3-Clause
// What becomes of the three verdicts of a command that tells noise from change.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

struct VerdictLimits {
    bool fails = true;                 ///< "different" fails; else it warns
    std::string inconclusive = "fail"; ///< what "not enough samples" does: fail, warn or pass
};

inline constexpr char kDifferentName[] = "different", kUndecidedName[] = "undecided";

/// Of a measurement's verdict as thresholds: each is 1 where the verdict is that one, and must be
/// 0. Where "not enough samples" is accepted it has none; it is no pass all the same (see judge()).
/// Too few pixels are never accepted: no number of samples would help.
std::vector<Threshold> verdict_thresholds(const Measurement& measured, const VerdictLimits& limits);

/// Why a verdict is none, or is not what its numbers say; empty: it is.
std::string contradictory_verdict(const Measurement& measured);

} // namespace tonetool::sequence
