// SPDX-License-Identifier: BSD-3-Clause
// What the words of a line leave on the stack of images, as far as that is known before it runs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chain/language/line.h"
#include "runs/check_plan.h"

namespace tonetool::runs {

/// What is known of an image before anything is read.
struct StackedImage {
    std::optional<size_t> file{}; ///< the place of its word; none: a command or a label made it
    bool unchanged = true;        ///< no command has worked on it
};

/// A command that runs, and the stack that it finds; of `pops` images it makes others.
struct StackedCommand {
    const chain::Word& word;
    const std::vector<StackedImage>& stack;
    size_t pops;
};

/// How far a line was followed.
struct Followed {
    bool all = false; ///< no --if, expression or unknown number of images was in the way
    /// The command that never runs, and what is wrong with it: it waits for images that do not
    /// come, or its modifiers are not valid. Empty: there is none.
    std::string command{}, mistake{};
    std::vector<size_t> files{}; ///< the places of all files
};

/// Runs the numbers of images that commands take and leave, and visits each command in the order
/// in which they run: one that lacks images waits for them.
Followed follow_stack(const chain::ParsedLine& line, const CheckPlan& check,
                      const std::function<void(const StackedCommand&)>& visit);

} // namespace tonetool::runs
