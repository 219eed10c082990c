// What all JSON files of checks have in common: their first keys, their errors, their layout.
#pragma once

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "imagebuf/pixels/json_reading.h"
#include "text/printable.h"

namespace tonetool::sequence {

/// In one line; bytes that are no UTF-8 become U+FFFD (see valid_utf8). Nothing else makes text of
/// JSON here: dump() alone throws at such bytes, which names of files and layers may have.
inline std::string one_line(const nlohmann::ordered_json& value) {
    return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// The same with a line for each value.
inline std::string dumped(const nlohmann::ordered_json& value) {
    return printable_json(
               value.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) +
           "\n";
}

/// A runtime_error unless the object says that it is of this format and version.
void check_format(const nlohmann::ordered_json& from, const std::string& format, int version);

/// read(the parsed text); whatever is wrong with it is a runtime_error that says what and where.
template <class Read>
auto parsed(const std::string& text, const Read& read) {
    try {
        return read(parse_json<nlohmann::ordered_json>(text));
    } catch (const nlohmann::json::exception& problem) {
        throw std::runtime_error(reason_of(problem));
    }
}

/// Null where the text is no JSON.
inline nlohmann::ordered_json parsed_or_null(const std::string& text) {
    try {
        return parse_json<nlohmann::ordered_json>(text);
    } catch (const std::runtime_error&) {
        return nullptr;
    }
}

/// read(item) for each item of a list or object; an error in it says where, "frames/3: ...".
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
