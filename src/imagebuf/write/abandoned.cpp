// SPDX-License-Identifier: BSD-3-Clause
// Temporary files left behind by writers that were killed.
#include "imagebuf/write/abandoned.h"

#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "imagebuf/write/temporary_names.h"
#include "tonetool/write.h"

namespace tonetool {
namespace {

namespace fs = std::filesystem;

// A writer holds a lock on its file as long as it lives. Some network file systems keep locks to
// one machine: a file of another one must also have been left alone for a while.
constexpr long kSecondsOfOthers = 3600;

bool is_left_alone(const struct stat& info, const std::string& machine) {
    return machine == machine_tag() || std::time(nullptr) - info.st_mtime > kSecondsOfOthers;
}

void remove_if_unlocked(const std::string& path, const std::string& machine) {
    const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (fd < 0)
        return;
    struct stat info {};
    if (::fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && is_left_alone(info, machine) &&
        ::flock(fd, LOCK_EX | LOCK_NB) == 0)
        ::unlink(path.c_str());
    ::close(fd);
}

// Of these files, or of all if there are none.
void remove_abandoned(const fs::path& folder, const std::set<std::string>& names) {
    std::error_code why;
    for (fs::directory_iterator entry(folder, why), end; !why && entry != end;
         entry.increment(why)) {
        const TemporaryName name = parse_temporary_name(entry->path().filename().string());
        if (!name.base.empty() && (names.empty() || names.count(name.base) > 0))
            remove_if_unlocked(entry->path().string(), name.machine);
    }
}

fs::path folder_of(const std::string& filename) {
    const fs::path path(filename);
    return path.has_parent_path() ? path.parent_path() : ".";
}

} // namespace

void remove_abandoned_outputs(const std::vector<std::string>& filenames) {
    std::map<fs::path, std::set<std::string>> bases;
    for (const std::string& filename : filenames)
        bases[folder_of(filename)].insert(fs::path(filename).filename().string());
    for (const auto& [folder, names] : bases)
        remove_abandoned(folder, names);
}

void remove_abandoned_once(const std::string& filename) {
    static std::mutex lock;
    static std::set<std::pair<dev_t, ino_t>> done;
    const fs::path folder = folder_of(filename);
    struct stat info {};
    if (::stat(folder.c_str(), &info) != 0)
        return;
    {
        const std::lock_guard<std::mutex> hold(lock);
        if (!done.emplace(info.st_dev, info.st_ino).second)
            return;
    }
    remove_abandoned(folder, {});
}

} // namespace tonetool
