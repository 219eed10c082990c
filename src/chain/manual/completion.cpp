// SPDX-License-Identifier: BSD-3-Clause
// Completion for bash, zsh and fish: commands, behind a ':' their modifiers, behind a '=' the
// values of a modifier that has a few.
#include <algorithm>
#include <cctype>

#include "chain/manual/help.h"

namespace tonetool::chain {

namespace {

std::string with_before(std::string text, const std::string& characters,
                        const std::string& before) {
    for (size_t at = 0; (at = text.find_first_of(characters, at)) != std::string::npos;) {
        text.insert(at, before);
        at += before.size() + 1;
    }
    return text;
}

// A ' inside '...'.
std::string quoted_inside(const std::string& text) {
    return with_before(text, "'", "'\\'");
}

bool is_value(const std::string& word) {
    return !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
        return std::islower(c) || std::isdigit(c) || c == '-' || c == '.' || c == '_';
    });
}

// Of "frame|shot|FILE" frame and shot; names of curves stand in the help, behind the last ": ".
Strings values_of(const Modifier& modifier) {
    Strings values;
    Strings words = split(modifier.hint, '|');
    const size_t list = modifier.help.rfind(": ");
    const bool named = modifier.hint == "NAME" || modifier.hint == kCurveHint;
    if (named && list != std::string::npos) {
        words.clear();
        for (const std::string& word : split(modifier.help.substr(list + 2), ','))
            words.push_back(word.substr(word.find_first_not_of(' ')));
    }
    std::copy_if(words.begin(), words.end(), std::back_inserter(values), is_value);
    return values;
}

// Visits each name of each command, as it is typed.
template <class Visit>
void for_each_name(const Visit& visit) {
    for (const Command& row : all_commands())
        for (const std::string& name : row.names)
            visit(dashed(name), row);
}

// Visits each name of each command that has modifiers, with all of them in the order of help.
template <class Visit>
void with_modifiers(const Visit& visit) {
    for_each_name([&](const std::string& name, const Command& row) {
        const SortedModifiers sorted = sorted_modifiers(row);
        if (!row.modifiers.empty())
            visit(name, concatenated({sorted.frequent, sorted.others, sorted.of_curves}));
    });
}

// Visits each modifier that has values to choose from: "--hdrflip", "alpha", its values.
template <class Visit>
void with_values(const Visit& visit) {
    with_modifiers([&](const std::string& name, const Modifiers& modifiers) {
        for (const Modifier& modifier : modifiers) {
            const Strings values = values_of(modifier);
            if (!values.empty())
                visit(name, modifier.key, values);
        }
    });
}

// A line of bash's and zsh's "case" for each of them: "--hdrflip:alpha=) SET(ignore error) ;;".
std::string value_cases(const std::string& set, const std::string& end) {
    std::string cases;
    with_values([&](const std::string& name, const std::string& key, const Strings& values) {
        cases += "        " + name + ":" + key + "=) " + set + join(values, " ") + end + " ;;\n";
    });
    return cases;
}

} // namespace

std::string bash_completion() {
    std::string names, cases;
    for_each_name([&](const std::string& name, const Command&) { names += " " + name; });
    with_modifiers([&](const std::string& name, const Modifiers& modifiers) {
        Strings keys;
        for (const Modifier& one : modifiers)
            keys.push_back(one.key + "=");
        cases += "        " + name + ") found=\"" + join(keys, " ") + "\" ;;\n";
    });
    return "_tonetool() {\n"
           "    local line=\"${COMP_LINE:0:COMP_POINT}\" found=\n"
           "    local word=\"${line##* }\"\n"
           "    local last=\"${word##*:}\" command=\"${word%%:*}\"\n"
           "    if [[ $word != -* ]]; then\n"
           "        COMPREPLY=( $(compgen -f -- \"$word\") )\n        return\n    fi\n"
           "    if [[ $word != *:* ]]; then\n"
           "        COMPREPLY=( $(compgen -W \"" +
           names.substr(1) +
           "\" -- \"$word\") )\n        return\n    fi\n"
           "    # What the shell takes for the begin of the word is not repeated.\n"
           "    local before=\"${word%:*}:\"\n"
           "    [[ $COMP_WORDBREAKS == *:* ]] && before=\n"
           "    if [[ $last == *=* ]]; then\n"
           "        case \"$command:${last%%=*}=\" in\n" +
           value_cases("found=\"", "\"") +
           "        esac\n"
           "        before=\"$before${last%%=*}=\"\n"
           "        [[ $COMP_WORDBREAKS == *=* ]] && before=\n"
           "        last=\"${last#*=}\"\n"
           "    else\n"
           "        case \"$command\" in\n" +
           cases +
           "        esac\n"
           "    fi\n"
           "    compopt -o nospace\n"
           "    COMPREPLY=( $(compgen -P \"$before\" -W \"$found\" -- \"$last\") )\n"
           "}\ncomplete -o filenames -F _tonetool tonetool\n";
}

