// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/state.h"

#include <OpenImageIO/filesystem.h>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <map>
#include <stdexcept>
#include <thread>

namespace tonetool::sequence {
namespace {

namespace fs = std::filesystem;

class StateTest : public testing::Test {
protected:
    StateTest()
        : m_folder(OIIO::Filesystem::unique_path(testing::TempDir() + "state_test-%%%%%%%%")) {
        fs::remove_all(m_folder);
        fs::create_directories(m_folder);
        write("in.exr", "pixels");
    }
    ~StateTest() override { fs::remove_all(m_folder); }
    StateTest(const StateTest&) = delete;
    StateTest& operator=(const StateTest&) = delete;

    std::string path(const std::string& name) const { return (m_folder / name).string(); }
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(path(name)) << text;
    }
    Origin origin() const {
        return {{path("in.exr"), "--hdrflip:exposures='" + path("range.json") + "'", "-o",
                 path("out.exr")},
                ""};
    }
    FileLog opened(const std::string& name) const {
        FileLog log;
        log.note(path(name));
        return log;
    }
    std::string state_folder() const { return path("s"); }

    fs::path m_folder;
    Item m_item{7, ""};
    Kept m_kept{"{}", "printed\n", "", 3, {path("out.exr")}};
};

TEST_F(StateTest, WhatWasKeptIsFound) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    EXPECT_FALSE(state.find(m_item, origin()));
    state.keep(m_item, origin(), opened("in.exr"), m_kept);
    const auto found = state.find(m_item, origin());
    ASSERT_TRUE(found);
    EXPECT_EQ(found->out, "printed\n");
    EXPECT_EQ(found->status, 3);
    EXPECT_EQ(found->written, m_kept.written);
    EXPECT_FALSE(state.find({8, ""}, origin()));
    Origin other = origin();
    other.words.emplace_back("--pop");
    EXPECT_FALSE(state.find(m_item, other));
}

TEST_F(StateTest, EveryChangeOfAFileThatWasOpenedIsSeen) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    const std::map<std::string, std::function<void()>> changes{
        {"size", [&] { write("in.exr", "pixels!"); }},
        {"time",
         [&] {
             fs::last_write_time(path("in.exr"),
                                 fs::last_write_time(path("in.exr")) + std::chrono::seconds(1));
         }},
        {"content of the same size and time",
         [&] {
             const auto time = fs::last_write_time(path("in.exr"));
             write("in.exr", "PIXELS");
             fs::last_write_time(path("in.exr"), time);
         }},
        {"another file of the same size and time",
         [&] {
             write("other.exr", "PIXELS");
             fs::last_write_time(path("other.exr"), fs::last_write_time(path("in.exr")));
             fs::rename(path("other.exr"), path("in.exr"));
         }},
        {"gone", [&] { fs::remove(path("in.exr")); }}};
    for (const auto& [name, change] : changes) {
        write("in.exr", "pixels");
        state.keep(m_item, origin(), opened("in.exr"), m_kept);
        ASSERT_TRUE(state.find(m_item, origin())) << name;
        change();
        EXPECT_FALSE(state.find(m_item, origin())) << name;
    }
}

TEST_F(StateTest, AFileThatWasLookedForIsSeenWhenItComes) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    state.keep(m_item, origin(), opened("lights.json"), m_kept);
    ASSERT_TRUE(state.find(m_item, origin()));
    write("lights.json", "{}");
    EXPECT_FALSE(state.find(m_item, origin()));
}

TEST_F(StateTest, AFileWithParametersBehindItsNameIsThatFile) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    state.keep(m_item, origin(), opened("in.exr?shot=cornell"), m_kept);
    ASSERT_TRUE(state.find(m_item, origin()));
    write("in.exr", "pixels!");
    EXPECT_FALSE(state.find(m_item, origin()));
}

