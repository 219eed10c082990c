// SPDX-License-Identifier: BSD-3-Clause
// How everything below the border says that it cannot do what it was asked for.
#pragma once

#include <stdexcept>
#include <string>

namespace tonetool {

/// What was wrong, with what value, and what would be valid, in the words of the error that the
/// caller of a public function gets (imagebuf/pixels/guard.h).
struct Refusal : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What `run` returns; the reason of its refusal is said as `say(reason)` says it.
template <class Say, class Run>
auto refusing_as(const Say& say, const Run& run) {
    try {
        return run();
    } catch (const Refusal& refusal) {
        throw Refusal(say(std::string(refusal.what())));
    }
}

} // namespace tonetool
