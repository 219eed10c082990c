// SPDX-License-Identifier: BSD-3-Clause
// Help by subject: what a person wants to do, before the commands have names.
#pragma once

#include <string>
#include <vector>

namespace tonetool::chain {

struct Topic {
    const char* name;
    const char* title; ///< a few words, for the list of topics
    const char* text;  ///< lines of at most 96 characters, each with its line break
};

/// In the order in which help lists them.
const std::vector<Topic>& topics();
/// nullptr for what is no topic.
const Topic* find_topic(const std::string& name);

/// The meaning of each exit status: also part of the man page.
extern const char* const kExitStatusText;

} // namespace tonetool::chain