TEST_F(StateTest, WhatARecipeReadsCounts) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    write("shot.tone", "tonetool 1");
    write("deep.exr", "pixels");
    note_files_behind(path("shot.tone"), {path("shot.tone"), path("in.exr")});
    note_files_behind(path("in.exr"), {path("deep.exr")});
    std::this_thread::sleep_for(std::chrono::milliseconds(50)); // files older than the run
    state.keep(m_item, origin(), opened("shot.tone"), m_kept);
    ASSERT_TRUE(state.find(m_item, origin()));
    write("deep.exr", "pixels!");
    EXPECT_FALSE(state.find(m_item, origin()));
}

TEST_F(StateTest, TheLutsOfAConfigurationCount) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    write("show.ocio", R"(ocio_profile_version: 2
search_path: luts
roles: {default: raw}
displays:
  screen:
    - !<View> {name: graded, colorspace: graded}
colorspaces:
  - !<ColorSpace> {name: raw, isdata: true}
  - !<ColorSpace>
      name: graded
      from_scene_reference: !<GroupTransform>
        children:
          - !<FileTransform> {src: grade.spi1d}
)");
    fs::create_directories(path("luts"));
    write("luts/grade.spi1d", "Version 1");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    state.keep(m_item, origin(), opened("show.ocio"), m_kept);
    ASSERT_TRUE(state.find(m_item, origin()));
    write("luts/grade.spi1d", "Version 1 ");
    EXPECT_FALSE(state.find(m_item, origin()));
}

TEST_F(StateTest, AFileThatChangesDuringTheRunIsNotKept) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    const FileLog before = opened("in.exr");
    write("in.exr", "pixels!");
    state.keep(m_item, origin(), before, m_kept);
    EXPECT_FALSE(state.find(m_item, origin()));
}

TEST_F(StateTest, AnOutputThatIsGoneOrChangedIsMadeAgain) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    state.keep(m_item, origin(), opened("in.exr"), m_kept);
    ASSERT_TRUE(state.find(m_item, origin()));
    write("out.exr", "another");
    EXPECT_FALSE(state.find(m_item, origin()));
    write("out.exr", "result");
    state.keep(m_item, origin(), opened("in.exr"), m_kept);
    fs::remove(path("out.exr"));
    EXPECT_FALSE(state.find(m_item, origin()));
}

TEST_F(StateTest, PlantedLinksAreNotFollowed) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    state.keep(m_item, origin(), opened("in.exr"), m_kept);
    fs::rename(state.file(m_item), path("elsewhere.json"));
    fs::create_symlink(path("elsewhere.json"), state.file(m_item));
    EXPECT_FALSE(state.find(m_item, origin()));
    const auto size = fs::file_size(path("elsewhere.json"));
    m_kept.out = "more than was printed before";
    EXPECT_THROW(state.keep(m_item, origin(), opened("in.exr"), m_kept), std::runtime_error);
    EXPECT_EQ(fs::file_size(path("elsewhere.json")), size);
    fs::remove(state.file(m_item));
    fs::create_symlink(path("nowhere.json"), state.file(m_item));
    EXPECT_THROW(state.keep(m_item, origin(), opened("in.exr"), m_kept), std::runtime_error);
    EXPECT_FALSE(fs::exists(path("nowhere.json")));
}

TEST_F(StateTest, AFolderThatCannotBeWrittenIsSaid) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    fs::remove_all(state_folder());
    EXPECT_THROW(state.keep(m_item, origin(), opened("in.exr"), m_kept), std::runtime_error);
}

TEST_F(StateTest, NamesStayInTheFolder) {
    const State state(state_folder(), "frame");
    EXPECT_EQ(state.file({7, "../../x"}), state_folder() + "/frame.0007.%2E%2E%2F%2E%2E%2Fx.json");
    EXPECT_NE(state.file({7, "a"}), state.file({7, "A"}));
}

TEST_F(StateTest, AFileIsNoFolder) {
    EXPECT_THROW(State(path("in.exr"), "frame"), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
