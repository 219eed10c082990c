// Why a frame could not be checked: its files, looked at by themselves.
#pragma once

#include <string>
#include <vector>

#include "sequence/results/results.h"

namespace tonetool::sequence {

struct Probe {
    Status status = Status::Error; ///< Missing, Unreadable, SizeMismatch, or Error: none of these
    std::string message;           ///< empty for Error
};

/// The first of the files that does not exist; message empty, status Error where all do.
Probe missing_of(const std::vector<std::string>& files);

/// Reads every pixel of the files: the worst that is found. Sizes are those of display windows.
Probe probed(const std::vector<std::string>& files);

/// The status and message of a frame whose commands have run, by what they measured and warned of;
/// `error` is the first thing that went wrong, and `files` are then looked at for the cause.
void settle(FrameResult& frame, const std::string& error, const std::vector<std::string>& files);

} // namespace tonetool::sequence
