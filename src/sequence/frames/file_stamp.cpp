// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/file_stamp.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <sys/stat.h>

namespace tonetool::sequence {

namespace {

int64_t nanoseconds(const timespec& time) {
    return int64_t(time.tv_sec) * 1000000000 + time.tv_nsec;
}

// File systems record times in ticks of the kernel's clock, which last up to 10 ms.
constexpr int64_t kTick = 20000000;

struct Behind {
    std::mutex mutex;
    std::map<std::string, std::set<std::string>> names;
};

Behind& behind() {
    static Behind all;
    return all;
}

} // namespace

Stamp stamp_of(const std::string& file) {
    struct stat found {};
    Stamp stamp{file};
    if (stat(file.c_str(), &found) == 0) {
        stamp.device = uint64_t(found.st_dev);
        stamp.inode = uint64_t(found.st_ino);
        stamp.size = uint64_t(found.st_size);
        stamp.written = nanoseconds(found.st_mtim);
        stamp.changed = nanoseconds(found.st_ctim);
    }
    return stamp;
}

std::string place_of(const std::string& file) {
    namespace fs = std::filesystem;
    constexpr int most = 40; // as the system follows
    std::error_code why;
    fs::path path = file;
    for (int links = 0; links < most && fs::is_symlink(path, why) && !fs::exists(path, why);
         ++links)
        path = path.parent_path() / fs::read_symlink(path, why);
    const fs::path place = fs::weakly_canonical(fs::absolute(path, why), why);
    return (why ? fs::absolute(path, why).lexically_normal() : place).string();
}

bool is_current(const Stamps& stamps) {
    return std::all_of(stamps.begin(), stamps.end(),
                       [](const Stamp& stamp) { return stamp_of(stamp.file) == stamp; });
}

int64_t now_in_nanoseconds() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

bool are_older(const Stamps& stamps, int64_t time) {
    return std::all_of(stamps.begin(), stamps.end(), [time](const Stamp& stamp) {
        return std::max(stamp.written, stamp.changed) < time - kTick;
    });
}

void FileLog::note(const std::string& file) {
    const auto same = [&](const Stamp& stamp) { return stamp.file == file; };
    if (std::any_of(m_stamps.begin(), m_stamps.end(), same))
        return;
    m_stamps.push_back(stamp_of(file));
    // "file?name=value" opens the file, unless a file has that whole name.
    const size_t question = file.find('?');
    if (m_stamps.back().inode == 0 && question != std::string::npos)
        note(file.substr(0, question));
}

std::vector<std::string> FileLog::names() const {
    std::vector<std::string> all;
    for (const Stamp& stamp : m_stamps)
        all.push_back(stamp.file);
    return all;
}

void note_files_behind(const std::string& file, const std::vector<std::string>& names) {
    Behind& all = behind();
    const std::lock_guard<std::mutex> lock(all.mutex);
    all.names[file].insert(names.begin(), names.end());
}

std::vector<std::string> files_behind(const std::string& file) {
    Behind& all = behind();
    const std::lock_guard<std::mutex> lock(all.mutex);
    const auto found = all.names.find(file);
    return found == all.names.end()
               ? std::vector<std::string>{}
               : std::vector<std::string>(found->second.begin(), found->second.end());
}

} // namespace tonetool::sequence
