// SPDX-License-Identifier: BSD-3-Clause
// How everything inside the library says that it cannot do what it was asked for. Folders that
// stand below throw the standard's type itself.
#pragma once

#include <stdexcept>
#include <string>

namespace tonetool {

/// What was wrong, with what value, and what would be valid, in the words of the error that the
/// caller of a public function gets (imagebuf/pixels/guard.h).
struct Refusal : std::invalid_argument {
    using std::invalid_argument::invalid_argument;
};

/// What `run` returns; the reason of its refusal is said as `say(reason)` says it.
template <class Say, class Run>
auto refusing_as(const Say& say, const Run& run) {
    try {
        return run();
    } catch (const std::invalid_argument& refusal) {
        throw Refusal(say(std::string(refusal.what())));
    }
}

} // namespace tonetool
