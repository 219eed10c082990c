// SPDX-License-Identifier: BSD-3-Clause
// How a command says that it cannot go on.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace tonetool {

/// Ends the command line with status 1. The text says what was wrong, the value, and what would
/// be valid; the name of the command is put before it where it is printed.
struct CommandError : std::runtime_error {
    explicit CommandError(const std::string& what, std::string name = "", bool repeated = false)
        : std::runtime_error(what),
          place(std::move(name)),
          again(repeated) {}
    std::string place; ///< with --compat: where oiiotool says it is, if not in the command
    bool again;        ///< with --compat: as oiiotool, which adds an "unknown error"
};

/// The pixels of a file that cannot be read; with --compat the text is the reader's alone.
struct ReadError : CommandError {
    ReadError(const std::string& file, std::string reason)
        : CommandError("cannot read the pixels of \"" + file + "\"" +
                       (reason.empty() ? "" : ": " + reason)),
          why(std::move(reason)) {}
    std::string why;
};

/// Ends a run whose purpose is fulfilled.
struct EndOfRun {};

/// With --compat: a command line that cannot be taken apart, which is answered with the help.
struct UsageError : CommandError {
    using CommandError::CommandError;
};

} // namespace tonetool
