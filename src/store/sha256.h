// SPDX-License-Identifier: BSD-3-Clause
// SHA-256 (FIPS 180-4), the hash that git-lfs names files by, as OpenSSL computes it.
#pragma once

#include <cstddef>
#include <memory>
#include <string>

struct evp_md_ctx_st; // OpenSSL's EVP_MD_CTX

namespace tonetool::store {

class Sha256 {
public:
    Sha256();
    void add(const void* bytes, size_t count);
    /// 64 hexadecimal digits of all that was added; nothing may be added behind it.
    std::string digits();

private:
    std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> m_context;
};

std::string sha256_of(const std::string& text);
/// Of a file's bytes. Throws a runtime_error where it cannot be read to its end.
std::string sha256_of_file(const std::string& file);

} // namespace tonetool::store
