// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/base64.h"

#include <OpenImageIO/strutil.h>
#include <array>

namespace tonetool::sequence {

namespace {

// The value of each digit, -1 for other characters.
std::array<signed char, 256> digit_values() {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<signed char, 256> values{};
    values.fill(-1);
    for (int i = 0; i < 64; ++i)
        values[static_cast<unsigned char>(digits[i])] = static_cast<signed char>(i);
    return values;
}

} // namespace

std::string base64(const std::vector<unsigned char>& bytes) {
    return OIIO::Strutil::base64_encode(
        {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::vector<unsigned char> bytes_of_base64(const std::string& text, size_t begin) {
    static const std::array<signed char, 256> values = digit_values();
    std::vector<unsigned char> bytes;
    bytes.reserve((text.size() - begin) / 4 * 3);
    unsigned int held = 0;
    int bits = 0;
    for (size_t i = begin; i < text.size(); ++i) {
        const int sextet = values[static_cast<unsigned char>(text[i])];
        if (sextet < 0)
            break;
        held = (held << 6 | unsigned(sextet)) & 0xffffffu;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<unsigned char>(held >> bits));
        }
    }
    return bytes;
}

} // namespace tonetool::sequence
