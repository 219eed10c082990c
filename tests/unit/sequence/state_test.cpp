#include "sequence/state.h"

#include <OpenImageIO/filesystem.h>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>

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
                "",
                {path("out.exr")}};
    }
    std::string state_folder() const { return path("s"); }

    fs::path m_folder;
    Item m_item{7, ""};
    Kept m_kept{"{}", "printed\n", "", 3};
};

TEST_F(StateTest, What_was_kept_is_found) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    const std::string key = State::key(origin());
    EXPECT_FALSE(state.find(m_item, key));
    state.keep(m_item, key, origin(), m_kept);
    const auto found = state.find(m_item, State::key(origin()));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->out, "printed\n");
    EXPECT_EQ(found->status, 3);
    EXPECT_FALSE(state.find({8, ""}, key));
}

TEST_F(StateTest, An_input_of_another_size_or_time_is_another) {
    const std::string before = State::key(origin());
    write("in.exr", "pixels!");
    const std::string after = State::key(origin());
    EXPECT_NE(after, before);
    fs::last_write_time(path("in.exr"),
                        fs::last_write_time(path("in.exr")) + std::chrono::seconds(1));
    EXPECT_NE(State::key(origin()), after);
}

TEST_F(StateTest, Files_of_modifiers_count_and_outputs_do_not) {
    const std::string before = State::key(origin());
    write("out.exr", "result");
    EXPECT_EQ(State::key(origin()), before);
    write("range.json", "{}");
    EXPECT_NE(State::key(origin()), before);
}

TEST_F(StateTest, An_output_that_is_gone_is_made_again) {
    const State state(state_folder(), "frame");
    write("out.exr", "result");
    const std::string key = State::key(origin());
    state.keep(m_item, key, origin(), m_kept);
    fs::remove(path("out.exr"));
    EXPECT_FALSE(state.find(m_item, key));
}

TEST_F(StateTest, Names_stay_in_the_folder) {
    const State state(state_folder(), "frame");
    EXPECT_EQ(state.file({7, "../../x"}), state_folder() + "/frame.0007.%2E%2E%2F%2E%2E%2Fx.json");
    EXPECT_NE(state.file({7, "a"}), state.file({7, "A"}));
}

TEST_F(StateTest, A_file_is_no_folder) {
    EXPECT_THROW(State(path("in.exr"), "frame"), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
