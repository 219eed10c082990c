// SPDX-License-Identifier: BSD-3-Clause
// Strict numbers and other small pure pieces of text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tonetool {

using Strings = std::vector<std::string>;

/// The whole text as a finite decimal number ("1e-3", "-2", ".5"); nullopt for anything else
/// (empty, spaces, "0,05", "5%", "nan", "0x10", beyond double).
std::optional<double> parse_number(const std::string& text);

/// The whole text as an int; nullopt for anything else.
std::optional<int> parse_integer(const std::string& text);

/// The whole text as a number of bytes above 0: digits, then nothing or K, M, G (powers of 1024);
/// nullopt for anything else.
std::optional<uint64_t> parse_size(const std::string& text);

/// Six significant digits.
std::string format_number(double value);

/// As format_number, with as many more digits as it takes to tell `value` from `other`.
std::string format_apart(double value, double other);

Strings split(const std::string& text, char separator);
std::string join(const Strings& words, const std::string& separator);

/// Lines of "label: name value".
struct Lines {
    explicit Lines(std::string name) : label(std::move(name)) {}
    std::string label, text;

    void add(const std::string& name, const std::string& value) {
        text += (text.empty() ? "" : "\n") + label + ": " + name + " " + value;
    }
    void add(const std::string& name, double value) { add(name, format_number(value)); }
    void add_positive(const std::string& name, double value) {
        if (value > 0)
            add(name, value);
    }
    void add(const std::string& name, int64_t value) { add(name, std::to_string(value)); }
};

/// The argument as one would type it in a shell.
std::string shell_quoted(const std::string& argument);

} // namespace tonetool
