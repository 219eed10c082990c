#include <OpenImageIO/filesystem.h>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/file.h>
#include <unistd.h>

#include "imagebuf/temporary_names.h"
#include "include/tonetool/write.h"

namespace tonetool {
namespace {

namespace fs = std::filesystem;

class Abandoned : public testing::Test {
protected:
    Abandoned()
        : m_folder(OIIO::Filesystem::unique_path(testing::TempDir() + "abandoned_test-%%%%%%%%")) {
        fs::remove_all(m_folder);
        fs::create_directories(m_folder);
    }
    ~Abandoned() override { fs::remove_all(m_folder); }
    Abandoned(const Abandoned&) = delete;
    Abandoned& operator=(const Abandoned&) = delete;

    std::string make(const std::string& name) const {
        const std::string path = (m_folder / name).string();
        std::ofstream(path) << "half";
        return path;
    }

    fs::path m_folder;
};

TEST_F(Abandoned, HalfWrittenFilesOfTheTargetsGoAndNoOthers) {
    const std::string own = make(temporary_name("check.json", 4711, 12));
    const std::string plain = make(temporary_name("check", 4711, 12));
    const std::string others = make(temporary_name("other.json", 4711, 12));
    const std::string target = make("check.json"), hidden = make(".check.json");
    remove_abandoned_outputs({target, (m_folder / "check").string()});
    EXPECT_FALSE(fs::exists(own));
    EXPECT_FALSE(fs::exists(plain));
    EXPECT_TRUE(fs::exists(others));
    EXPECT_TRUE(fs::exists(target));
    EXPECT_TRUE(fs::exists(hidden));
}

TEST_F(Abandoned, WhatIsStillWrittenStays) {
    const std::string file = make(temporary_name("a.exr", 1, 0));
    const int fd = ::open(file.c_str(), O_RDWR);
    ASSERT_EQ(::flock(fd, LOCK_EX | LOCK_NB), 0);
    remove_abandoned_outputs({(m_folder / "a.exr").string()});
    EXPECT_TRUE(fs::exists(file));
    ::close(fd);
    remove_abandoned_outputs({(m_folder / "a.exr").string()});
    EXPECT_FALSE(fs::exists(file));
}

TEST_F(Abandoned, FoldersThatAreNotThereAreNoMatter) {
    remove_abandoned_outputs({"/no/such/folder/a.exr", "a_name_alone.exr"});
}

TEST(TemporaryNames, AreToldFromOthers) {
    EXPECT_TRUE(is_temporary_of(temporary_name("a-1.exr", 12, 3), "a-1.exr"));
    EXPECT_TRUE(is_temporary_of(temporary_name("noextension", 12, 3), "noextension"));
    for (const char* name : {".a.exr", ".a.exr.12.exr", ".a.exr.12-.exr", ".a.exr.-3.exr",
                             ".a.exr.1x-3.exr", "a.exr.12-3.exr", ".a.exr.12-3.png", ".exr"})
        EXPECT_FALSE(is_temporary_of(name, "a.exr")) << name;
}

} // namespace
} // namespace tonetool
