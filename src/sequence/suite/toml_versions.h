// SPDX-License-Identifier: BSD-3-Clause
// What toml11 calls otherwise in its versions 3 and 4.
#pragma once

#include <cstddef>
#include <istream>
#include <map>
#include <string>
#include <toml.hpp>
#include <vector>

#ifndef TOML11_VERSION_MAJOR // before 3.8
#define TOML11_VERSION_MAJOR 3
#endif

namespace tonetool::sequence {

#if TOML11_VERSION_MAJOR >= 4

using TomlValue = toml::value;

inline TomlValue parse_toml(std::istream& from, const std::string& file) {
    return toml::parse(from, file);
}
inline std::string toml_message(const std::string& what, const TomlValue& at,
                                const std::string& comment) {
    return toml::format_error(what, at.location(), comment);
}
inline size_t toml_line(const TomlValue& value) {
    return value.location().first_line_number();
}
inline const std::string& toml_text(const TomlValue& value) {
    return value.as_string();
}

#else

using TomlValue = toml::basic_value<toml::discard_comments, std::map, std::vector>;

inline TomlValue parse_toml(std::istream& from, const std::string& file) {
    return toml::parse<toml::discard_comments, std::map, std::vector>(from, file);
}
inline std::string toml_message(const std::string& what, const TomlValue& at,
                                const std::string& comment) {
    return toml::format_error(what, at, comment);
}
inline size_t toml_line(const TomlValue& value) {
    return value.location().line();
}
inline const std::string& toml_text(const TomlValue& value) {
    return value.as_string().str;
}

#endif

} // namespace tonetool::sequence
