#include "recipe/stamp.h"

#include <algorithm>
#include <chrono>
#include <sys/stat.h>

namespace tonetool::recipe {

namespace {

int64_t nanoseconds(const timespec& time) {
    return int64_t(time.tv_sec) * 1000000000 + time.tv_nsec;
}

// File systems tell times of a tick of the kernel's clock, up to 10 ms.
constexpr int64_t tick = 20000000;

} // namespace

Stamp stamp_of(const std::string& file) {
    struct stat found {};
    Stamp stamp{file};
    if (stat(file.c_str(), &found) == 0) {
        stamp.written = nanoseconds(found.st_mtim);
        stamp.changed = nanoseconds(found.st_ctim);
        stamp.size = uint64_t(found.st_size);
        stamp.inode = uint64_t(found.st_ino);
    }
    return stamp;
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
        return std::max(stamp.written, stamp.changed) < time - tick;
    });
}

} // namespace tonetool::recipe
