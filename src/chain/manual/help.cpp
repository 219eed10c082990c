// SPDX-License-Identifier: BSD-3-Clause
#include "chain/manual/help.h"

#include <algorithm>

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
        names.push_back((name.size() == 1 ? "-" : "--") + name);
    std::string text = join(names, ", ");
    for (const std::string& argument : row.args)
        text += " " + argument;
    return text;
}

std::string images_text(const Command& row) {
    auto count = [](bool varies, int images) {
        return varies ? std::string("as many as asked for") : std::to_string(images);
    };
    return "    images popped: " + count(row.pops_of != nullptr, row.pops) +
           ", pushed: " + count(row.pushes_of != nullptr || row.pushes < 0, row.pushes) + "\n";
}

} // namespace

std::string usage_text() {
    return "Usage: tonetool [filename|command]...\n"
           "  A file name reads an image and pushes it on the stack; commands work on the stack,\n"
           "  from left to right. One or two dashes are the same. Modifiers follow a command's\n"
           "  name: --hdrflip:tonemapper=hable:fail=p99.9=0.3\n"
           "  Example: tonetool ref.exr test.exr --hdrflip -o error.exr --colormap magma "
           "-o error.png\n"
           "  Exit status: 0 passed, 1 an error, 2 only warnings (with --warnings-exit),\n"
           "  3 a fail threshold was exceeded.\n"
           "  --help lists the commands, --help COMMAND tells more about one.\n";
}

std::string help_text() {
    std::string text = "tonetool -- " TONETOOL_VERSION "\n\n" + usage_text();
    for (int group = 0; group < kGroupCount; ++group) {
        std::string rows;
        for (const Command& row : all_commands())
            if (row.group == static_cast<Group>(group))
                rows += "    " + padded(signature(row), 30) + row.help + "\n";
        if (!rows.empty())
            text += "\n" + group_title(static_cast<Group>(group)) + ":\n" + rows;
    }
    return text;
}

std::string help_text(const Command& row) {
    std::string text = signature(row) + "\n    " + row.help + "\n" + images_text(row);
    if (!row.modifiers.empty())
        text += "    modifiers:\n";
    for (const Modifier& modifier : row.modifiers)
        text += "      " + padded(modifier.key + "=" + modifier.hint, 34) + modifier.help + "\n";
    return text;
}

} // namespace tonetool::chain
