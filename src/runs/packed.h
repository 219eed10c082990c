// SPDX-License-Identifier: BSD-3-Clause
// Texts as one row of bytes, for what goes from one process to another.
#pragma once

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "text/text.h"

namespace tonetool::runs {

inline std::string packed(const Strings& texts) {
    std::string bytes;
    for (const std::string& text : texts) {
        const uint64_t size = text.size();
        bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
        bytes += text;
    }
    return bytes;
}

/// What `packed` has made of texts; a runtime_error for anything else.
inline Strings unpacked(const std::string& bytes) {
    constexpr const char* other = "a worker process has sent something else than a result";
    Strings texts;
    for (size_t at = 0; at < bytes.size();) {
        uint64_t size = 0;
        if (bytes.size() - at < sizeof size)
            throw std::runtime_error(other);
        std::memcpy(&size, bytes.data() + at, sizeof size);
        at += sizeof size;
        if (size > bytes.size() - at)
            throw std::runtime_error(other);
        texts.push_back(bytes.substr(at, size));
        at += size;
    }
    return texts;
}

/// The same of as many texts as there must be.
inline Strings unpacked(const std::string& bytes, size_t count) {
    Strings texts = unpacked(bytes);
    if (texts.size() != count) {
        throw std::runtime_error("a worker process has sent " + std::to_string(texts.size()) +
                                 " texts instead of " + std::to_string(count));
    }
    return texts;
}

} // namespace tonetool::runs
