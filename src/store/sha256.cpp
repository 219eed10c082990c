// SPDX-License-Identifier: BSD-3-Clause
#include "store/sha256.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <openssl/evp.h>

namespace tonetool::store {

namespace {

void expect_done(int status) {
    if (status != 1)
        throw std::runtime_error("OpenSSL cannot compute SHA-256 on this machine");
}

} // namespace

Sha256::Sha256() : m_context(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    expect_done(m_context ? EVP_DigestInit_ex(m_context.get(), EVP_sha256(), nullptr) : 0);
}

void Sha256::add(const void* bytes, size_t count) {
    expect_done(EVP_DigestUpdate(m_context.get(), bytes, count));
}

std::string Sha256::digits() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
    unsigned count = 0;
    expect_done(EVP_DigestFinal_ex(m_context.get(), hash.data(), &count));
    std::string text;
    for (unsigned i = 0; i < count; ++i) {
        std::array<char, 3> hex{};
        std::snprintf(hex.data(), hex.size(), "%02x", hash.at(i));
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
