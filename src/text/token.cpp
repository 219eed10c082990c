// SPDX-License-Identifier: BSD-3-Clause
#include "text/token.h"

#include <algorithm>

#include "text/error.h"

namespace tonetool {

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
    if (close == std::string::npos)
        throw CommandError("unfinished quotation in \"" + word.substr(at) + "\"");
    std::string value = word.substr(at + 1, close - at - 1);
    at = close + 1;
    if (at < word.size() && word[at] != ':')
        throw CommandError("text after the closing quote in \"" + word + "\"");
    return value;
}

void take_modifier(Token& token, size_t& at) {
    const std::string& word = token.text;
    size_t colon = std::min(word.find(':', at), word.size());
    const std::string text = word.substr(at, colon - at);
    const std::string key = text.substr(0, text.find('='));
    if (text.empty())
        throw CommandError("empty modifier in \"" + word + "\"");
    if (key.size() == text.size() || !is_identifier(key))
        throw CommandError("malformed modifier \"" + text + "\", not key=value");
    at += key.size() + 1;
    const size_t begin = at;
    std::string value = take_value(word, at);
    if (value.empty())
        throw CommandError("modifier \"" + key + "\" has no value");
    for (auto& [known, given] : token.modifiers) {
        if (known == key && token.problem.empty())
            token.problem = "modifier \"" + key + "\" is given twice";
        given = known == key ? value : given;
    }
    token.modifiers.emplace_back(key, value);
    token.values.emplace_back(begin, at);
}

} // namespace

Token parse_token(const std::string& word, bool lenient) {
    Token token;
    token.text = word;
    if (word.size() < 2 || word[0] != '-')
        return token;
    token.is_command = true;
    size_t begin = word[1] == '-' ? 2 : 1;
    size_t at = std::min(word.find(':', begin), word.size());
    token.name = word.substr(begin, at - begin);
    if (size_t equals = token.name.find('='); equals != std::string::npos) {
        token.value.push_back(token.name.substr(equals + 1));
        token.name.erase(equals);
    }
    while (at < word.size()) {
        size_t begins = ++at; // behind the ':'
        try {
            take_modifier(token, at);
        } catch (const CommandError& problem) {
            token.problem = token.problem.empty() ? problem.what() : token.problem;
            at = std::min(word.find(':', begins), word.size());
            if (at > begins)
                token.dropped.push_back(word.substr(begins, at - begins));
        }
    }
    if (!lenient && !token.problem.empty())
        throw CommandError(token.problem);
    return token;
}

namespace {

std::string quoted_value(const std::string& value) {
    if (value.find_first_of(":'\"") == std::string::npos)
        return value;
    const char quote = value.find('\'') == std::string::npos ? '\'' : '"';
    return quote + value + quote;
}

} // namespace

std::string Token::with_value(const std::string& key, const std::string& other) const {
    std::string word = text;
    for (size_t i = modifiers.size(); i-- > 0;)
        if (modifiers[i].first == key)
            word.replace(values[i].first, values[i].second - values[i].first, quoted_value(other));
    return word;
}

std::string Token::with_modifier(const std::string& key, const std::string& other) const {
    const bool there = std::any_of(modifiers.begin(), modifiers.end(),
                                   [&](const auto& one) { return one.first == key; });
    return there ? with_value(key, other) : text + ":" + key + "=" + quoted_value(other);
}

} // namespace tonetool
