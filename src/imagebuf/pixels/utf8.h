// SPDX-License-Identifier: BSD-3-Clause
// Text of files and of the libraries below, which may be in any encoding.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

namespace tonetool {

/// How many bytes of `text` from `begin` on belong together, and whether they are a character of
/// UTF-8 (Unicode 15, table 3-7); if not, they are as many as one U+FFFD stands for.
inline std::pair<size_t, bool> utf8_character(const std::string& text, size_t begin) {
    const auto byte = [&](size_t i) {
        return begin + i < text.size() ? static_cast<unsigned char>(text[begin + i]) : 0u;
    };
    const unsigned lead = byte(0);
    if (lead < 0x80)
        return {1, true};
    size_t length = lead >= 0xC2 && lead <= 0xF4 ? 2 : 1;
    length += lead >= 0xE0 && lead <= 0xF4 ? 1 : 0;
    length += lead >= 0xF0 && lead <= 0xF4 ? 1 : 0;
    // No overlong forms, halves of surrogates or numbers beyond Unicode.
    const unsigned low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    const unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    size_t good = 1;
    while (good < length && byte(good) >= (good == 1 ? low : 0x80) &&
           byte(good) <= (good == 1 ? high : 0xBF))
        ++good;
    return {good, length > 1 && good == length};
}

/// The text with U+FFFD for bytes that are no UTF-8: what errors, results and reports show.
inline std::string valid_utf8(const std::string& text) {
    std::string valid;
    valid.reserve(text.size());
    for (size_t at = 0; at < text.size();) {
        const auto [bytes, good] = utf8_character(text, at);
        valid += good ? text.substr(at, bytes) : "\xEF\xBF\xBD";
        at += bytes;
    }
    return valid;
}

} // namespace tonetool
