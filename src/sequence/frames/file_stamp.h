// Whether files are still what they were when something was made of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tonetool::sequence {

/// A file as it was; a file that is not there has a stamp, too.
struct Stamp {
    std::string file;
    uint64_t device = 0, inode = 0, size = 0;
    int64_t written = 0, changed = 0; ///< nanoseconds since 1970: its content, its inode

    bool operator==(const Stamp& o) const {
        return file == o.file && device == o.device && inode == o.inode && size == o.size &&
               written == o.written && changed == o.changed;
    }
    bool operator!=(const Stamp& o) const { return !(*this == o); }
};
using Stamps = std::vector<Stamp>;

Stamp stamp_of(const std::string& file);
bool is_current(const Stamps& stamps);

int64_t now_in_nanoseconds();
/// Whether no file was changed after that time, or so shortly before it that another change could
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

/// What a file stands for: a recipe that reads others says so here, for all who look at the stamp
/// of the recipe. Names that were noted for it before stay. Safe to call from several threads.
void note_files_behind(const std::string& file, const std::vector<std::string>& names);
std::vector<std::string> files_behind(const std::string& file);

} // namespace tonetool::sequence
