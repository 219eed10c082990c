// SPDX-License-Identifier: BSD-3-Clause
#include <OpenImageIO/filesystem.h>
#include <atomic>
#include <chrono>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "imagebuf/write/temporary_names.h"
#include "tonetool/write.h"

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

TEST_F(Abandoned, WhatMakeTextureOpensGoesToo) {
    const std::string with = make(".a.tx.4711-0-89abcdef.0f1e2d3c.temp.tx");
    const std::string without = make(".a.4711-0-89abcdef.0f1e2d3c.temp");
    const std::string others = make(".a.tx.0f1e2d3c.temp.tx"), short_name = make(".temp");
    fs::last_write_time(with, fs::file_time_type::clock::now() - std::chrono::hours(2));
    fs::last_write_time(without, fs::file_time_type::clock::now() - std::chrono::hours(2));
    remove_abandoned_outputs({(m_folder / "a.tx").string(), (m_folder / "a").string()});
    EXPECT_FALSE(fs::exists(with));
    EXPECT_FALSE(fs::exists(without));
    EXPECT_TRUE(fs::exists(others));
    EXPECT_TRUE(fs::exists(short_name));
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

TEST_F(Abandoned, TheNextWriteToTheFolderClearsThemAll) {
    const std::string own = make(temporary_name("a.exr", 4711, 12));
    const std::string other = make(temporary_name("b.0001.png", 4712, 0));
    const std::string plain = make(temporary_name("plain", 4712, 7));
    const std::string written = make(temporary_name("c.exr", 1, 0));
    const std::string elsewhere = make(temporary_name("d.exr", 4711, 12, "00000000"));
    const std::string left = make(temporary_name("e.exr", 4711, 12, "00000000"));
    fs::last_write_time(left, fs::file_time_type::clock::now() - std::chrono::hours(2));
    const std::string user = make(".notes.txt.1-2.txt"), hidden = make(".cache");
    const int fd = ::open(written.c_str(), O_RDWR);
    ASSERT_EQ(::flock(fd, LOCK_EX | LOCK_NB), 0);
    std::string error;
    EXPECT_TRUE(write_bytes("x", (m_folder / "new.txt").string(), error)) << error;
    ::close(fd);
    for (const std::string& gone : {own, other, plain, left})
        EXPECT_FALSE(fs::exists(gone)) << gone;
    for (const std::string& there : {written, elsewhere, user, hidden})
        EXPECT_TRUE(fs::exists(there)) << there;
}

// A file is held until it has its name: two programs begin to write to one folder at any moment.
TEST_F(Abandoned, WhatIsBeingRenamedStays) {
    const std::string target = (m_folder / "a.json").string();
    std::atomic<bool> done{false};
    std::thread other([&] {
        while (!done)
            remove_abandoned_outputs({target});
    });
    int failed = 0;
    std::string error;
    for (int i = 0; i < 300; ++i)
        failed += write_bytes("x", target, error) ? 0 : 1;
    done = true;
    other.join();
    EXPECT_EQ(failed, 0) << error;
}

TEST_F(Abandoned, LinksAndPipesOfSuchNamesAreNoMatter) {
    const std::string target = make("target.exr");
    fs::create_symlink("target.exr", m_folder / temporary_name("a.exr", 4711, 12));
    const std::string pipe = (m_folder / temporary_name("b.exr", 4711, 12)).string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    remove_abandoned_outputs({(m_folder / "a.exr").string(), (m_folder / "b.exr").string()});
    EXPECT_TRUE(fs::exists(target));
    EXPECT_TRUE(fs::exists(pipe));
}

TEST(TemporaryNames, AreToldFromOthers) {
    EXPECT_EQ(parse_temporary_name(temporary_name("a-1.exr", 12, 3)).base, "a-1.exr");
    EXPECT_EQ(parse_temporary_name(temporary_name("a.1-2.exr", 12, 3)).base, "a.1-2.exr");
    EXPECT_EQ(parse_temporary_name(temporary_name("noextension", 12, 3)).base, "noextension");
    EXPECT_EQ(parse_temporary_name(temporary_name("a.exr", 1, 2, "00000000")).machine, "00000000");
    for (const char* name :
         {".a.exr", ".a.exr.12.exr", ".a.exr.12-3.exr", ".a.exr.12-3-89abcdef.png", ".exr", "",
          ".a.exr.12--89abcdef.exr", ".a.exr.1x-3-89abcdef.exr", "a.exr.12-3-89abcdef.exr",
          ".a.exr.12-3-89ABCDEF.exr", "..12-3-89abcdef", ".12-3-89abcdef", ".config.2024-10-21"})
        EXPECT_EQ(parse_temporary_name(name).base, "") << name;
}

} // namespace
} // namespace tonetool
