// SPDX-License-Identifier: BSD-3-Clause
// OpenEXR files that end before their last chunk does. OpenEXR 3.4 takes what is missing of values
// that are not compressed for black, without a word. The layout is that of "OpenEXR File Layout",
// of the Academy Software Foundation. Header only, as cut_file.h is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace tonetool {

class ExrEnd {
public:
    explicit ExrEnd(const std::string& file) : m_stream(file, std::ios::binary) {}

    /// Bytes that the file must have at least; 0: its header does not tell.
    uint64_t bytes() {
        constexpr uint64_t magic = 20000630, multipart = 0x1000;
        if (number(4) != magic)
            return 0;
        m_flags = number(4);
        m_multipart = (m_flags & multipart) != 0;
        do
            read_header();
        while (m_stream && m_multipart && m_stream.peek() != 0);
        if (m_multipart)
            m_stream.get();
        const uint64_t last = last_chunk();
        return m_stream && last > 0 ? end_of(last) : 0;
    }

private:
    uint64_t number(int bytes) {
        uint64_t value = 0;
        for (int i = 0; i < bytes; ++i)
            value |= uint64_t(uint8_t(m_stream.get())) << (8 * i);
        return value;
    }

    std::string text() {
        constexpr size_t most = 256;
        std::string found;
        for (int c = m_stream.get(); c > 0 && found.size() < most; c = m_stream.get())
            found += char(c);
        return found;
    }

    // Of a part: what its chunks are.
    void read_header() {
        constexpr uint64_t tiled = 0x200;
        std::string kind = (m_flags & tiled) != 0 ? "tiledimage" : "scanlineimage";
        for (std::string name = text(); m_stream && !name.empty(); name = text()) {
            const std::string type = text();
            const uint64_t size = number(4);
            if (name == "type" && type == "string" && size < 64) {
                kind.clear();
                for (uint64_t i = 0; i < size; ++i)
                    kind += char(m_stream.get());
            } else {
                m_stream.seekg(std::streamoff(size), std::ios::cur);
            }
        }
        m_kinds.push_back(kind);
    }

    // Chunks follow their tables, so that the first of them ends these.
    uint64_t last_chunk() {
        uint64_t first = std::numeric_limits<uint64_t>::max(), last = 0;
        while (m_stream && uint64_t(m_stream.tellg()) < first) {
            const uint64_t offset = number(8);
            if (offset > 0) // else the file was never finished, as readers tell
                first = std::min(first, offset);
            last = std::max(last, offset);
        }
        return last;
    }

    uint64_t end_of(uint64_t offset) {
        constexpr uint64_t longest_head = 44;
        m_stream.seekg(std::streamoff(offset));
        const uint64_t part = m_multipart ? number(4) : 0;
        if (part >= m_kinds.size())
            return m_stream ? 0 : offset + longest_head;
        const bool tiled = m_kinds[part].find("tile") != std::string::npos;
        const bool deep = m_kinds[part].compare(0, 4, "deep") == 0;
        const uint64_t place = tiled ? 16 : 4;
        m_stream.seekg(std::streamoff(place), std::ios::cur);
        uint64_t bytes = number(deep ? 8 : 4);
        uint64_t head = (m_multipart ? 4 : 0) + place + 4;
        if (deep) { // a table of counts, the samples, and their size when they are unpacked
            bytes += number(8);
            head += 20;
        }
        return offset + (m_stream ? head + bytes : longest_head);
    }

    std::ifstream m_stream;
    uint64_t m_flags = 0;
    bool m_multipart = false;
    std::vector<std::string> m_kinds;
};

} // namespace tonetool
