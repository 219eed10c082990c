// SPDX-License-Identifier: BSD-3-Clause
// Files of which a reader says that all is well, though pixels are missing.
#pragma once

#include <OpenImageIO/imageio.h>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "imagebuf/pixels/cut_exr.h"
#include "imagebuf/pixels/oiio_compat.h"

namespace tonetool {

inline std::string bytes_missing(const std::string& file, uint64_t wanted) {
    std::error_code ignored;
    const uint64_t size = std::filesystem::file_size(file, ignored);
    return ignored || size >= wanted ? ""
                                     : "the file has " + std::to_string(size) +
                                           " bytes, its header asks for " + std::to_string(wanted);
}

/// The DPX reader (OpenImageIO 2.4) leaves what is missing of 10 and 12 bit pixels as it lay in
/// memory. The sizes are those of SMPTE 268M, of pictures that are not compressed; 0: the header
/// does not tell.
inline uint64_t bytes_of_dpx(const OIIO::ImageInput& in, const std::string& file) {
    std::array<unsigned char, 2048> header{};
    std::ifstream stream(file, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(header.data()), header.size()))
        return 0;
    const bool big = header[0] == 'S';
    const auto number = [&](size_t at, size_t bytes) {
        uint64_t value = 0;
        for (size_t i = 0; i < bytes; ++i)
            value = value << 8 | header[at + (big ? i : bytes - 1 - i)];
        return value;
    };
    const OIIO::ImageSpec& spec = in.spec();
    const uint64_t offset = number(4, 4), bits = header[803], packing = number(804, 2);
    const uint64_t samples = uint64_t(spec.width) * uint64_t(spec.nchannels);
    if (number(770, 2) != 1 || number(806, 2) != 0 || bits == 0 || bits > 64)
        return 0;
    const uint64_t words = packing == 0 ? (samples * bits + 31) / 32
                           : bits == 10 ? (samples + 2) / 3
                           : bits == 12 ? (samples + 1) / 2
                                        : samples * bits / 32;
    return offset + words * 4 * uint64_t(spec.height);
}

/// Why a file holds fewer bytes than its header asks for; empty where that is not known.
inline std::string bytes_missing(const OIIO::ImageInput& in, const std::string& file) {
    const std::string format = in.format_name();
    return format == "dpx" ? bytes_missing(file, bytes_of_dpx(in, file))
           : format == "openexr" && !oiio::kTellsOfCutExr
               ? bytes_missing(file, ExrEnd(file).bytes())
               : "";
}

} // namespace tonetool
