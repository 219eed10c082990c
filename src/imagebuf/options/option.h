// SPDX-License-Identifier: BSD-3-Clause
// A field of a struct of options, described once: its name on the command line and in Python, its
// range or choices, its default and what it means. The checks, the modifiers of commands, the
// keywords of Python and the texts of both are made from these descriptions.
//
// Header only: the command language and the Python module include it, which see no symbol of the
// library but the public ones.
#pragma once

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {

/// A closed range that a number must lie in.
struct Range {
    double low, high;
};

template <class T>
struct ValueOf {
    using Type = T;
};
template <class T>
struct ValueOf<std::optional<T>> {
    using Type = T;
};

template <class Owner, class T>
struct Option {
    using Value = typename ValueOf<T>::Type;
    static constexpr bool kOptional = !std::is_same_v<T, Value>;

    const char* key;                    ///< on the command line and in errors: "maxpercentile"
    const char* keyword;                ///< in Python: the member's name, "max_percentile"
    T Owner::*member;                   ///< its value in a fresh struct is the default
    std::string text;                   ///< what it means; begins in lower case, ends without a dot
    std::string hint = {};              ///< what a value looks like; empty: by type and choices
    std::optional<Range> range = {};    ///< of a number
    std::vector<std::string> list = {}; ///< of a name: the choices
    bool or_zero = false;               ///< 0 is valid beside the range
    /// What stands for an unset or empty value, or for a number's default outside the range: "the
    /// image's".
    std::string otherwise = {};
    const char* unit = ""; ///< behind a range in errors: "stops"

    Option within(double low, double high) && {
        range = Range{low, high};
        return std::move(*this);
    }
    Option in(const char* what) && {
        unit = what;
        return std::move(*this);
    }
    Option positive() && { return std::move(*this).within(1e-30, 1e30); }
    Option zero_too() && {
        or_zero = true;
        return std::move(*this);
    }
    Option one_of(std::vector<std::string> choices) && {
        list = std::move(choices);
        return std::move(*this);
    }
    Option shown_as(std::string value) && {
        hint = std::move(value);
        return std::move(*this);
    }
    Option unset(std::string meaning) && {
        otherwise = std::move(meaning);
        return std::move(*this);
    }

    /// What it means, with the range behind the first clause: "samples of the window, 4 to 400; 0:
    /// all its pixels".
    std::string meaning() const {
        const size_t end = std::min(text.find(';'), text.size());
        return text.substr(0, end) + limits() + text.substr(end);
    }

    /// The default as help shows it.
    std::string initial() const {
        if (!otherwise.empty())
            return otherwise;
        T value = Owner().*member;
        if constexpr (std::is_same_v<T, std::string>)
            return value;
        else if constexpr (std::is_same_v<T, bool>)
            return value ? "1" : "0";
        else if constexpr (std::is_arithmetic_v<T>)
            return OIIO::Strutil::fmt::format("{:g}", double(value));
        else
            return "";
    }

    /// Why a value is not valid; empty: it is.
    std::string fault(const Owner& options) const {
        using OIIO::Strutil::fmt::format;
        if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>) {
            if (!range)
                return "";
            Value value;
            if constexpr (kOptional) {
                if (!(options.*member))
                    return "";
                value = *(options.*member);
            } else {
                value = options.*member;
            }
            const bool inside = double(value) >= range->low && double(value) <= range->high;
            const bool zero = or_zero && value == 0;
            bool unset = false;
            if constexpr (!kOptional)
                unset = !otherwise.empty() && value == Owner().*member;
            return inside || zero || unset
                       ? ""
                       : format("{} is {}: must be {}", key, value, valid_numbers());
        } else if constexpr (std::is_same_v<T, std::string>) {
            const std::string& value = options.*member;
            const bool unset = value.empty() && !otherwise.empty();
            const bool known = std::find(list.begin(), list.end(), value) != list.end();
            return list.empty() || unset || known ? "" : unknown_name(key, value, list);
        } else {
            return "";
        }
    }

private:
    std::string valid_numbers() const {
        using OIIO::Strutil::fmt::format;
        return range->low == 1e-30 && range->high >= 1e30
                   ? "positive and finite"
                   : format("{} to {}{}{}", range->low, range->high, *unit ? " " : "", unit);
    }

    std::string limits() const {
        using OIIO::Strutil::fmt::format;
        if (!range)
            return "";
        if (range->low <= 0 || range->low > 1e-30)
            return format(", {:g} to {:g}", range->low, range->high);
        return range->high >= 1e30 ? ", above 0" : format(", above 0, to {:g}", range->high);
    }
};

template <class Owner, class T>
Option<Owner, T> option(const char* key, T Owner::*member, std::string text) {
    return {key, key, member, std::move(text)};
}
/// Where Python writes the name in another way.
template <class Owner, class T>
Option<Owner, T> option(const char* key, const char* keyword, T Owner::*member, std::string text) {
    return {key, keyword, member, std::move(text)};
}

/// What is wrong with the first field that is not valid, "sigma is 50: must be 1 to 20"; empty: all
/// are. A struct's fields are described by an overload of describe().
template <class Options>
std::string options_fault(const Options& options) {
    std::string fault;
    describe(options, [&](const auto& row) {
        if (fault.empty())
            fault = row.fault(options);
    });
    return fault;
}

/// Refuses what options_fault() finds.
template <class Options>
void check_options(const Options& options) {
    if (const std::string fault = options_fault(options); !fault.empty())
        throw Refusal(fault);
}

} // namespace tonetool
