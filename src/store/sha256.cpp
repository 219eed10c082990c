// SPDX-License-Identifier: BSD-3-Clause
#include "store/sha256.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <vector>

namespace tonetool::store {

namespace {

// FIPS 180-4, 4.2.2: the first 32 bits of the fractional parts of the cube roots of the first 64
// primes.
constexpr std::array<uint32_t, 64> kRounds{
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

uint32_t rotated(uint32_t x, int by) {
    return (x >> by) | (x << (32 - by));
}

} // namespace

// FIPS 180-4, 6.2.2.
void Sha256::take_block(const unsigned char* block) {
    std::array<uint32_t, 64> w{};
    for (size_t t = 0; t < 16; ++t) {
        w[t] = uint32_t(block[4 * t]) << 24 | uint32_t(block[4 * t + 1]) << 16 |
               uint32_t(block[4 * t + 2]) << 8 | uint32_t(block[4 * t + 3]);
    }
    for (size_t t = 16; t < 64; ++t) {
        const uint32_t a = w[t - 15], b = w[t - 2];
        const uint32_t small0 = rotated(a, 7) ^ rotated(a, 18) ^ (a >> 3);
        const uint32_t small1 = rotated(b, 17) ^ rotated(b, 19) ^ (b >> 10);
        w[t] = small1 + w[t - 7] + small0 + w[t - 16];
    }
    auto [a, b, c, d, e, f, g, h] = m_state;
    for (size_t t = 0; t < 64; ++t) {
        const uint32_t big1 = rotated(e, 6) ^ rotated(e, 11) ^ rotated(e, 25);
        const uint32_t first = h + big1 + ((e & f) ^ (~e & g)) + kRounds[t] + w[t];
        const uint32_t big0 = rotated(a, 2) ^ rotated(a, 13) ^ rotated(a, 22);
        const uint32_t second = big0 + ((a & b) ^ (a & c) ^ (b & c));
        h = g;
        g = f;
        f = e;
        e = d + first;
        d = c;
        c = b;
        b = a;
        a = first + second;
    }
    const std::array<uint32_t, 8> worked{a, b, c, d, e, f, g, h};
    for (size_t i = 0; i < worked.size(); ++i)
        m_state[i] += worked[i];
}

void Sha256::add(const void* bytes, size_t count) {
    const auto* from = static_cast<const unsigned char*>(bytes);
    while (count > 0) {
        const size_t filled = m_bytes % m_block.size();
        const size_t part = std::min(count, m_block.size() - filled);
        std::memcpy(m_block.data() + filled, from, part);
        m_bytes += part;
        from += part;
        count -= part;
        if (m_bytes % m_block.size() == 0)
            take_block(m_block.data());
    }
}

// FIPS 180-4, 5.1.1: a one bit, zeros, and the number of bits.
std::string Sha256::digits() {
    const uint64_t bits = m_bytes * 8;
    const unsigned char one = 0x80, zero = 0;
    add(&one, 1);
    while (m_bytes % m_block.size() != 56)
        add(&zero, 1);
    std::array<unsigned char, 8> length{};
    for (size_t i = 0; i < length.size(); ++i)
        length[i] = static_cast<unsigned char>(bits >> (56 - 8 * i));
    add(length.data(), length.size());
    std::string text;
    for (const uint32_t word : m_state) {
        std::array<char, 9> hex{};
        std::snprintf(hex.data(), hex.size(), "%08x", word);
        text += hex.data();
    }
    return text;
}

std::string sha256_of(const std::string& text) {
    Sha256 hash;
    hash.add(text.data(), text.size());
    return hash.digits();
}

std::string sha256_of_file(const std::string& file) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> from(std::fopen(file.c_str(), "rb"),
                                                               std::fclose);
    std::vector<char> bytes(size_t(1) << 18);
    Sha256 hash;
    size_t count = 0;
    while (from && (count = std::fread(bytes.data(), 1, bytes.size(), from.get())) > 0)
        hash.add(bytes.data(), count);
    if (!from || std::ferror(from.get()) != 0)
        throw std::runtime_error("cannot read \"" + file + "\": " + std::strerror(errno));
    return hash.digits();
}

} // namespace tonetool::store
