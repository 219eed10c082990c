// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/write/output_target.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

#include "imagebuf/write/abandoned.h"
#include "imagebuf/write/temporary_names.h"
#include "metrics/refusal.h"
#include "tonetool/write.h"

namespace tonetool {
namespace {

// Temporary files now being written, for a signal handler: fixed storage, no locks.
constexpr int kMaxUnfinished = 64;
struct Unfinished {
    std::atomic<bool> used{false}, ready{false};
    char path[PATH_MAX]{};
};
Unfinished g_unfinished[kMaxUnfinished];

int remember(const std::string& path) {
    for (int i = 0; i < kMaxUnfinished && path.size() < PATH_MAX; ++i)
        if (!g_unfinished[i].used.exchange(true)) {
            std::memcpy(g_unfinished[i].path, path.c_str(), path.size() + 1);
            g_unfinished[i].ready = true;
            return i;
        }
    return -1;
}

void forget(int slot) {
    if (slot < 0)
        return;
    g_unfinished[slot].ready = false;
    g_unfinished[slot].used = false;
}

std::string reason() {
    return std::strerror(errno);
}

/// The file behind a name: symbolic links followed, also one that points to nothing yet.
std::string resolve(const std::string& name) {
    std::string path = name;
    for (int hops = 0; hops < 40; ++hops) {
        char target[PATH_MAX];
        const ssize_t n = ::readlink(path.c_str(), target, sizeof target - 1);
        if (n < 0)
            break;
        const std::string to(target, size_t(n));
        const auto slash = path.rfind('/');
        path = to[0] == '/' || slash == std::string::npos ? to : path.substr(0, slash + 1) + to;
    }
    return path;
}

// So that the new name outlives a crash of the machine. Not all file systems know how to.
void sync_folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
    const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0)
        return;
    ::fsync(fd);
    ::close(fd);
}

} // namespace

OutputTarget::OutputTarget(const std::string& name, Links links)
    : m_name(name),
      m_final(links == Links::Follow ? resolve(name) : name),
      m_links(links) {}

OutputTarget::~OutputTarget() {
    if (m_fd >= 0)
        ::close(m_fd);
    if (!m_temporary.empty())
        ::unlink(m_temporary.c_str());
    forget(m_slot);
}

void OutputTarget::open() {
    struct stat info {};
    const bool exists = ::lstat(m_final.c_str(), &info) == 0;
    if (exists && S_ISLNK(info.st_mode))
        throw Refusal(m_links == Links::Refuse ? "is a symbolic link, which is not followed here"
                                               : "is a circle of symbolic links");
    if (exists && S_ISDIR(info.st_mode))
        throw Refusal("is a directory");
    if (exists && !S_ISREG(info.st_mode)) {
        m_fd = ::open(m_final.c_str(), O_WRONLY | O_CLOEXEC);
        if (m_fd < 0)
            throw Refusal(reason());
        return;
    }
    if (exists && ::access(m_final.c_str(), W_OK) != 0)
        throw Refusal(reason());
    remove_abandoned_once(m_final);
    open_temporary();
    if (exists)
        take_rights(info);
}

// A replaced file keeps its rights, and its owner and group where this user may give it to them; a
// new one has 0666 less the umask.
void OutputTarget::take_rights(const struct stat& old) {
    struct stat own {};
    const bool same =
        ::fstat(m_fd, &own) == 0 && own.st_uid == old.st_uid && own.st_gid == old.st_gid;
    const bool given = same || ::fchown(m_fd, old.st_uid, old.st_gid) == 0 ||
                       ::fchown(m_fd, uid_t(-1), old.st_gid) == 0;
    (void)given; // where that is not allowed it is this user's
    if (::fchmod(m_fd, old.st_mode & 0777) != 0)
        throw Refusal(reason());
}

std::string OutputTarget::in_its_name(const std::string& error, const std::string& written) const {
    return OIIO::Strutil::replace(error, written, m_name, true);
}

void OutputTarget::commit() {
    const bool regular = !m_temporary.empty();
    if (regular && ::fsync(m_fd) != 0)
        throw Refusal(reason());
    // A network file system may tell only now that it could not write. The second descriptor holds
    // the lock until the file has its name: without it a file that is whole looks abandoned.
    const int locked = regular ? ::fcntl(m_fd, F_DUPFD_CLOEXEC, 0) : -1;
    const int closed = ::close(std::exchange(m_fd, locked));
    if (closed != 0 || (regular && ::rename(m_temporary.c_str(), m_final.c_str()) != 0))
        throw Refusal(reason());
    m_temporary.clear();
    if (m_fd >= 0)
        ::close(std::exchange(m_fd, -1));
    if (regular)
        sync_folder_of(m_final);
}

// Tells who removes what killed writers left that somebody still writes. False where that was
// quicker and has removed the file, or is about to; a file system without locks is none of its
// business.
bool OutputTarget::hold() {
    struct stat info {};
    const bool taken = ::flock(m_fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!taken && (::fstat(m_fd, &info) != 0 || info.st_nlink > 0))
        return true;
    ::unlink(m_temporary.c_str());
    ::close(m_fd);
    return false;
}

std::string OutputTarget::unused_name() const {
    static std::atomic<unsigned> counter{0};
    const auto slash = m_final.rfind('/');
    const size_t begin = slash == std::string::npos ? 0 : slash + 1;
    return m_final.substr(0, begin) + temporary_name(m_final.substr(begin), ::getpid(), counter++);
}

void OutputTarget::open_temporary() {
    for (int attempt = 0; attempt < 100 && m_fd < 0; ++attempt) {
        m_temporary = unused_name();
        m_fd = ::open(m_temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (m_fd < 0 && errno != EEXIST)
            break;
        if (m_fd < 0)
            continue;
        m_slot = remember(m_temporary); // at once: a signal leaves no file behind
        if (!hold()) {
            m_fd = -1;
            forget(std::exchange(m_slot, -1));
        }
    }
    if (m_fd < 0) {
        m_temporary.clear();
        const auto slash = m_final.rfind('/');
        throw Refusal("cannot create a file in \"" +
                      (slash == std::string::npos ? "." : m_final.substr(0, slash + 1)) +
                      "\": " + reason());
    }
}

bool CheckedProxy::seek(int64_t offset) {
    if (m_target.is_device() && offset != m_pos)
        note("cannot seek in a device or pipe");
    m_pos = offset;
    return true;
}

size_t CheckedProxy::write(const void* data, size_t size) {
    pwrite(data, size, m_pos);
    m_pos += int64_t(size);
    return size;
}

size_t CheckedProxy::pwrite(const void* data, size_t size, int64_t offset) {
    for (size_t done = 0; done < size && m_failure.empty();) {
        const char* from = static_cast<const char*>(data) + done;
        const ssize_t n = m_target.is_device()
                              ? ::write(m_target.fd(), from, size - done)
                              : ::pwrite(m_target.fd(), from, size - done, offset + int64_t(done));
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            note(n < 0 ? reason() : "nothing could be written");
        else
            done += size_t(n);
    }
    m_size = std::max(m_size, offset + int64_t(size));
    return size;
}

void CheckedProxy::check() const {
    if (!m_failure.empty())
        throw Refusal(m_failure);
}

void CheckedProxy::note(const std::string& what) {
    if (m_failure.empty())
        m_failure = what;
}

void remove_unfinished_outputs() noexcept {
    for (Unfinished& entry : g_unfinished)
        if (entry.ready)
            ::unlink(entry.path);
}

} // namespace tonetool
