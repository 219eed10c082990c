// SPDX-License-Identifier: BSD-3-Clause
// The file that an output is written to, until it is whole.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <string>
#include <sys/stat.h>
#include <sys/types.h>

#include "tonetool/write.h"

namespace tonetool {

/// The descriptor a file is written through, and where it ends up: a temporary file beside the
/// target, or the device or pipe itself.
class OutputTarget {
public:
    explicit OutputTarget(const std::string& name, Links links = Links::Follow);
    OutputTarget(const OutputTarget&) = delete;
    OutputTarget& operator=(const OutputTarget&) = delete;
    ~OutputTarget();

    void open();
    /// Everything to the disk, then the new name in one step, then the folder to the disk.
    void commit();

    int fd() const { return m_fd; }
    bool is_device() const { return m_temporary.empty(); }
    /// What a writer is told to open: never the final name of a file.
    const std::string& path() const { return is_device() ? m_final : m_temporary; }

    /// A name beside the target that no other writer uses.
    std::string unused_name() const;

    /// What a writer said of the file it was given, said of the one that was asked for.
    std::string in_its_name(const std::string& error, const std::string& written) const;
    std::string in_its_name(const std::string& error) const { return in_its_name(error, path()); }

private:
    bool hold();
    void open_temporary();
    void take_rights(const struct stat& old);

    std::string m_name, m_final, m_temporary; // m_name: as it was asked for
    Links m_links;
    int m_fd = -1, m_slot = -1;
};

/// OpenImageIO's writers write through this. The first failure is kept and the writer is told that
/// all is well: the EXR writer (2.4) uses freed memory when it closes after a failed write.
class CheckedProxy final : public OIIO::Filesystem::IOProxy {
public:
    explicit CheckedProxy(const OutputTarget& target)
        : IOProxy(target.path(), Write),
          m_target(target) {}
    const char* proxytype() const override { return "tonetool"; }
    bool seek(int64_t offset) override;
    size_t write(const void* data, size_t size) override;
    size_t pwrite(const void* data, size_t size, int64_t offset) override;
    size_t size() const override { return size_t(m_size); }
    const std::string& failure() const { return m_failure; }
    void check() const; ///< throws the failure, if there is one

private:
    void note(const std::string& what);

    const OutputTarget& m_target;
    int64_t m_size = 0;
    std::string m_failure;
};

} // namespace tonetool
