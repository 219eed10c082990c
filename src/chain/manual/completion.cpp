// SPDX-License-Identifier: BSD-3-Clause
// The registry of commands for other programs: the man page, shell completion, JSON.
#include <nlohmann/json.hpp>

#include "chain/manual/help.h"
#include "text/error.h"
#include "tonetool/export.h"

namespace tonetool::chain {

namespace {

std::string dashed(const std::string& name) {
    return (name.size() == 1 ? "-" : "--") + name;
}

std::string replaced(std::string text, const std::string& characters, const std::string& before) {
    for (size_t at = 0; (at = text.find_first_of(characters, at)) != std::string::npos;) {
        text.insert(at, before);
        at += before.size() + 1;
    }
    return text;
}

std::string troff(const std::string& text) {
    std::string safe = replaced(text, "\\-", "\\");
    return !safe.empty() && (safe[0] == '.' || safe[0] == '\'') ? "\\&" + safe : safe;
}

template <class Visit>
void for_each_group(const Visit& visit) {
    for (int group = 0; group < kGroupCount; ++group) {
        std::vector<const Command*> rows;
        for (const Command& row : all_commands())
            if (row.group == static_cast<Group>(group))
                rows.push_back(&row);
        if (!rows.empty())
            visit(group_title(static_cast<Group>(group)), rows);
    }
}

std::string man_page() {
    std::string text = ".TH TONETOOL 1 \"\" \"tonetool " TONETOOL_VERSION "\"\n.SH NAME\n"
                       "tonetool \\- compare and tone map HDR images\n.SH SYNOPSIS\n"
                       ".B tonetool\n[filename|command]...\n.SH DESCRIPTION\n.nf\n" +
                       troff(usage_text()) + ".fi\n";
    for_each_group([&](const std::string& title, const std::vector<const Command*>& rows) {
        text += ".SH " + troff(title) + "\n";
        for (const Command* row : rows) {
            Strings names;
            for (const std::string& name : row->names) {
                names.push_back("\\fB" + troff(dashed(name)) + "\\fR");
            }
            text += ".TP\n" + join(names, ", ") + " " + troff(join(row->args, " ")) + "\n" +
                    troff(row->help) + "\n";
            for (const Modifier& modifier : row->modifiers) {
                text += ".br\n\\fI:" + troff(modifier.key + "=" + modifier.hint) + "\\fR  " +
                        troff(modifier.help) + "\n";
            }
        }
    });
    return text;
}

// Names first; behind a ':' the command's modifiers.
std::string bash_completion() {
    std::string names, cases;
    for (const Command& row : all_commands()) {
        Strings keys;
        for (const Modifier& modifier : row.modifiers)
            keys.push_back(modifier.key + "=");
        for (const std::string& name : row.names) {
            names += " " + dashed(name);
            cases += keys.empty()
                         ? ""
                         : "        " + dashed(name) + ") keys=\"" + join(keys, " ") + "\" ;;\n";
        }
    }
    return "_tonetool() {\n"
           "    local word=\"${COMP_LINE:0:COMP_POINT}\" keys=\n"
           "    word=\"${word##* }\"\n"
           "    local prefix=\"${word%:*}:\"\n"
           "    if [[ $word != -* ]]; then\n"
           "        COMPREPLY=( $(compgen -f -- \"$word\") )\n        return\n    fi\n"
           "    if [[ $word != *:* ]]; then\n"
           "        COMPREPLY=( $(compgen -W \"" +
           names.substr(1) +
           "\" -- \"$word\") )\n        return\n    fi\n"
           "    case \"${word%%:*}\" in\n" +
           cases +
           "    esac\n"
           "    compopt -o nospace\n"
           "    [[ $COMP_WORDBREAKS == *:* ]] && prefix=\n"
           "    COMPREPLY=( $(compgen -P \"$prefix\" -W \"$keys\" -- \"${word##*:}\") )\n"
           "}\ncomplete -o filenames -F _tonetool tonetool\n";
}

std::string zsh_completion() {
    std::string text = "#compdef tonetool\nlocal -a commands modifiers\n"
                       "if [[ $words[CURRENT] == -*:* ]]; then\n"
                       "    case ${words[CURRENT]%%:*} in\n";
    std::string commands;
    for (const Command& row : all_commands()) {
        for (const std::string& name : row.names) {
            commands += "    '" + dashed(name) + ":" + replaced(row.help, "'", "'\\'") + "'\n";
            std::string keys;
            for (const Modifier& modifier : row.modifiers)
                keys += " '" + modifier.key + "=:" + replaced(modifier.help, "'", "'\\'") + "'";
            text += keys.empty() ? "" : "    " + dashed(name) + ") modifiers=(" + keys + " ) ;;\n";
        }
    }
    return text +
           "    esac\n    compset -P '*:'\n    _describe -t modifiers modifier modifiers "
           "-S ''\n    return\nfi\ncommands=(\n" +
           commands +
           ")\nif [[ $words[CURRENT] == -* ]]; then\n    _describe -t commands command commands\n"
           "else\n    _files\nfi\n";
}

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
                       {"pops", row.pops},
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
const Format kFormats[] = {
    {"man", man_page}, {"bash", bash_completion}, {"zsh", zsh_completion}, {"json", json_text}};

} // namespace

bool is_registry_format(const std::string& format) {
    for (const Format& known : kFormats)
        if (format == known.name)
            return true;
    return false;
}

std::string registry_text(const std::string& format) {
    for (const Format& known : kFormats)
        if (format == known.name)
            return known.text();
    throw CommandError("unknown format \"" + format + "\" (valid: man, bash, zsh, json)");
}

} // namespace tonetool::chain
