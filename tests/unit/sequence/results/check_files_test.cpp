// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/check_files.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "folder.h"
#include "imagebuf/write/temporary_names.h"

namespace tonetool::sequence {
namespace {

namespace fs = std::filesystem;

TEST(TryFolder, RemovesWhatAKilledTryLeft) {
    const Folder folder;
    std::ofstream(folder / temporary_name("tonetool-try", 4711, 0)) << "";
    std::ofstream(folder / ".of_others") << "";
    try_folder(folder.path(), "--json: ");
    EXPECT_TRUE(fs::exists(folder / ".of_others"));
    fs::remove(folder / ".of_others");
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(TryFolder, WhateverTheMomentItIsKilledAtTheNextOneLeavesNothing) {
    const Folder folder;
    for (int turn = 0; turn < 30; ++turn) {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0)
            for (;;)
                try_folder(folder.path(), "--json: ");
        ::usleep(useconds_t(500 + 137 * turn));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        try_folder(folder.path(), "--json: ");
        EXPECT_TRUE(fs::is_empty(folder.path())) << "turn " << turn;
    }
}

} // namespace
} // namespace tonetool::sequence
