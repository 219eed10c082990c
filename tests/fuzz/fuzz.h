// SPDX-License-Identifier: BSD-3-Clause
// What the fuzz targets have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <unistd.h>

namespace tonetool::fuzz {

inline std::string text_of(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Ends the run as a finding of the fuzzer.
inline void require(bool holds, const char* what) {
    if (!holds) {
        std::cerr << "does not hold: " << what << std::endl;
        std::abort();
    }
}

/// A file with this text, of this process alone.
inline std::string file_of(const std::string& text, const std::string& name) {
    static const std::filesystem::path folder = [] {
        auto made = std::filesystem::temp_directory_path() /
                    ("tonetool-fuzz-" + std::to_string(::getpid()));
        std::filesystem::create_directories(made);
        std::atexit([] {
            std::error_code ignored;
            std::filesystem::remove_all(std::filesystem::temp_directory_path() /
                                            ("tonetool-fuzz-" + std::to_string(::getpid())),
                                        ignored);
        });
        return made;
    }();
    const std::string file = (folder / name).string();
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

} // namespace tonetool::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
