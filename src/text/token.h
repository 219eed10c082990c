// SPDX-License-Identifier: BSD-3-Clause
// One word of the command line, taken apart.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tonetool {

/// A file to read ("a.exr", "-") or a command with its modifiers ("--hdrflip:ppd=67").
struct Token {
    bool is_command = false;
    std::string text;               ///< as typed
    std::string name;               ///< of a command: without dashes and modifiers
    std::vector<std::string> value; ///< of "--help=man": its first argument
    std::vector<std::pair<std::string, std::string>> modifiers;
    std::vector<std::pair<size_t, size_t>> values; ///< where theirs begin in `text`, and end
    std::vector<std::string> dropped;              ///< what was malformed, if lenient
    std::string problem; ///< what is wrong first: empty, malformed or repeated modifiers

    /// As typed, but with another value of that modifier, in quotes where it needs them.
    std::string with_value(const std::string& key, const std::string& other) const;
    /// The same, and with that modifier behind the others where it is not there.
    std::string with_modifier(const std::string& key, const std::string& other) const;
};

/// One or two dashes are the same. A modifier is `key=value`; a value that begins with ' or "
/// goes on to the same quote and may hold colons. Empty, malformed and repeated modifiers are a
/// CommandError; if `lenient` they are left out, and Token::problem says it.
Token parse_token(const std::string& word, bool lenient = false);

} // namespace tonetool