std::string zsh_completion() {
    std::string commands, cases;
    for_each_name([&](const std::string& name, const Command& row) {
        commands += "    '" + name + ":" + quoted_inside(row.help) + "'\n";
    });
    with_modifiers([&](const std::string& name, const Modifiers& modifiers) {
        std::string keys;
        for (const Modifier& one : modifiers)
            keys += " '" + one.key + "=:" + quoted_inside(one.help) + "'";
        cases += "    " + name + ") modifiers=(" + keys + " ) ;;\n";
    });
    return "#compdef tonetool\n"
           "local -a commands modifiers choices\nlocal word=$words[CURRENT]\n"
           "if [[ $word == -*:*=* && ${word##*:} == *=* ]]; then\n"
           "    local last=${word##*:}\n"
           "    case ${word%%:*}:${last%%=*}= in\n" +
           value_cases("choices=(", ")") +
           "    esac\n"
           "    compset -P '*='\n    _describe -t values value choices -S ''\n    return\nfi\n"
           "if [[ $word == -*:* ]]; then\n"
           "    case ${word%%:*} in\n" +
           cases +
           "    esac\n"
           "    compset -P '*:'\n    _describe -t modifiers modifier modifiers "
           "-S ''\n    return\nfi\ncommands=(\n" +
           commands +
           ")\nif [[ $word == -* ]]; then\n    _describe -t commands command commands\n"
           "else\n    _files\nfi\n";
}

// fish takes "word<TAB>description" lines of a function.
std::string fish_completion() {
    const auto fish = [](const std::string& text) {
        return "'" + with_before(text, "'\\", "\\") + "'";
    };
    std::string commands, keys, values;
    for_each_name([&](const std::string& name, const Command& row) {
        commands += " \\\n                " + fish(name) + " " + fish(row.help);
    });
    with_modifiers([&](const std::string& name, const Modifiers& modifiers) {
        keys += "                    case " + fish(name) + "\n                        set found";
        for (const Modifier& one : modifiers)
            keys += " \\\n                            \"$before\"" + fish(one.key + "=") + " " +
                    fish(one.help);
        keys += "\n";
    });
    with_values([&](const std::string& name, const std::string& key, const Strings& words) {
        values += "                    case " + fish(name + ":" + key) +
                  "\n                        set found \"$before\"" + key + "=" +
                  join(words, " \"$before\"" + key + "=") + "\n";
    });
    return "function __tonetool_words\n"
           "    set -l word (commandline -ct)\n"
           "    switch $word\n"
           "        case '-*:*'\n"
           "            set -l command (string replace -r ':.*' '' -- $word)\n"
           "            set -l before (string replace -r '[^:]*$' '' -- $word)\n"
           "            set -l last (string replace -r '.*:' '' -- $word)\n"
           "            set -l found\n"
           "            if string match -q '*=*' -- $last\n"
           "                switch $command:(string replace -r '=.*' '' -- $last)\n" +
           values +
           "                end\n"
           "                printf '%s\\n' $found\n"
           "            else\n"
           "                switch $command\n" +
           keys +
           "                end\n"
           "                printf '%s\\t%s\\n' $found\n"
           "            end\n"
           "        case '*'\n"
           "            printf '%s\\t%s\\n'" +
           commands +
           "\n    end\nend\n"
           "complete -c tonetool -f -n 'string match -q -- \"-*\" (commandline -ct)' "
           "-a '(__tonetool_words)'\n"
           "complete -c tonetool -F -n 'not string match -q -- \"-*\" (commandline -ct)'\n";
}

} // namespace tonetool::chain
