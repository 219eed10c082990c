// What writers that were killed have left behind.
#include <OpenImageIO/filesystem.h>
#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <set>
#include <sys/file.h>
#include <unistd.h>

#include "imagebuf/temporary_names.h"
#include "include/tonetool/write.h"

namespace tonetool {
namespace {

namespace fs = std::filesystem;

// A writer holds a lock on its file as long as it lives, on whatever machine.
void remove_if_unlocked(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (fd < 0)
        return;
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0)
        ::unlink(path.c_str());
    ::close(fd);
}

} // namespace

void remove_abandoned_outputs(const std::vector<std::string>& filenames) {
    std::map<fs::path, std::set<std::string>> bases;
    for (const std::string& filename : filenames) {
        const fs::path path(filename);
        bases[path.has_parent_path() ? path.parent_path() : "."].insert(path.filename().string());
    }
    for (const auto& [folder, names] : bases) {
        std::error_code why;
        for (fs::directory_iterator entry(folder, why), end; !why && entry != end;
             entry.increment(why)) {
            // ".BASE.1-2.exr": BASE is all but the ends, so that one look-up tells.
            const std::string name = entry->path().filename().string();
            const size_t numbers = name.rfind('-');
            const size_t dot = numbers == std::string::npos ? numbers : name.rfind('.', numbers);
            if (dot == std::string::npos || dot < 2)
                continue;
            const std::string base = name.substr(1, dot - 1);
            if (names.count(base) > 0 && is_temporary_of(name, base))
                remove_if_unlocked(entry->path().string());
        }
    }
}

} // namespace tonetool
