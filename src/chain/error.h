// How a command says that it cannot go on.
#pragma once

#include <stdexcept>

namespace tonetool::chain {

/// Ends the command line with status 1. The text says what was wrong, the value, and what would
/// be valid; the name of the command is put before it where it is printed.
struct CommandError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

} // namespace tonetool::chain
