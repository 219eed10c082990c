// SPDX-License-Identifier: BSD-3-Clause
#include "text/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <locale>
#include <sstream>

#include "text/printable.h"

namespace tonetool {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

size_t skip_digits(const std::string& text, size_t at) {
    while (at < text.size() && is_digit(text[at]))
        ++at;
    return at;
}

size_t skip_sign(const std::string& text, size_t at) {
    return at < text.size() && (text[at] == '-' || text[at] == '+') ? at + 1 : at;
}

// [sign] digits [. digits] [e [sign] digits], with a digit on at least one side of the point.
bool is_decimal(const std::string& text) {
    size_t begin = skip_sign(text, 0);
    size_t at = skip_digits(text, begin);
    size_t digits = at - begin;
    if (at < text.size() && text[at] == '.') {
        size_t end = skip_digits(text, at + 1);
        digits += end - (at + 1);
        at = end;
    }
    if (digits == 0)
        return false;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
        begin = skip_sign(text, at + 1);
        at = skip_digits(text, begin);
        return at > begin && at == text.size();
    }
    return at == text.size();
}

std::string printed(const char* format, double value) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

} // namespace

std::optional<double> parse_number(const std::string& text) {
    if (!is_decimal(text))
        return std::nullopt;
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    double value = 0;
    stream >> value;
    if (stream.fail() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::optional<int> parse_integer(const std::string& text) {
    size_t begin = skip_sign(text, 0);
    if (begin == text.size() || skip_digits(text, begin) != text.size())
        return std::nullopt;
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    int value = 0;
    stream >> value;
    return stream.fail() ? std::nullopt : std::optional<int>(value);
}

std::optional<uint64_t> parse_size(const std::string& text) {
    const std::string units = "KMG";
    size_t end = skip_digits(text, 0);
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
