// A file name with places for numbers and views: text is text, and nothing in it is an expression.
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

    /// What is in the place of a number.
    struct Number {
        int value = 0;
        bool beyond = false;  ///< an int, and the value is its limit
        bool of_width = true; ///< it has the digits that the pattern asks for
    };
    /// The number of a name that the pattern fits with this view; 0 where it has no number.
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
