// SPDX-License-Identifier: BSD-3-Clause
// The command line, taken apart once: which of its words are commands, files and arguments.
#pragma once

#include <string>
#include <vector>

#include "chain/language/registry.h"
#include "text/text.h"
#include "text/token.h"

namespace tonetool::chain {

/// A word that stands for itself, a command or a file, with the words that it takes.
struct Word {
    size_t at = 0;                   ///< its place on the command line
    Token token;                     ///< taken apart leniently: Token::problem says what is wrong
    const Command* row = nullptr;    ///< nullptr: a file, or no command has that name
    std::vector<size_t> arguments{}; ///< the places of the words that it takes
    std::string missing{};           ///< the argument that it needs and has not
    bool wildcards = true;           ///< no --wildcardoff holds

    bool is(const char* name) const { return row && row->names.front() == name; }
    /// The place behind its last argument.
    size_t end() const { return at + 1 + arguments.size(); }
    /// What the row calls the argument at arguments[index].
    const std::string& argument_name(size_t index) const {
        return row->args[token.value.size() + index];
    }
};

struct ParsedLine {
    Strings texts; ///< the words as they were typed, but "--frames=1-9" as "--frames", "1-9"
    std::vector<Word> words;
    bool compat = false; ///< --compat is one of the commands
};

ParsedLine parse_line(Strings texts);

/// The word at one place of a line, with `text` in its place. An argument that is the name of a
/// command was forgotten, not meant, unless `lenient`.
Word parse_word(const Strings& texts, size_t at, const std::string& text, bool lenient);

/// The line for messages and outputs, with the words of one of its runs; quoted as a shell wants
/// them unless `compat`.
std::string full_command_line(const ParsedLine& line, const Strings& texts, bool compat);

} // namespace tonetool::chain
