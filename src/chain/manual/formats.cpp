// SPDX-License-Identifier: BSD-3-Clause
// The registry of commands for other programs: which formats there are, and JSON.
#include <nlohmann/json.hpp>

#include "chain/manual/help.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

std::string json_text() {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const Command& row : all_commands()) {
        nlohmann::ordered_json modifiers = nlohmann::ordered_json::array();
        for (const Modifier& modifier : row.modifiers) {
            modifiers.push_back(
                {{"key", modifier.key}, {"hint", modifier.hint}, {"help", modifier.help}});
        }
        all.push_back({{"names", row.names},
                       {"args", row.args},
                       {"pops", row.takes_all ? kAnyNumber : row.pops},
                       {"pushes", row.pushes},
                       {"group", group_title(row.group)},
                       {"help", row.help},
                       {"modifiers", modifiers}});
    }
    return all.dump(1) + "\n";
}

struct Format {
    const char* name;
    std::string (*text)();
};
const Format kFormats[] = {{"man", man_page},
                           {"bash", bash_completion},
                           {"zsh", zsh_completion},
                           {"fish", fish_completion},
                           {"json", json_text}};

} // namespace

bool is_registry_format(const std::string& format) {
    for (const Format& known : kFormats)
        if (format == known.name)
            return true;
    return false;
}

std::string registry_text(const std::string& format) {
    Strings names;
    for (const Format& known : kFormats) {
        if (format == known.name)
            return known.text();
        names.emplace_back(known.name);
    }
    throw CommandError("unknown format \"" + format + "\" (valid: " + join(names, ", ") + ")");
}

} // namespace tonetool::chain
