// SPDX-License-Identifier: BSD-3-Clause
// JSON texts as files have them: bounded in depth, and numbers that fit where they go. Header only:
// the checks of sequences read with it, too, which see no symbol of the library but the installed
// ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace tonetool {

/// Lists and objects that may be within one another: the library below goes down into each of them
/// by a call, and a text of brackets would exhaust the stack.
inline constexpr int kMostNestedJson = 100;

inline int depth_of_json(const std::string& text) {
    int depth = 0, most = 0;
    for (size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"')
            for (++at; at < text.size() && text[at] != '"'; ++at)
                at += text[at] == '\\' ? 1 : 0;
        else if (c == '[' || c == '{')
            most = std::max(most, ++depth);
        else if (c == ']' || c == '}')
            --depth;
    }
    return most;
}

/// "[json.exception.type_error.302] type must be ..." without its first word.
inline std::string reason_of(const nlohmann::json::exception& problem) {
    const std::string what = problem.what();
    const size_t end = what.find("] ");
    return end == std::string::npos ? what : what.substr(end + 2);
}

/// Every JSON text that a file or a caller gave is read here. A runtime_error says what is wrong
/// with it and where.
template <class Json>
Json parse_json(const std::string& text) {
    if (depth_of_json(text) > kMostNestedJson)
        throw std::runtime_error("lists and objects are nested deeper than " +
                                 std::to_string(kMostNestedJson) + ", the most that they may be");
    try {
        return Json::parse(text);
    } catch (const nlohmann::json::exception& problem) {
        throw std::runtime_error(reason_of(problem));
    }
}

/// A value for a message: what is long is cut off.
template <class Json>
std::string shown_json(const Json& value) {
    constexpr size_t most = 60;
    const std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() > most ? text.substr(0, most) + "..." : text;
}

/// A whole number that `Int` holds; a runtime_error names `key` and the value. (The library below
/// takes 1e99 and 2^40 for whatever their conversion leaves.)
template <class Int, class Json>
Int whole_number(const Json& from, const std::string& key) {
    using Limits = std::numeric_limits<Int>;
    if (from.is_number_unsigned()) {
        const auto value = from.template get<unsigned long long>();
        if (value <= static_cast<unsigned long long>(Limits::max()))
            return static_cast<Int>(value);
    } else if (from.is_number_integer()) {
        const auto value = from.template get<long long>();
        const auto kept = static_cast<Int>(value);
        if (Limits::is_signed && value < 0 && static_cast<long long>(kept) == value)
            return kept;
    }
    throw std::runtime_error("\"" + key + "\" is " + shown_json(from) +
                             ", not a whole number from " + std::to_string(Limits::min()) + " to " +
                             std::to_string(Limits::max()));
}

/// A finite number; a runtime_error names `key` and the value.
template <class Json>
double finite_number(const Json& from, const std::string& key) {
    if (from.is_number()) {
        const auto value = from.template get<double>();
        if (std::isfinite(value))
            return value;
    }
    throw std::runtime_error("\"" + key + "\" is " + shown_json(from) + ", not a number");
}

} // namespace tonetool
