// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/write/sure_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <unistd.h>
#include <vector>

#include "metrics/refusal.h"

namespace tonetool {
namespace {

// Whether the disk has room, which quotas and limits of file sizes have a say in, too. To ask takes
// the room for a moment, in which other programs must find some.
bool has_room(int fd, int64_t bytes) {
    constexpr int64_t left_to_others = int64_t(4) << 30;
    struct statvfs disk {};
    if (::fstatvfs(fd, &disk) != 0 || double(disk.f_bavail) * double(disk.f_frsize) <
                                          double(bytes + std::min(bytes, left_to_others)))
        return false;
    const bool fits = ::fallocate(fd, 0, 0, bytes) == 0;
    return ::ftruncate(fd, 0) == 0 && fits;
}

bool is_limited(int64_t bytes) {
    struct rlimit limit {};
    return ::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
           limit.rlim_cur < rlim_t(bytes);
}

} // namespace

SureFile::~SureFile() {
    if (m_memory >= 0)
        ::close(m_memory);
}

void SureFile::open(const OutputTarget& target, int64_t bytes) {
    if (has_room(target.fd(), bytes)) {
        m_path = target.path();
        return;
    }
    if (is_limited(bytes))
        throw Refusal("there may be more bytes than a file may have (ulimit -f)");
    m_memory = ::memfd_create("tonetool", MFD_CLOEXEC);
    if (m_memory < 0)
        throw Refusal(std::string("cannot create a file in memory: ") + std::strerror(errno));
    m_path = "/proc/self/fd/" + std::to_string(m_memory);
}

void SureFile::copy_to(CheckedProxy& proxy) const {
    std::vector<char> piece(m_memory >= 0 ? 1 << 20 : 0);
    ssize_t n = 0;
    for (int64_t at = 0; m_memory >= 0 && proxy.failure().empty(); at += n) {
        n = ::pread(m_memory, piece.data(), piece.size(), at);
        if (n <= 0)
            break;
        proxy.pwrite(piece.data(), size_t(n), at);
    }
}

} // namespace tonetool
