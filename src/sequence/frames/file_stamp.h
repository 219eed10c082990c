// SPDX-License-Identifier: BSD-3-Clause
// Whether files have changed since a result was computed from them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tonetool::sequence {

/// The state of a file at some time; a missing file has a stamp, too.
struct Stamp {
    std::string file;
    uint64_t device = 0, inode = 0, size = 0;
    int64_t written = 0, changed = 0; ///< nanoseconds since 1970, of its content and of its inode

    bool operator==(const Stamp& o) const {
        return file == o.file && device == o.device && inode == o.inode && size == o.size &&
               written == o.written && changed == o.changed;
    }
    bool operator!=(const Stamp& o) const { return !(*this == o); }
};
using Stamps = std::vector<Stamp>;

Stamp stamp_of(const std::string& file);
/// Where a file is, or will be: its folder and links are resolved, those that lead nowhere yet,
/// too.
std::string place_of(const std::string& file);
bool is_current(const Stamps& stamps);

int64_t now_in_nanoseconds();
/// Whether no file was changed after that time, nor so shortly before it that another change could
/// leave the same stamp.
bool are_older(const Stamps& stamps, int64_t time);

/// The files that a run has opened or looked for, with their stamps from before the first time.
class FileLog {
public:
    FileLog() : m_begun(now_in_nanoseconds()) {}
    void note(const std::string& file);
    const Stamps& stamps() const { return m_stamps; }
    std::vector<std::string> names() const;
    /// When the log was begun.
    int64_t begun() const { return m_begun; }

private:
    int64_t m_begun;
    Stamps m_stamps;
};

/// Notes the files that another file depends on: a recipe reports here which files it reads, so
/// that a check of the recipe's stamp includes theirs. Names that were noted before stay. Safe to
/// call from several threads.
void note_files_behind(const std::string& file, const std::vector<std::string>& names);
std::vector<std::string> files_behind(const std::string& file);

} // namespace tonetool::sequence
