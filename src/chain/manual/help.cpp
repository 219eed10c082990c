// SPDX-License-Identifier: BSD-3-Clause
#include "chain/manual/help.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "chain/manual/topics.h"
#include "text/error.h"
#include "tonetool/export.h"

namespace tonetool::chain {

namespace {

std::string padded(std::string text, size_t width) {
    text.resize(std::max(text.size() + 1, width), ' ');
    return text;
}

std::string signature(const Command& row) {
    Strings names;
    for (const std::string& name : row.names)
        names.push_back(dashed(name));
    std::string text = join(names, ", ");
    for (const std::string& argument : row.args)
        text += " " + argument;
    return text;
}

// In a list of commands.
std::string listed(const Command& row) {
    return "    " + padded(signature(row), 30) + row.help + "\n";
}

std::string images_text(const Command& row) {
    auto count = [](bool varies, int images) {
        return varies ? (images > 0 ? std::to_string(images) + " or more" : "as many as asked for")
                      : std::to_string(images);
    };
    if (row.takes_all)
        return "    images popped: all, pushed: 0\n";
    return "    images popped: " + count(row.pops_of != nullptr, row.pops) +
           ", pushed: " + count(row.pushes_of != nullptr || row.pushes < 0, row.pushes) + "\n";
}

std::string modifiers_text(const std::string& title, const Modifiers& modifiers) {
    std::string text = modifiers.empty() ? "" : "    " + title + ":\n";
    for (const Modifier& modifier : modifiers)
        text += "      " + padded(modifier.key + "=" + modifier.hint, 34) + modifier.help + "\n";
    return text;
}

std::string topics_text() {
    std::string text;
    for (const Topic& topic : topics())
        text += "    --help " + padded(topic.name, 23) + topic.title + "\n";
    return text;
}

// The commands that a first day needs.
const char* const kFirstCommands[] = {"against", "biascheck", "qc",      "hdrflip", "diff",
                                      "report",  "json",      "tonemap", "info",    "o"};

} // namespace

std::string dashed(const std::string& name) {
    return (name.size() == 1 ? "-" : "--") + name;
}

SortedModifiers sorted_modifiers(const Command& row) {
    SortedModifiers sorted;
    for (const std::string& key : row.frequent) {
        for (const Modifier& modifier : row.modifiers)
            if (modifier.key == key)
                sorted.frequent.push_back(modifier);
    }
    for (const Modifier& modifier : row.modifiers) {
        const bool named =
            std::find(row.frequent.begin(), row.frequent.end(), modifier.key) != row.frequent.end();
        if (!named)
            (modifier.of_curve ? sorted.of_curves : sorted.others).push_back(modifier);
    }
    return sorted;
}

std::string usage_text() {
    return "Usage: tonetool [filename|command]...\n"
           "  A file name reads an image and pushes it on the stack; commands work on the stack,\n"
           "  from left to right. One or two dashes are the same. Modifiers follow a command's\n"
           "  name: --hdrflip:tonemapper=hable:fail=p99.9=0.7\n";
}

std::string short_help_text() {
    std::string text = "tonetool " TONETOOL_VERSION " compares HDR images and shows them\n\n" +
                       usage_text() +
                       "\nExamples:\n"
                       "  tonetool ref.exr test.exr --hdrflip:fail=p99.9=0.7 -o error.exr\n"
                       "  tonetool ref.#.exr test.#.exr --hdrflip:exposures=shot --report "
                       "check.html\n"
                       "  tonetool picture.exr --tonemap:curve=agx -o picture.png\n"
                       "\nThe commands that matter first:\n";
    for (const char* name : kFirstCommands) {
        const Command* row = find_command(name);
        if (row)
            text += listed(*row);
    }
    return text +
           "\nRead on:\n"
           "    --help                        all commands\n"
           "    --help COMMAND                one command and its modifiers\n" +
           topics_text();
}

std::string help_text() {
    std::string text = "tonetool -- " TONETOOL_VERSION "\n\n" + usage_text() +
                       "  -h is shorter; --help COMMAND tells more about one.\n"
                       "\nSubjects:\n" +
                       topics_text();
    for_each_group(listed, [&](const std::string& title, const std::string& rows) {
        text += "\n" + title + ":\n" + rows;
    });
    return text + "\nExit status:\n" + indented(kExitStatusText);
}

std::string help_text(const Command& row) {
    const SortedModifiers modifiers = sorted_modifiers(row);
    const bool split = !modifiers.frequent.empty();
    return signature(row) + "\n    " + row.help + "\n" + images_text(row) +
           modifiers_text("modifiers used most", modifiers.frequent) +
           modifiers_text(split ? "other modifiers" : "modifiers", modifiers.others) +
           modifiers_text("parameters of single tone curves", modifiers.of_curves);
}

std::string help_text(const Topic& topic) {
    return OIIO::Strutil::replace(topic.text, "%\n", indented(kExitStatusText));
}

std::string indented(const std::string& lines) {
    return "  " + OIIO::Strutil::replace(lines.substr(0, lines.size() - 1), "\n", "\n  ", true) +
           "\n";
}

std::string help_about(const std::string& what) {
    const std::string name = what.substr(std::min(what.find_first_not_of('-'), size_t{2}));
    const Topic* topic = name == what ? find_topic(name) : nullptr;
    const Command* row = find_command(name);
    if (!topic && !row) {
        Strings names;
        for (const Topic& one : topics())
            names.push_back(one.name);
        throw CommandError("unknown command \"" + what + "\", " + suggest_command(name) +
                           " (subjects: " + join(names, ", ") + ")");
    }
    return (topic ? help_text(*topic) : "") + (topic && row ? "\n" : "") +
           (row ? help_text(*row) : "");
}

} // namespace tonetool::chain
