// SPDX-License-Identifier: BSD-3-Clause
// Everything that the JSON files of checks have in common: their first keys, their errors, their
// layout.
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "imagebuf/pixels/json_reading.h"
#include "text/printable.h"

namespace tonetool::sequence {

/// JSON in one line; invalid UTF-8 becomes U+FFFD (see valid_utf8). No other function here turns
/// JSON into text: plain dump() throws at invalid UTF-8, which names of files and layers may
/// contain.
inline std::string one_line(const nlohmann::ordered_json& value) {
    return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// The same with each value on its own line.
inline std::string dumped(const nlohmann::ordered_json& value) {
    return printable_json(
               value.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) +
           "\n";
}

/// Throws a runtime_error unless the object has this format and version.
void check_format(const nlohmann::ordered_json& from, const std::string& format, int version);

/// Calls read(the parsed text); any error in it becomes a runtime_error that says what and where.
template <class Read>
auto parsed(const std::string& text, const Read& read) {
    try {
        return read(parse_json<nlohmann::ordered_json>(text));
    } catch (const nlohmann::json::exception& problem) {
        throw std::runtime_error(reason_of(problem));
    }
}

/// Null if the text is not JSON.
inline nlohmann::ordered_json parsed_or_null(const std::string& text) {
    try {
        return parse_json<nlohmann::ordered_json>(text);
    } catch (const std::runtime_error&) {
        return nullptr;
    }
}

/// Calls read(item) for each item of a list or object; an error says where it is: "frames/3: ...".
template <class Read>
void each_of(const nlohmann::ordered_json& list, const std::string& key, const Read& read) {
    if (!list.is_array() && !list.is_object())
        throw std::runtime_error("\"" + key + "\" is " + shown_json(list) + ", not a list");
    for (const auto& item : list.items()) {
        try {
            read(item.value(), item.key());
        } catch (const nlohmann::json::exception& problem) {
            throw std::runtime_error(key + "/" + item.key() + ": " + reason_of(problem));
        } catch (const std::runtime_error& problem) {
            throw std::runtime_error(key + "/" + item.key() + ": " + problem.what());
        }
    }
}

} // namespace tonetool::sequence
