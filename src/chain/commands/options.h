// SPDX-License-Identifier: BSD-3-Clause
// Modifiers of commands made of the tables of options, and options read from modifiers.
#pragma once

#include <string>
#include <vector>

#include "chain/commands/commands.h"
#include "imagebuf/options/option.h"
#include "tonetool/compare.h"

namespace tonetool::chain {

/// "X", "N", "0|1", the choices, or what the table says a value looks like.
template <class Owner, class T>
std::string hint_of(const Option<Owner, T>& row) {
    using Value = typename Option<Owner, T>::Value;
    if (!row.hint.empty() || !row.list.empty())
        return row.hint.empty() ? join(row.list, "|") : row.hint;
    if constexpr (std::is_same_v<Value, bool>)
        return "0|1";
    else if constexpr (std::is_integral_v<Value>)
        return "N";
    else if constexpr (std::is_arithmetic_v<Value>)
        return "X";
    else
        return "NAME";
}

template <class Options>
Modifiers modifiers_of() {
    Modifiers rows;
    describe(Options(), [&](const auto& row) {
        const std::string initial = row.initial();
        rows.push_back(
            {row.key, hint_of(row), row.meaning() + (initial.empty() ? "" : " (" + initial + ")")});
    });
    return rows;
}

/// The commands of oiiotool read 1/125 as 1; those of these tables are not among them.
inline void read_value(const Call& call, const char* key, const Range& range, double& value) {
    const auto text = call.text(key);
    value = text && text->find('/') != std::string::npos ? checked_fraction(key, *text, range)
                                                         : call.number(key, range).value_or(value);
}
inline void read_value(const Call& call, const char* key, const Range& range, int& value) {
    value = call.integer(key, range).value_or(value);
}
inline void read_value(const Call& call, const char* key, const Range&, bool& value) {
    value = call.flag(key, value);
}
inline void read_value(const Call& call, const char* key, const Range&, std::string& value) {
    value = call.text(key).value_or(value);
}
inline void read_value(const Call& call, const char* key, const Range&, Strings& value) {
    if (const auto list = call.text(key))
        value = split(*list, ',');
}
inline void read_value(const Call& call, const char* key, const Range&, Mask& value) {
    value.file = call.text(key).value_or("");
}
template <class T>
void read_value(const Call& call, const char* key, const Range& range, std::optional<T>& value) {
    if (!call.has(key))
        return;
    T given{};
    read_value(call, key, range, given);
    value = given;
}

/// What the modifiers say.
template <class Options>
void read_options(const Call& call, Options& options) {
    describe(options, [&](const auto& row) {
        if (!row.list.empty())
            (void)call.choice(row.key, row.list);
        Range range = row.range.value_or(Range{-1e300, 1e300});
        if (row.or_zero)
            range.low = 0;
        read_value(call, row.key, range, options.*row.member);
    });
}

} // namespace tonetool::chain
