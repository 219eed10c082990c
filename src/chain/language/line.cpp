// SPDX-License-Identifier: BSD-3-Clause
#include "chain/language/line.h"

#include <algorithm>

namespace tonetool::chain {

namespace {

bool has_dash(const std::string& text) {
    return text.size() > 1 && text[0] == '-';
}

// "[X]" is left out at the end of the line, "[N]" also before anything but a whole number, and
// oiiotool leaves out either before a dash.
bool is_left_out(const std::string& argument, const Strings& texts, size_t at, bool lenient) {
    return argument.front() == '[' &&
           (at >= texts.size() || (argument == "[N]" && !parse_integer(texts[at])) ||
            (lenient && texts[at][0] == '-'));
}

// "--attrib note --compat" and "--echo --frames=1" are texts; a file of results or a range of
// frames is not called so.
bool is_command_instead(const Command& row, const std::string& text) {
    const Token token = parse_token(has_dash(text) ? text : "", true);
    const bool may_be_text = token.name == "compat" || !token.value.empty();
    return (row.whole_line || !may_be_text) && find_command(token.name) != nullptr;
}

void take_arguments(Word& word, const Strings& texts, bool lenient) {
    const Command& row = *word.row;
    const bool strict = !lenient || row.own || row.whole_line;
    for (size_t i = word.token.value.size(); i < row.args.size(); ++i) {
        const std::string& name = row.args[i];
        const size_t next = word.end();
        if (name.front() == '=' || is_left_out(name, texts, next, lenient))
            return;
        const bool forgotten = strict && name.front() != '[';
        if (next >= texts.size() || (forgotten && is_command_instead(row, texts[next]))) {
            word.missing = name;
            return;
        }
        word.arguments.push_back(next);
    }
}

// "--frames=1-9" at that place as two words.
void part_value(Strings& texts, const Word& word) {
    const size_t equals = word.token.text.find('=');
    texts[word.at] = word.token.text.substr(0, equals);
    texts.insert(texts.begin() + std::ptrdiff_t(word.at) + 1, word.token.text.substr(equals + 1));
}

bool takes_value_apart(const Word& word) {
    return word.row && word.row->whole_line && !word.token.value.empty() &&
           !word.row->args.empty() && word.row->args[0].front() != '=';
}

ParsedLine parsed(Strings texts, bool lenient) {
    ParsedLine line{std::move(texts), {}, false};
    bool wildcards = true;
    for (size_t at = 0; at < line.texts.size(); at = line.words.back().end()) {
        Word word = parse_word(line.texts, at, line.texts[at], lenient);
        if (takes_value_apart(word)) {
            part_value(line.texts, word);
            word = parse_word(line.texts, at, line.texts[at], lenient);
        }
        wildcards = word.is("wildcardon") || (wildcards && !word.is("wildcardoff"));
        word.wildcards = wildcards;
        line.compat |=
            word.is("compat") && word.token.text.find_first_of("=:") == std::string::npos;
        line.words.push_back(std::move(word));
    }
    return line;
}

} // namespace

Word parse_word(const Strings& texts, size_t at, const std::string& text, bool lenient) {
    Word word{at, parse_token(text, true)};
    if (word.token.is_command)
        word.row = find_command(word.token.name);
    if (word.row)
        take_arguments(word, texts, lenient);
    return word;
}

ParsedLine parse_line(Strings texts) {
    ParsedLine line = parsed(std::move(texts), false);
    if (line.compat) {
        line = parsed(std::move(line.texts), true);
        line.compat = true;
    }
    return line;
}

std::string full_command_line(const ParsedLine& line, const Strings& texts, bool compat) {
    const auto& words = line.words;
    const bool sans = std::any_of(words.begin(), words.end(),
                                  [](const Word& word) { return word.is("sansattrib"); });
    std::string text = "tonetool";
    for (const Word& word : words) {
        if (sans && (word.is("sansattrib") || word.is("attrib") || word.is("sattrib")))
            continue;
        for (size_t at = word.at; at < word.end(); ++at) {
            const bool spaces = texts[at].find_first_of(" \t\n") != std::string::npos;
            text += " " + (!compat  ? shell_quoted(texts[at])
                           : spaces ? '"' + texts[at] + '"'
                                    : texts[at]);
        }
    }
    return text;
}

} // namespace tonetool::chain
