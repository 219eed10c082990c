// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/write/sure_file.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <sys/statvfs.h>

#include "folder.h"

using tonetool::Folder;
using tonetool::OutputTarget;
using tonetool::SureFile;

namespace {

double free_bytes(const std::string& path) {
    struct statvfs disk {};
    EXPECT_EQ(::statvfs(path.c_str(), &disk), 0);
    return double(disk.f_bavail) * double(disk.f_frsize);
}

class SureFileTest : public testing::Test {
protected:
    SureFileTest() : m_target(m_folder / "x.exr") { m_target.open(); }

    const Folder m_folder;
    OutputTarget m_target;
};

TEST_F(SureFileTest, IsTheTargetWhereTheDiskHasRoom) {
    SureFile file;
    file.open(m_target, 1 << 20);
    EXPECT_EQ(file.path(), m_target.path());
    struct stat now {};
    ASSERT_EQ(::fstat(m_target.fd(), &now), 0);
    EXPECT_EQ(now.st_size, 0);
    EXPECT_EQ(now.st_blocks, 0) << "room is kept";
}

// A header can claim anything: to ask for all that is free would fill the disk for a moment.
TEST_F(SureFileTest, LeavesRoomToOtherPrograms) {
    const double room = free_bytes(m_folder / ".");
    for (double bytes : {room - std::min(room / 10, 1e9), 2 * room, 1e18}) {
        SureFile file;
        file.open(m_target, int64_t(bytes));
        EXPECT_THAT(file.path(), testing::StartsWith("/proc/self/fd/")) << bytes;
    }
}

} // namespace
