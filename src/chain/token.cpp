#include "chain/token.h"

#include <algorithm>

#include "chain/error.h"

namespace tonetool::chain {

namespace {

bool is_identifier(const std::string& key) {
    auto fits = [](unsigned char c) {
        return c == '_' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
               (c >= 'A' && c <= 'Z');
    };
    return !key.empty() && std::all_of(key.begin(), key.end(), fits) &&
           !(key[0] >= '0' && key[0] <= '9');
}

// The value that begins at `at`; moves `at` to the ':' behind it or to the end.
std::string take_value(const std::string& word, size_t& at) {
    char quote = at < word.size() ? word[at] : '\0';
    if (quote != '\'' && quote != '"') {
        size_t end = std::min(word.find(':', at), word.size());
        std::string value = word.substr(at, end - at);
        at = end;
        return value;
    }
    size_t close = word.find(quote, at + 1);
    if (close == std::string::npos) {
        throw CommandError("unfinished quotation in \"" + word.substr(at) + "\"");
    }
    std::string value = word.substr(at + 1, close - at - 1);
    at = close + 1;
    if (at < word.size() && word[at] != ':') {
        throw CommandError("text after the closing quote in \"" + word + "\"");
    }
    return value;
}

void take_modifier(Token& token, size_t& at) {
    const std::string& word = token.text;
    size_t colon = std::min(word.find(':', at), word.size());
    size_t equals = word.find('=', at);
    if (equals == std::string::npos || equals > colon) {
        std::string bad = word.substr(at, colon - at);
        throw CommandError(bad.empty() ? "empty modifier in \"" + word + "\""
                                       : "malformed modifier \"" + bad + "\", not key=value");
    }
    std::string key = word.substr(at, equals - at);
    if (!is_identifier(key)) {
        throw CommandError("malformed modifier \"" + word.substr(at, colon - at) +
                           "\", not key=value");
    }
    at = equals + 1;
    std::string value = take_value(word, at);
    if (value.empty()) {
        throw CommandError("modifier \"" + key + "\" has no value");
    }
    for (const auto& [known, unused] : token.modifiers) {
        if (known == key) {
            throw CommandError("modifier \"" + key + "\" is given twice");
        }
    }
    token.modifiers.emplace_back(key, value);
}

} // namespace

Token parse_token(const std::string& word) {
    Token token;
    token.text = word;
    if (word.size() < 2 || word[0] != '-') {
        return token;
    }
    token.is_command = true;
    size_t begin = word[1] == '-' ? 2 : 1;
    size_t at = std::min(word.find(':', begin), word.size());
    token.name = word.substr(begin, at - begin);
    while (at < word.size()) {
        ++at; // the ':'
        take_modifier(token, at);
    }
    return token;
}

} // namespace tonetool::chain
