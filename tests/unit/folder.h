// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <OpenImageIO/filesystem.h>
#include <string>

namespace tonetool {

/// A folder that is gone with the test.
class Folder {
public:
    Folder() : m_path(OIIO::Filesystem::unique_path(testing::TempDir() + "tonetool-%%%%%%%%")) {
        OIIO::Filesystem::create_directory(m_path);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { OIIO::Filesystem::remove_all(m_path); }
    const std::string& path() const { return m_path; }
    std::string operator/(const std::string& name) const { return m_path + "/" + name; }

private:
    std::string m_path;
};

} // namespace tonetool
