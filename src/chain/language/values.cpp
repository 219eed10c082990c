// SPDX-License-Identifier: BSD-3-Clause
#include "chain/language/values.h"

#include <algorithm>

#include "imagebuf/pixels/names.h"
#include "text/error.h"

namespace tonetool {

namespace {

std::string range_text(Range range) {
    return format_number(range.low) + " to " + format_number(range.high);
}

} // namespace

std::string meant(const std::string& word, const Strings& names) {
    Strings near = nearest_names(word, names, 1);
    return near.empty() ? "" : ", did you mean \"" + near.front() + "\"?";
}

double checked_number(const std::string& what, const std::string& value, Range range) {
    std::optional<double> number = parse_number(value);
    if (!number) {
        throw CommandError(what + " \"" + value +
                           "\" is not a number (valid: " + range_text(range) + ")");
    }
    if (*number < range.low || *number > range.high) {
        const bool percent = *number >= 2 && *number <= 100 && range.high <= 1;
        throw CommandError(what + " " + value + " is out of range (valid: " + range_text(range) +
                           (percent ? ", a part of 1: 10 % is 0.1)" : ")"));
    }
    return *number;
}

double checked_fraction(const std::string& what, const std::string& value, Range range) {
    const size_t slash = value.find('/');
    const auto over = parse_number(value.substr(0, slash));
    const auto under = parse_number(slash == std::string::npos ? "" : value.substr(slash + 1));
    if (!over || !under || *under == 0)
        return checked_number(what, value, range);
    checked_number(what, format_number(*over / *under), range);
    return *over / *under;
}

int checked_integer(const std::string& what, const std::string& value, Range range) {
    std::optional<int> number = parse_integer(value);
    if (!number) {
        throw CommandError(what + " \"" + value +
                           "\" is not a whole number (valid: " + range_text(range) + ")");
    }
    checked_number(what, value, range);
    return *number;
}

void check_choice(const std::string& what, const std::string& value, const Strings& valid) {
    if (std::find(valid.begin(), valid.end(), value) == valid.end()) {
        throw CommandError("unknown " + what + " \"" + value + "\"" + meant(value, valid) +
                           " (valid: " + join(valid, ", ") + ")");
    }
}

std::string with_number(const std::string& pattern, int number) {
    size_t percent = pattern.find('%');
    size_t end = percent == std::string::npos
                     ? percent
                     : pattern.find_first_not_of("0123456789", percent + 1);
    bool valid = end != std::string::npos && pattern[end] == 'd' && end - percent < 4 &&
                 pattern.find('%', end) == std::string::npos;
    if (!valid) {
        throw CommandError("all= needs one %d in the file name (\"" + pattern +
                           "\"; valid: out.%d.exr, out.%04d.exr)");
    }
    std::string width = pattern.substr(percent + 1, end - percent - 1);
    std::string digits = std::to_string(number);
    size_t wanted = width.empty() ? 0 : std::stoul(width);
    char pad = !width.empty() && width[0] == '0' ? '0' : ' ';
    digits.insert(0, wanted > digits.size() ? wanted - digits.size() : 0, pad);
    return pattern.substr(0, percent) + digits + pattern.substr(end + 1);
}

} // namespace tonetool
