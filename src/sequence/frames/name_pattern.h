// SPDX-License-Identifier: BSD-3-Clause
// A file name with placeholders for numbers and views. All other text stands for itself: it is no
// regular expression.
#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace tonetool::sequence {

struct Item {
    int frame = 0;
    std::string view; ///< empty where the pattern has no %V or %v
    bool operator==(const Item& o) const { return frame == o.frame && view == o.view; }
    bool operator<(const Item& o) const {
        return std::tie(frame, view) < std::tie(o.frame, o.view);
    }
};

class NamePattern {
public:
    /// In printf's style: "a.%04d.exr", "stereo_%V.exr".
    explicit NamePattern(const std::string& printf_style);

    bool has_number() const { return has(Kind::Number); }
    bool has_view() const { return has(Kind::View) || has(Kind::Initial); }

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

private:
    enum class Kind { Text, Number, View, Initial };
    struct Piece {
        Kind kind;
        std::string text{};
        size_t width = 0; ///< of a number, 0: as it comes
    };
    bool has(Kind kind) const;
    bool fits(const std::string& name, const std::string& view, size_t piece, size_t at,
              std::string& digits) const;

    std::vector<Piece> m_pieces;
};

} // namespace tonetool::sequence
