// SPDX-License-Identifier: BSD-3-Clause
// A file name with placeholders for numbers and views. All other text stands for itself: it is no
// regular expression.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sequence/frames/item.h"

namespace tonetool::sequence {

class NamePattern {
public:
    /// In printf's style: "a.%04d.exr", "stereo_%V.exr".
    /// `names`: %N and %M stand for the name and the method of a case, else for themselves.
    explicit NamePattern(const std::string& printf_style, bool names = false);

    bool has_number() const { return has(Kind::Number); }
    bool has_view() const { return has(Kind::View) || has(Kind::Initial); }
    bool has_name() const { return has(Kind::Name); }
    bool has_method() const { return has(Kind::Method); }

    /// The name of one file. A negative number has the width of printf, its sign counted, or with
    /// `more_digits` one more.
    std::string filled(const Item& item, bool more_digits = false) const;

    /// The number that a name has in the placeholder.
    struct Number {
        int value = 0;
        bool beyond = false;  ///< the number exceeds an int, and `value` is the limit
        bool of_width = true; ///< it has as many digits as the pattern asks for
    };
    /// The number in a name that matches the pattern with this view; 0 if the pattern has no
    /// number.
    std::optional<Number> number_of(const std::string& name, const std::string& view) const;

    /// The text before the first placeholder.
    std::string fixed_part() const;

    /// What the placeholders stand for in a name that matches the pattern with this view. A name is
    /// one or more bytes, a method one or more without /; the first placeholder takes what it can.
    struct Match {
        std::string name, method;
        Number number;
    };
    std::optional<Match> match(const std::string& file, const std::string& view) const;

private:
    enum class Kind { Text, Number, View, Initial, Name, Method };
    struct Bound {
        std::string name, method, digits;
        bool any_width = true; ///< of numbers
    };
    struct Piece {
        Kind kind;
        std::string text{};
        size_t width = 0; ///< of a number, 0: as it comes
    };
    bool has(Kind kind) const;
    bool fits(const std::string& name, const std::string& view, size_t piece, size_t at,
              Bound& bound) const;
    bool fits_free(const std::string& name, const std::string& view, size_t piece, size_t at,
                   Bound& bound) const;
    Number number_from(const std::string& digits) const;

    std::vector<Piece> m_pieces;
};

} // namespace tonetool::sequence
