// Whether files are still what they were.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tonetool::recipe {

/// A file as it was; a file that is not there has a stamp, too.
struct Stamp {
    std::string file;
    int64_t written = 0, changed = 0; ///< nanoseconds since 1970: its content, its inode
    uint64_t size = 0, inode = 0;

    bool operator==(const Stamp& o) const {
        return file == o.file && written == o.written && changed == o.changed && size == o.size &&
               inode == o.inode;
    }
};
using Stamps = std::vector<Stamp>;

Stamp stamp_of(const std::string& file);
bool is_current(const Stamps& stamps);

int64_t now_in_nanoseconds();
/// Whether no file was changed after that time, or so shortly before it that another change could
/// leave the same stamp.
bool are_older(const Stamps& stamps, int64_t time);

} // namespace tonetool::recipe
