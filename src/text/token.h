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
    std::vector<std::string> dropped; ///< what was malformed, if lenient
};

/// One or two dashes are the same. A modifier is `key=value`; a value that begins with ' or "
/// goes on to the same quote and may hold colons. Empty, malformed and repeated modifiers are a
/// CommandError, or left out if `lenient`.
Token parse_token(const std::string& word, bool lenient = false);

} // namespace tonetool
