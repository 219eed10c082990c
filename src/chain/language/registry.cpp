// SPDX-License-Identifier: BSD-3-Clause
#include "chain/language/registry.h"

#include <algorithm>
#include <iterator>

#include "imagebuf/pixels/names.h"

namespace tonetool::chain {

namespace {

// Rows keep their places: calls point at them.
std::deque<Command>& registry() {
    static std::deque<Command> all;
    return all;
}

} // namespace

std::string group_title(Group group) {
    static const char* const titles[kGroupCount] = {
        "Comparing a test image with a reference",
        "Checks of whole sequences",
        "Measuring",
        "Colour, tone mapping and exposure",
        "Commands that read images",
        "Commands that write images, and what they write",
        "Commands that print",
        "Channels and subimages",
        "Geometry",
        "Arithmetic",
        "Filters",
        "Compositing and deep images",
        "Creating and drawing",
        "Metadata, without touching pixels",
        "Image stack",
        "Control flow and scripting",
        "General",
    };
    return titles[static_cast<int>(group)];
}

bool names_file(const std::string& hint) {
    const std::string last = split(hint, '|').back();
    return last == "FILE" || last == "FILENAME";
}

bool value_names_file(const Modifier& modifier, const std::string& value) {
    return names_file(modifier.hint) &&
           (modifier.hint != kCurveHint || value.find_first_of("./") != std::string::npos);
}

bool Command::writes() const {
    return group == Group::Check || (!args.empty() && args.front() == kLimitsArgument) ||
           (group == Group::Write && std::any_of(args.begin(), args.end(), names_file));
}

bool Command::writes_to(const std::string& key) const {
    return std::any_of(modifiers.begin(), modifiers.end(), [&](const Modifier& modifier) {
        return modifier.key == key && modifier.writes();
    });
}

std::string Command::label() const {
    return names.front().size() == 1 ? "-" + names.front() : names.front();
}

Modifiers concatenated(const std::vector<Modifiers>& lists) {
    Modifiers all;
    for (const Modifiers& list : lists)
        all.insert(all.end(), list.begin(), list.end());
    return all;
}

Row::Row(const std::string& usage, std::string help, Run run) {
    const Strings words = split(usage, ' ');
    m_command.names = split(words.front(), '|');
    m_command.args.assign(words.begin() + 1, words.end());
    m_command.help = std::move(help);
    m_command.run = std::move(run);
}

Command Row::finished(Group group_of_family, bool own) const {
    Row row = *this;
    row.m_command.group = m_group.value_or(group_of_family);
    row.m_command.own = own;
    if (m_command.of_subimages) {
        row.modifier("subimages", "N,NAME,...", "of these subimages (-N: of all but N), or all")
            .modifier("allsubimages", "0|1", "of all subimages (as -a says)");
    }
    return row.m_command;
}

void add_commands(Group group, const Rows& rows, bool own) {
    for (const Row& row : rows)
        registry().push_back(row.finished(group, own));
}

const std::deque<Command>& all_commands() {
    return registry();
}

const Command* find_command(const std::string& name) {
    for (const Command& row : all_commands())
        if (std::find(row.names.begin(), row.names.end(), name) != row.names.end())
            return &row;
    return nullptr;
}

namespace {

Strings near_commands(const std::string& name, size_t most) {
    Strings names;
    for (const Command& row : all_commands())
        names.insert(names.end(), row.names.begin(), row.names.end());
    Strings near = nearest_names(name, names, most);
    for (std::string& word : near)
        word.insert(0, word.size() == 1 ? "-" : "--");
    return near;
}

} // namespace

std::string nearest_command(const std::string& name) {
    return join(near_commands(name, 1), "");
}

std::string suggest_command(const std::string& name) {
    const std::string near = join(near_commands(name, 3), " or ");
    return near.empty() ? "--help lists all commands"
                        : "did you mean " + near + "? (--help lists all commands)";
}

} // namespace tonetool::chain
