// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/file_sequence.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <stdexcept>

namespace tonetool::sequence {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class OnDisk : public testing::Test {
protected:
    void SetUp() override {
        m_folder = fs::path(testing::TempDir()) /
                   testing::UnitTest::GetInstance()->current_test_info()->name();
        fs::remove_all(m_folder);
        fs::create_directories(m_folder);
    }
    void TearDown() override { fs::remove_all(m_folder); }

    Files listed(const std::string& pattern, const std::vector<std::string>& files,
                 const PatternOptions& options = {}) {
        for (const std::string& file : files) {
            fs::create_directories((m_folder / file).parent_path());
            std::ofstream(m_folder / file).put('x');
        }
        Files found = list_files((m_folder / pattern).string(), options);
        for (std::string& name : found.names)
            name.erase(0, m_folder.string().size() + 1);
        return found;
    }
    static std::string refusal_of(const Files& files) {
        try {
            check_numbers("x.#", files);
        } catch (const std::runtime_error& problem) {
            return problem.what();
        }
        return "";
    }

    fs::path m_folder;
};

TEST_F(OnDisk, SortedByNumberWithNegativeOnes) {
    const Files found = listed("a.#.exr", {"a.0010.exr", "a.-002.exr", "a.-0001.exr", "a.0000.exr",
                                           "b.0001.exr", "a.0003.tif", "a_0004.exr"});
    EXPECT_THAT(found.names, ElementsAre("a.-002.exr", "a.-0001.exr", "a.0000.exr", "a.0010.exr"));
    EXPECT_THAT(found.items, ElementsAre(Item{-2, ""}, Item{-1, ""}, Item{0, ""}, Item{10, ""}));
    EXPECT_TRUE(found.from_disk);
    EXPECT_EQ(refusal_of(found), "");
}

TEST_F(OnDisk, LenientlyWithoutNegativeOnesAsOiiotool) {
    PatternOptions options;
    options.lenient = true;
    EXPECT_THAT(listed("a.%04d.exr", {"a.-002.exr", "a.0001.exr"}, options).names,
                ElementsAre("a.0001.exr"));
}

TEST_F(OnDisk, ViewsAlsoAsFolders) {
    const Files found = listed("%V/a.%v.@.exr", {"left/a.l.1.exr", "right/a.r.1.exr",
                                                 "right/a.l.2.exr", "lef+/a.l.1.exr"});
    EXPECT_THAT(found.items, ElementsAre(Item{1, "left"}, Item{1, "right"}));
    EXPECT_THAT(found.names, ElementsAre("left/a.l.1.exr", "right/a.r.1.exr"));
}

TEST_F(OnDisk, NamesThatDoNotTellFramesApartAreRefused) {
    EXPECT_THAT(refusal_of(listed("d.@.exr", {"d.0001.exr", "d.1.exr"})),
                HasSubstr("are both frame 1"));
    EXPECT_THAT(refusal_of(listed("n.#.exr", {"n.-001.exr", "n.-0001.exr"})),
                HasSubstr("are both frame -1"));
    EXPECT_THAT(refusal_of(listed("e.#.exr", {"e.0001.exr", "e.2.exr"})),
                HasSubstr("e.2.exr\" has fewer digits"));
    EXPECT_THAT(refusal_of(listed("v.#.exr", {"v.20261128123456.exr"})),
                HasSubstr("beyond 2147483647"));
    EXPECT_EQ(refusal_of(listed("s.%V.exr", {"s.left.exr", "s.right.exr"})), "");
}

TEST_F(OnDisk, ARangeHidesNoSecondFileOfItsNumbers) {
    listed("d.@.exr", {"d.0001.exr", "d.1.exr", "d.2.exr", "n.0003.exr", "n.3.exr"});
    const auto refusal = [&](const std::string& name, const std::string& frames) {
        PatternOptions options;
        options.frames = frames;
        const std::string pattern = (m_folder / name).string();
        try {
            check_numbers(pattern, list_files(pattern, options), options);
        } catch (const std::runtime_error& problem) {
            return std::string(problem.what());
        }
        return std::string();
    };
    EXPECT_THAT(refusal("d.@.exr", "1-2"), HasSubstr("are both frame 1"));
    EXPECT_THAT(refusal("d.1-2@.exr", ""), HasSubstr("are both frame 1"));
    EXPECT_EQ(refusal("d.@.exr", "2-9"), "");
    EXPECT_EQ(refusal("n.#.exr", "3"), ""); // four digits are meant
}

TEST_F(OnDisk, NothingWhereNothingIs) {
    EXPECT_THAT(listed("a.#.exr", {}).names, IsEmpty());
    EXPECT_THAT(listed("none/a.#.exr", {}).names, IsEmpty());
    EXPECT_THAT(listed("shot.#/a.exr", {"shot.0000/a.exr"}).names, IsEmpty());
}

TEST_F(OnDisk, InputsOfARangeHaveEitherFormOfANegativeNumber) {
    listed("a.#.exr", {"a.-0002.exr"});
    const std::string start = m_folder.string() + "/a.";
    EXPECT_THAT(input_names(start + "#.exr", {}, {{-2, ""}, {-1, ""}}),
                ElementsAre(start + "-0002.exr", start + "-001.exr"));
}

TEST(ListFiles, ARangeOfItsOwnComesFirst) {
    PatternOptions options;
    options.frames = "7";
    EXPECT_THAT(list_files("a.#.exr", options).names, ElementsAre("a.0007.exr"));
    const Files own = list_files("a.1-2@@.exr", options);
    EXPECT_THAT(own.names, ElementsAre("a.01.exr", "a.02.exr"));
    EXPECT_TRUE(own.own_range);
    EXPECT_THROW(list_files("a.1-2000000000#.exr", options), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
