// SPDX-License-Identifier: BSD-3-Clause
// Allocation of pixel memory whose size comes from the header of a file.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/sysutil.h>
#include <cstdint>
#include <new>
#include <string>

namespace tonetool {

/// More memory than this computer has: a system that promises memory before it has any would give
/// it, and end the program when the pixels arrive.
class TooLarge : public std::bad_alloc {
public:
    TooLarge(uint64_t bytes, uint64_t available)
        : m_text("not enough memory: the pixels would take " + gigabytes(bytes) +
                 ", this computer has " + gigabytes(available)) {}
    const char* what() const noexcept override { return m_text.c_str(); }

private:
    static std::string gigabytes(uint64_t bytes) {
        constexpr uint64_t tenth = (uint64_t(1) << 30) / 10;
        const uint64_t tenths = bytes / tenth + (bytes % tenth > 0 ? 1 : 0);
        return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " GB";
    }

    std::string m_text;
};

/// The text of an error for an allocation that failed.
inline std::string memory_text(const std::bad_alloc& failure) {
    const auto* large = dynamic_cast<const TooLarge*>(&failure);
    return large ? large->what() : "not enough memory";
}

/// Throws TooLarge for more bytes than this computer has.
inline void expect_memory(uint64_t bytes) {
    static const uint64_t available = OIIO::Sysutil::physical_memory();
    if (available > 0 && bytes > available)
        throw TooLarge(bytes, available);
}

/// An image with allocated, uninitialized pixels; a std::bad_alloc where that fails.
inline OIIO::ImageBuf allocated_image(const OIIO::ImageSpec& spec) {
    expect_memory(spec.image_bytes());
    OIIO::ImageBuf image(spec, OIIO::InitializePixels::No);
    if (!image.localpixels())
        throw std::bad_alloc();
    return image;
}

} // namespace tonetool
