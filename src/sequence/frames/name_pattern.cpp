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

NamePattern::NamePattern(const std::string& printf_style, bool names) {
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
        } else if (names && (kind == 'N' || kind == 'M') && end == at + 1) {
            m_pieces.push_back({kind == 'N' ? Kind::Name : Kind::Method});
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
                : piece.kind == Kind::Name   ? item.name
                : piece.kind == Kind::Method ? item.method
                : item.view.empty()          ? (piece.kind == Kind::View ? "%V" : "%v")
                : piece.kind == Kind::View   ? item.view
                                             : item.view.substr(0, 1);
    }
    return name;
}

// A placeholder that stands there again repeats what the first one is.
bool NamePattern::fits(const std::string& name, const std::string& view, size_t piece, size_t at,
                       Bound& bound) const {
    if (piece == m_pieces.size())
        return at == name.size();
    const Piece& one = m_pieces[piece];
    if (one.kind == Kind::Number || one.kind == Kind::Name || one.kind == Kind::Method)
        return fits_free(name, view, piece, at, bound);
    const std::string text = one.kind == Kind::Text   ? one.text
                             : one.kind == Kind::View ? view
                                                      : view.substr(0, 1);
    return name.compare(at, text.size(), text) == 0 &&
           fits(name, view, piece + 1, at + text.size(), bound);
}

bool NamePattern::fits_free(const std::string& name, const std::string& view, size_t piece,
                            size_t at, Bound& bound) const {
    const Piece& one = m_pieces[piece];
    const bool number = one.kind == Kind::Number;
    std::string& value = number ? bound.digits : one.kind == Kind::Name ? bound.name : bound.method;
    if (!value.empty()) {
        return name.compare(at, value.size(), value) == 0 &&
               fits(name, view, piece + 1, at + value.size(), bound);
    }
    const size_t least = number && !bound.any_width ? std::max<size_t>(one.width, 1) : 1;
    const size_t slash = one.kind == Kind::Method ? name.find('/', at) : std::string::npos;
    // The text behind the number may begin with digits, too.
    size_t end = number ? end_of_number(name, at) : std::min(slash, name.size());
    for (; end >= at + least && (!number || is_digit(name[end - 1])); --end) {
        value = name.substr(at, end - at);
        if (fits(name, view, piece + 1, end, bound))
            return true;
        value.clear();
    }
    return false;
}

std::optional<NamePattern::Number> NamePattern::number_of(const std::string& name,
                                                          const std::string& view) const {
    Bound bound;
    return fits(name, view, 0, 0, bound) ? std::optional(number_from(bound.digits)) : std::nullopt;
}

std::optional<NamePattern::Match> NamePattern::match(const std::string& file,
                                                     const std::string& view) const {
    // Else a name would take the first digits of a number.
    for (const bool any_width : {false, true}) {
        Bound bound;
        bound.any_width = any_width;
        if (fits(file, view, 0, 0, bound))
            return Match{bound.name, bound.method, number_from(bound.digits)};
    }
    return std::nullopt;
}

std::string NamePattern::fixed_part() const {
    return m_pieces.front().text; // the first piece is a text, which may be empty
}

NamePattern::Number NamePattern::number_from(const std::string& digits) const {
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
