// SPDX-License-Identifier: BSD-3-Clause
// Why a file does not open as an image.
#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

namespace tonetool {

/// OpenImageIO's own words, but for files that may not be read and empty ones: its readers call
/// both files of another format.
inline std::string why_not_opened(const std::string& file, const std::string& said) {
    std::FILE* opened = std::fopen(file.c_str(), "rb");
    if (opened)
        std::fclose(opened);
    else if (errno != ENOENT) // the reader may know the name better: "shot.tone?frame=3"
        return std::strerror(errno);
    std::error_code ignored;
    if (std::filesystem::file_size(file, ignored) != 0)
        return said;
    return said.substr(0, said.find('\n')) + ": it is empty (0 bytes)";
}

} // namespace tonetool
