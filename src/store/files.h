// SPDX-License-Identifier: BSD-3-Clause
// Files of the store that are there whole or not at all.
#pragma once

#include <string>

namespace tonetool::store {

/// The whole text of a file; a runtime_error where it cannot be read.
std::string read_file(const std::string& file);

/// Writes a file beside its place, to the disk, and renames it. Throws a runtime_error; then what
/// was there before is there still.
void write_whole(const std::string& file, const std::string& text);

/// The same of a copy, whose SHA-256 must be that one.
void copy_whole(const std::string& from, const std::string& to, const std::string& sha256);

/// Removes a file that may not be there. What the system refuses is a runtime_error.
void remove_file(const std::string& file);

/// What the temporary files of the two are called: they begin so.
inline constexpr char kTemporary[] = ".tonetool-new.";

/// Holds the lock of a folder, which it waits for. The folder is made if it is missing.
class StoreLock {
public:
    explicit StoreLock(const std::string& folder);
    ~StoreLock();
    StoreLock(const StoreLock&) = delete;
    StoreLock& operator=(const StoreLock&) = delete;

private:
    int m_file;
};

} // namespace tonetool::store
