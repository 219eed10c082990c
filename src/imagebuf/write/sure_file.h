// SPDX-License-Identifier: BSD-3-Clause
// The file of a writer that cannot cope with a failed write.
#pragma once

#include <cstdint>
#include <string>

#include "imagebuf/write/output_target.h"

namespace tonetool {

/// The tiled writer of EXR files of several parts (OpenEXR 3.1) waits for ever once a write has
/// failed, and opens its file by its name. Where the disk has no room for all that it may write,
/// and as much again (at most 4 GiB) for other programs, it is given a file in memory, which is
/// then copied.
class SureFile {
public:
    SureFile() = default;
    SureFile(const SureFile&) = delete;
    SureFile& operator=(const SureFile&) = delete;
    ~SureFile();

    /// For at most so many bytes.
    void open(const OutputTarget& target, int64_t bytes);
    const std::string& path() const { return m_path; }
    /// To the target, if it is not there already. A failure is the proxy's.
    void copy_to(CheckedProxy& proxy) const;

private:
    int m_memory = -1;
    std::string m_path;
};

} // namespace tonetool
