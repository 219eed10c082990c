// SPDX-License-Identifier: BSD-3-Clause
#include "store/files.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

#include "store/sha256.h"

namespace tonetool::store {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& what, const std::string& file, int number) {
    throw std::runtime_error("cannot " + what + " \"" + file + "\": " + std::strerror(number));
}

void to_disk(const std::string& folder) {
    const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0)
        fail("open the folder", folder, errno);
    const bool synced =
        ::fsync(opened) == 0 || errno == EINVAL; // some file systems have no such call
    const int number = errno;
    ::close(opened);
    if (!synced)
        fail("write the folder", folder, number);
}

// A file that has its name only when it is whole.
class NewFile {
public:
    explicit NewFile(const std::string& file) : m_final(file) {
        const fs::path folder = fs::path(file).parent_path();
        m_folder = folder.empty() ? "." : folder.string();
        fs::create_directories(m_folder);
        static std::atomic<unsigned> count{0};
        do {
            m_name = m_folder + "/" + kTemporary + std::to_string(::getpid()) + "-" +
                     std::to_string(count++);
            m_file = ::open(m_name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        } while (m_file < 0 && errno == EEXIST); // of a process of that number before
        if (m_file < 0)
            fail("write", file, errno);
    }
    ~NewFile() {
        if (m_file >= 0)
            ::close(m_file);
        if (!m_done && !m_name.empty())
            ::unlink(m_name.c_str());
    }
    NewFile(const NewFile&) = delete;
    NewFile& operator=(const NewFile&) = delete;

    void add(const char* bytes, size_t count) {
        while (count > 0) {
            const ssize_t written = ::write(m_file, bytes, count);
            if (written < 0 && errno == EINTR)
                continue;
            if (written <= 0)
                fail("write", m_final, errno);
            bytes += written;
            count -= size_t(written);
        }
    }

    void finish() {
        if (::fsync(m_file) != 0)
            fail("write", m_final, errno);
        const int closed = ::close(m_file);
        m_file = -1;
        if (closed != 0 || ::rename(m_name.c_str(), m_final.c_str()) != 0)
            fail("write", m_final, errno);
        m_done = true;
        to_disk(m_folder);
    }

private:
    std::string m_final, m_folder, m_name;
    int m_file = -1;
    bool m_done = false;
};

} // namespace

std::string read_file(const std::string& file) {
    std::error_code none;
    if (fs::is_directory(file, none))
        fail("read", file, EISDIR);
    std::ifstream from(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(from), {}};
    if (!from)
        fail("read", file, errno);
    return text;
}

void write_whole(const std::string& file, const std::string& text) {
    NewFile made(file);
    made.add(text.data(), text.size());
    made.finish();
}

void copy_whole(const std::string& from, const std::string& to, const std::string& sha256) {
    std::ifstream source(from, std::ios::binary);
    if (!source)
        fail("read", from, errno);
    NewFile made(to);
    Sha256 hash;
    std::vector<char> bytes(size_t(1) << 18);
    while (source) {
        source.read(bytes.data(), std::streamsize(bytes.size()));
        const auto count = size_t(source.gcount());
        hash.add(bytes.data(), count);
        made.add(bytes.data(), count);
    }
    if (!source.eof())
        fail("read", from, errno);
    if (hash.digits() != sha256)
        throw std::runtime_error("\"" + from + "\" has changed since the run that was looked at");
    made.finish();
}

void remove_file(const std::string& file) {
    if (::unlink(file.c_str()) != 0 && errno != ENOENT)
        fail("remove", file, errno);
}

StoreLock::StoreLock(const std::string& folder) {
    fs::create_directories(folder);
    const std::string file = folder + "/.tonetool.lock";
    m_file = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    while (m_file >= 0 && ::flock(m_file, LOCK_EX) != 0) {
        if (errno != EINTR) {
            const int number = errno;
            ::close(m_file);
            fail("lock", file, number);
        }
    }
    if (m_file < 0)
        fail("lock", file, errno);
}

StoreLock::~StoreLock() {
    ::close(m_file); // which gives the lock back
}

} // namespace tonetool::store
