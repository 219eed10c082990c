// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/name_pattern.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>

namespace tonetool::sequence {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

// Digits behind an optional sign.
size_t end_of_number(const std::string& name, size_t at) {
    size_t end = at + (at < name.size() && name[at] == '-' ? 1 : 0);
    const size_t first = end;
    while (end < name.size() && is_digit(name[end]))
        ++end;
    return end == first ? at : end;
}

} // namespace

NamePattern::NamePattern(const std::string& printf_style) {
    m_pieces.push_back({Kind::Text});
    for (size_t at = 0; at < printf_style.size(); ++at) {
        size_t end = at + 1;
        while (printf_style[at] == '%' && end < printf_style.size() && is_digit(printf_style[end]))
            ++end;
        const char kind =
            printf_style[at] == '%' && end < printf_style.size() ? printf_style[end] : '\0';
        if (kind == 'd') {
            const int width = OIIO::Strutil::stoi(printf_style.substr(at + 1, end - at - 1));
            m_pieces.push_back({Kind::Number, "", size_t(std::clamp(width, 0, 255))});
        } else if ((kind == 'V' || kind == 'v') && end == at + 1) {
            m_pieces.push_back({kind == 'V' ? Kind::View : Kind::Initial});
        } else {
            if (m_pieces.back().kind != Kind::Text)
                m_pieces.push_back({Kind::Text});
            m_pieces.back().text += printf_style[at];
            continue;
        }
        at = end;
    }
}

bool NamePattern::has(Kind kind) const {
    return std::any_of(m_pieces.begin(), m_pieces.end(),
                       [&](const Piece& piece) { return piece.kind == kind; });
}

std::string NamePattern::filled(const Item& item, bool more_digits) const {
    std::string name;
    for (const Piece& piece : m_pieces) {
        const size_t width = piece.width + (more_digits && item.frame < 0 ? 1 : 0);
        name += piece.kind == Kind::Text ? piece.text
                : piece.kind == Kind::Number
                    ? OIIO::Strutil::fmt::format("{:0{}d}", item.frame, width)
                : item.view.empty()        ? (piece.kind == Kind::View ? "%V" : "%v")
                : piece.kind == Kind::View ? item.view
                                           : item.view.substr(0, 1);
    }
    return name;
}

// `digits` are those of the first number: all other placeholders repeat it.
bool NamePattern::fits(const std::string& name, const std::string& view, size_t piece, size_t at,
                       std::string& digits) const {
    if (piece == m_pieces.size())
        return at == name.size();
    const Piece& one = m_pieces[piece];
    if (one.kind != Kind::Number) {
        const std::string text = one.kind == Kind::Text   ? one.text
                                 : one.kind == Kind::View ? view
                                                          : view.substr(0, 1);
        return name.compare(at, text.size(), text) == 0 &&
               fits(name, view, piece + 1, at + text.size(), digits);
    }
    // The text behind the number may begin with digits, too.
    for (size_t end = end_of_number(name, at); end > at && is_digit(name[end - 1]); --end) {
        const std::string here = name.substr(at, end - at), before = digits;
        if (before.empty() || before == here) {
            digits = here;
            if (fits(name, view, piece + 1, end, digits))
                return true;
            digits = before;
        }
    }
    return false;
}

std::optional<NamePattern::Number> NamePattern::number_of(const std::string& name,
                                                          const std::string& view) const {
    std::string digits;
    if (!fits(name, view, 0, 0, digits))
        return std::nullopt;
    Number number;
    if (digits.empty())
        return number;
    int value = 0;
    const auto problem = std::from_chars(digits.data(), digits.data() + digits.size(), value).ec;
    number.beyond = problem != std::errc();
    number.value = !number.beyond     ? value
                   : digits[0] == '-' ? std::numeric_limits<int>::min()
                                      : std::numeric_limits<int>::max();
    for (const Piece& piece : m_pieces) {
        number.of_width =
            number.of_width && (piece.kind != Kind::Number || digits.size() >= piece.width);
    }
    return number;
}

} // namespace tonetool::sequence
