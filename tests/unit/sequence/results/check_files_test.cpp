// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/check_files.h"

#include <OpenImageIO/filesystem.h>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "imagebuf/write/temporary_names.h"

namespace tonetool::sequence {
namespace {

namespace fs = std::filesystem;

class TryFolder : public testing::Test {
protected:
    TryFolder()
        : m_folder(OIIO::Filesystem::unique_path(testing::TempDir() + "check_files-%%%%%%%%")) {
        fs::create_directories(m_folder);
    }
    ~TryFolder() override { fs::remove_all(m_folder); }
    TryFolder(const TryFolder&) = delete;
    TryFolder& operator=(const TryFolder&) = delete;

    fs::path m_folder;
};

TEST_F(TryFolder, RemovesWhatAKilledTryLeft) {
    std::ofstream(m_folder / temporary_name("tonetool-try", 4711, 0)) << "";
    std::ofstream(m_folder / ".of_others") << "";
    try_folder(m_folder.string(), "--json: ");
    EXPECT_TRUE(fs::exists(m_folder / ".of_others"));
    fs::remove(m_folder / ".of_others");
    EXPECT_TRUE(fs::is_empty(m_folder));
}

TEST_F(TryFolder, WhateverTheMomentItIsKilledAtTheNextOneLeavesNothing) {
    for (int turn = 0; turn < 30; ++turn) {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0)
            for (;;)
                try_folder(m_folder.string(), "--json: ");
        ::usleep(useconds_t(500 + 137 * turn));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        try_folder(m_folder.string(), "--json: ");
        EXPECT_TRUE(fs::is_empty(m_folder)) << "turn " << turn;
    }
}

} // namespace
} // namespace tonetool::sequence
