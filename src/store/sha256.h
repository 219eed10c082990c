// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 of FIPS 180-4: the hash that git-lfs names files by.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace tonetool::store {

class Sha256 {
public:
    void add(const void* bytes, size_t count);
    /// 64 hexadecimal digits of all that was added; nothing may be added behind it.
    std::string digits();

private:
    void take_block(const unsigned char* block);

    std::array<uint32_t, 8> m_state{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                    0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
    std::array<unsigned char, 64> m_block{};
    uint64_t m_bytes = 0;
};

std::string sha256_of(const std::string& text);
/// Of a file's bytes. Throws a runtime_error where it cannot be read to its end.
std::string sha256_of_file(const std::string& file);

} // namespace tonetool::store
