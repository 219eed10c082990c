// SPDX-License-Identifier: BSD-3-Clause
// --help, printed from the registry and the topics.
#pragma once

#include <string>
#include <vector>

#include "chain/language/registry.h"

namespace tonetool::chain {

/// "-o", "--hdrflip".
std::string dashed(const std::string& name);
/// Each line behind two spaces. `lines` ends with a line break.
std::string indented(const std::string& lines);

/// The modifiers of a command in the order in which help names them.
struct SortedModifiers {
    Modifiers frequent, others, of_curves;
};
SortedModifiers sorted_modifiers(const Command& row);

/// Visits the title of each group and its commands' texts, one behind the other.
template <class Text, class Visit>
void for_each_group(const Text& text_of, const Visit& visit) {
    for (int group = 0; group < kGroupCount; ++group) {
        std::string rows;
        for (const Command& row : all_commands())
            if (row.group == static_cast<Group>(group))
                rows += text_of(row);
        if (!rows.empty())
            visit(group_title(static_cast<Group>(group)), rows);
    }
}

/// A few lines about the use of the program.
std::string usage_text();
/// One screen for the first day: -h.
std::string short_help_text();
/// The list of all commands by group.
std::string help_text();
/// The help of one command with its modifiers.
std::string help_text(const Command& row);
/// The help on a topic, on a command, or on both where they share a name and it is given without
/// dashes; a CommandError where there is neither.
std::string help_about(const std::string& what);
/// The whole registry as "man" (troff), "bash", "zsh" or "fish" (completion), "json"; a
/// CommandError for any other format.
std::string registry_text(const std::string& format);
bool is_registry_format(const std::string& format);

/// Completion for the shells.
std::string bash_completion();
std::string zsh_completion();
std::string fish_completion();
/// The man page.
std::string man_page();

/// The rows of --help and -h.
Rows help_commands();

} // namespace tonetool::chain
