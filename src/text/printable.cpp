// SPDX-License-Identifier: BSD-3-Clause
#include "text/printable.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace tonetool {

namespace {

// A character of UTF-8; a byte that begins none stands alone.
struct Character {
    uint32_t code;
    size_t bytes;
    bool valid; ///< as UTF-8
};

size_t length_by(unsigned char lead) {
    return lead < 0x80                    ? 1
           : lead >= 0xc2 && lead <= 0xdf ? 2
           : lead >= 0xe0 && lead <= 0xef ? 3
           : lead >= 0xf0 && lead <= 0xf4 ? 4
                                          : 0;
}

bool continues(const std::string& text, size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xc0) == 0x80;
}

Character character_at(const std::string& text, size_t at) {
    const auto lead = static_cast<unsigned char>(text[at]);
    const size_t length = length_by(lead);
    if (length <= 1)
        return {lead, 1, length == 1};
    uint32_t code = lead & (0xffU >> (length + 1));
    for (size_t i = 1; i < length; ++i) {
        if (!continues(text, at + i))
            return {lead, 1, false};
        code = code << 6 | (static_cast<unsigned char>(text[at + i]) & 0x3fU);
    }
    return {code, length, true};
}

// Whether more bytes could make a character of what is left at the end.
bool is_cut_off(const std::string& text, size_t at) {
    const size_t length = length_by(static_cast<unsigned char>(text[at]));
    size_t there = 1;
    while (there < length && continues(text, at + there))
        ++there;
    return there < length && at + there == text.size();
}

bool is_control(uint32_t code) {
    return code < 0x20 || (code >= 0x7f && code <= 0x9f);
}

// Marks, embeddings, overrides and isolates of direction; separators of lines.
bool turns_text(uint32_t code) {
    return code == 0x61c || code == 0x200e || code == 0x200f ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

void escape(const Character& c, std::string& out) {
    switch (c.code) {
    case '\n':
        out += "\\n";
        return;
    case '\r':
        out += "\\r";
        return;
    case '\t':
        out += "\\t";
        return;
    default:
        char buffer[16];
        std::snprintf(buffer, sizeof buffer, c.code < 0x100 ? "\\x%02x" : "\\u%04x",
                      static_cast<unsigned>(c.code));
        out += buffer;
    }
}

void append(const std::string& text, size_t at, const Character& c, bool lines, std::string& out) {
    const bool kept = lines && (c.code == '\n' || c.code == '\t');
    if (!kept && (is_control(c.code) || (c.valid && turns_text(c.code))))
        escape(c, out);
    else
        out.append(text, at, c.bytes);
}

std::string replaced(const std::string& text, bool lines) {
    std::string out;
    for (size_t at = 0; at < text.size();) {
        const Character c = character_at(text, at);
        append(text, at, c, lines, out);
        at += c.bytes;
    }
    return out;
}

} // namespace

std::string printable(const std::string& text) {
    return replaced(text, false);
}

std::string printable_lines(const std::string& text) {
    return replaced(text, true);
}

std::string printable_json(const std::string& json) {
    const auto plain = [](char c) { return static_cast<unsigned char>(c) < 0x7f; };
    if (std::all_of(json.begin(), json.end(), plain))
        return json;
    std::string out;
    for (size_t at = 0; at < json.size();) {
        const Character c = character_at(json, at);
        if (c.code >= 0x7f && c.valid && (is_control(c.code) || turns_text(c.code))) {
            char buffer[16];
            std::snprintf(buffer, sizeof buffer, "\\u%04x", static_cast<unsigned>(c.code));
            out += buffer;
        } else {
            out.append(json, at, c.bytes);
        }
        at += c.bytes;
    }
    return out;
}

PrintableBuffer::int_type PrintableBuffer::overflow(int_type c) {
    if (traits_type::eq_int_type(c, traits_type::eof()))
        return traits_type::not_eof(c);
    const char one = traits_type::to_char_type(c);
    return xsputn(&one, 1) == 1 ? c : traits_type::eof();
}

std::streamsize PrintableBuffer::xsputn(const char* text, std::streamsize size) {
    return put(std::string(text, size_t(size)), false) ? size : 0;
}

// The standard error is flushed after every piece: a character goes on in the next one.
int PrintableBuffer::sync() {
    return m_to->pubsync();
}

bool PrintableBuffer::put(const std::string& more, bool all) {
    const std::string text = m_rest + more;
    std::string out;
    size_t at = 0;
    while (at < text.size()) {
        const bool returns = text[at] == '\r';
        if (!all && (is_cut_off(text, at) || (returns && at + 1 == text.size())))
            break;
        const Character c = character_at(text, at);
        if (returns && (m_at_start || (at + 1 < text.size() && text[at + 1] == '\n')))
            out += '\r';
        else
            append(text, at, c, true, out);
        m_at_start = text[at] == '\n';
        at += c.bytes;
    }
    m_rest = text.substr(at);
    return m_to->sputn(out.data(), std::streamsize(out.size())) == std::streamsize(out.size());
}

} // namespace tonetool
