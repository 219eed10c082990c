// SPDX-License-Identifier: BSD-3-Clause
// Frame ranges as oiiotool writes them.
#pragma once

#include <string>
#include <vector>

namespace tonetool::sequence {

/// The most frames that a range or a pair of sequences may have.
inline constexpr long long kMostFrames = 1000000;

/// "1-10", "1,3,5-9", "10-1", "-3-2", "1-10x2" (every second), "1-10y3" (all but every third).
/// Throws a runtime_error for anything else, also for text behind a range; if `lenient`, such text
/// is ignored, as oiiotool does.
std::vector<int> parse_frames(const std::string& range, bool lenient = false);

/// The shortest range of these numbers, which ascend: "1-4,9".
std::string range_text(const std::vector<int>& numbers);

} // namespace tonetool::sequence
