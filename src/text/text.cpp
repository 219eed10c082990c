// SPDX-License-Identifier: BSD-3-Clause
#include "text/text.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "text/printable.h"

namespace tonetool {

namespace {

std::string printed(const char* format, double value) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

} // namespace

std::optional<double> parse_number(const std::string& text) {
    // Else strtod would skip spaces and read "nan", "inf" and "0x10", too.
    if (text.empty() || text.find_first_not_of("0123456789.eE+-") != std::string::npos)
        return std::nullopt;
    char* end = nullptr;
    const double value = OIIO::Strutil::strtod(text.c_str(), &end);
    return *end == '\0' && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

std::optional<int> parse_integer(const std::string& text) {
    const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
    const char *begin = text.data() + (plus ? 1 : 0), *end = text.data() + text.size();
    int value = 0;
    const auto [at, problem] = std::from_chars(begin, end, value);
    return problem == std::errc() && at == end ? std::optional<int>(value) : std::nullopt;
}

std::optional<uint64_t> parse_size(const std::string& text) {
    const std::string units = "KMG";
    size_t end = std::min(text.find_first_not_of("0123456789"), text.size());
    size_t unit = end + 1 == text.size() ? units.find(text[end]) : std::string::npos;
    if (end == 0 || end > 18 || (end < text.size() && unit == std::string::npos))
        return std::nullopt;
    int shift = end < text.size() ? 10 * (static_cast<int>(unit) + 1) : 0;
    uint64_t value = std::stoull(text.substr(0, end));
    if (value == 0 || value > (UINT64_MAX >> 1 >> shift))
        return std::nullopt;
    return value << shift;
}

std::string format_number(double value) {
    return printed("%.6g", value);
}

std::string format_apart(double value, double other) {
    const char* const formats[] = {"%.6g", "%.9g", "%.17g"};
    for (const char* format : formats)
        if (printed(format, value) != printed(format, other))
            return printed(format, value);
    return printed(formats[0], value);
}

Strings split(const std::string& text, char separator) {
    Strings words;
    std::string word;
    std::istringstream stream(text + separator);
    while (std::getline(stream, word, separator))
        words.push_back(word);
    return words;
}

std::string join(const Strings& words, const std::string& separator) {
    std::string all;
    for (const std::string& word : words)
        all += (all.empty() ? "" : separator) + word;
    return all;
}

std::string shell_quoted(const std::string& argument) {
    const char* const plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                              "-_=+:,./%@#";
    if (!argument.empty() && argument.find_first_not_of(plain) == std::string::npos)
        return argument;
    const auto controls = [](char c) { return (c >= 0 && c < ' ') || c == 127; };
    if (std::any_of(argument.begin(), argument.end(), controls)) {
        std::string escaped = "$'";
        for (char c : argument) {
            escaped += controls(c) ? printable(std::string(1, c))
                                   : (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c);
        }
        return escaped + "'";
    }
    std::string quoted = "'";
    for (char c : argument)
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

} // namespace tonetool
