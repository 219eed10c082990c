// SPDX-License-Identifier: BSD-3-Clause
// The versioned JSON form of results. Numbers come back to the bit; NaN and infinities are the
// texts "nan", "inf", "-inf". Fields that are empty or unset are left out; bytes of names that are
// no UTF-8 become U+FFFD.
#pragma once

#include <functional>
#include <string>

#include "sequence/results/results.h"

namespace tonetool::sequence {

inline constexpr char kResultsFormat[] = "tonetool-check";
inline constexpr int kResultsVersion = 2;

/// The text of --json: {"format", "version", "verdict", "sentence", "check", "id", "counts",
/// "exposures", "worst", "accepted", "frames"}, with "worst" as frame numbers. Ends with a line
/// break. Frames whose records of --qc are left out (`records`) cannot be merged, which "records":
/// false says before them.
std::string to_json(const ShotResult& shot, bool records = true);
/// The same in pieces, which are given to `to` in their order: a shot may have ten thousand frames.
void put_json(const ShotResult& shot, bool records,
              const std::function<void(const std::string& piece)>& to);
/// A runtime_error that says what is wrong where, for text that is no such file, of another
/// version, or whose frames are not whole, or not those that the file's own counts, verdict and
/// sentence are of. The verdict is drawn anew from the frames.
ShotResult shot_from_json(const std::string& text);

/// The text as a JSON string, with its quotes.
std::string json_string(const std::string& text);

/// One frame, as --state and --merge keep it.
std::string to_json(const FrameResult& frame);
FrameResult frame_from_json(const std::string& text);

} // namespace tonetool::sequence
