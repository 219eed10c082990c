// What all JSON files of checks have in common: their first keys, their errors, their layout.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace tonetool::sequence {

/// A line for each value; bytes that are no UTF-8 become U+FFFD.
inline std::string dumped(const nlohmann::ordered_json& value) {
    return value.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// A runtime_error unless the object says that it is of this format and version.
void check_format(const nlohmann::ordered_json& from, const std::string& format, int version);

/// read(the parsed text); whatever is wrong with it is a runtime_error that says what and where.
template <class Read>
auto parsed(const std::string& text, const Read& read) {
    try {
        return read(nlohmann::ordered_json::parse(text));
    } catch (const nlohmann::json::exception& problem) {
        const std::string what = problem.what(); // "[json.exception.type_error.302] type must ..."
        throw std::runtime_error(what.substr(std::min(what.size(), what.find("] ") + 2)));
    }
}

} // namespace tonetool::sequence
