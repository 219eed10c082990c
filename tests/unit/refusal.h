// SPDX-License-Identifier: BSD-3-Clause
// What a function of the library that throws says.
#pragma once

#include <string>

#include "metrics/refusal.h"

namespace tonetool {

/// The reason why `run` refuses; empty if it does not.
template <class Run>
std::string refusal(const Run& run) {
    try {
        run();
        return {};
    } catch (const std::invalid_argument& why) {
        return why.what();
    }
}

} // namespace tonetool
