// SPDX-License-Identifier: BSD-3-Clause
#include "chain/language/registry.h"

#include <algorithm>
#include <iterator>

#include "imagebuf/pixels/names.h"

namespace tonetool::chain {

namespace {

// Rows keep their places: calls point at them.
std::deque<Command> collect() {
    std::deque<Command> all;
    for (auto family : {general_commands, control_commands, read_commands, write_commands,
                        texture_commands, inspect_commands, color_commands, metadata_commands,
                        create_commands, arithmetic_commands, geometry_commands, filter_commands,
                        composite_commands, ocio_commands, channel_commands, stack_commands}) {
        std::vector<Command> rows = family();
        std::move(rows.begin(), rows.end(), std::back_inserter(all));
    }
    return all;
}

std::deque<Command>& registry() {
    static std::deque<Command> all = collect();
    return all;
}

} // namespace

std::string group_title(Group group) {
    static const char* const titles[kGroupCount] = {
        "General",
        "Control flow and scripting",
        "Commands that read images",
        "Commands that write images, and what they write",
        "Commands that print",
        "Metadata, without touching pixels",
        "Comparing a test image with a reference",
        "Measuring",
        "Checks of whole sequences",
        "Creating and drawing",
        "Arithmetic",
        "Geometry",
        "Filters",
        "Compositing and deep images",
        "Colour and exposure",
        "Channels and subimages",
        "Image stack",
    };
    return titles[static_cast<int>(group)];
}

bool names_file(const std::string& hint) {
    const std::string last = split(hint, '|').back();
    return last == "FILE" || last == "FILENAME";
}

bool Command::writes() const {
    return group == Group::Check ||
           (group == Group::Write && std::any_of(args.begin(), args.end(), names_file));
}

bool Command::writes_to(const std::string& key) const {
    return std::any_of(modifiers.begin(), modifiers.end(), [&](const Modifier& modifier) {
        return modifier.key == key && modifier.writes();
    });
}

Command of_process(Command row) {
    row.of_process = true;
    return row;
}

Command of_manner(Command row) {
    row.manner = true;
    return row;
}

std::vector<Command> keeping_headers(std::vector<Command> rows) {
    for (Command& row : rows)
        row.keeps_header = true;
    return rows;
}

std::string Command::label() const {
    return names.front().size() == 1 ? "-" + names.front() : names.front();
}

Command setting(Group group, Strings names, Strings args, std::string help, Run run,
                std::vector<Modifier> modifiers) {
    Shape shape{std::move(names), std::move(args), 0, 0, group};
    return {std::move(shape), std::move(modifiers), std::move(help), std::move(run)};
}

void add_commands(std::vector<Command> rows) {
    std::move(rows.begin(), rows.end(), std::back_inserter(registry()));
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
