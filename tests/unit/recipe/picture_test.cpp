// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/picture.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <thread>
#include <unistd.h>

namespace tonetool::recipe {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class InFolder : public testing::Test {
protected:
    InFolder()
        : m_folder(std::filesystem::temp_directory_path() /
                   ("tonetool_recipe." + std::to_string(getpid()))) {
        std::filesystem::create_directory(m_folder);
    }
    ~InFolder() override { std::filesystem::remove_all(m_folder); }

    std::string write(const std::string& name, const std::string& chain) {
        const std::string file = (m_folder / name).string();
        std::ofstream(file) << "tonetool 1\n" << chain << "\n";
        return file;
    }

    // Files that are that new could change again without a trace.
    static void let_files_age() { std::this_thread::sleep_for(std::chrono::milliseconds(60)); }

private:
    std::filesystem::path m_folder;
};

using RecipePicture = InFolder;

TEST_F(RecipePicture, IsMadeOnceUntilSomethingChanges) {
    const std::string file = write("a.tone", "$w = 8\n--create ${w}x4 3");
    let_files_age();
    const PicturePtr first = picture_of({file, {}});
    EXPECT_EQ(first->subimages.at(0).spec().width, 8);
    EXPECT_EQ(picture_of({file, {}}), first);
    EXPECT_EQ(picture_of({file, {{"w", "8"}}}), first);
    EXPECT_NE(picture_of({file, {{"w", "9"}}}), first);
    EXPECT_EQ(picture_of({file, {}}), first);
    (void)write("a.tone", "--create 8x4 3");
    EXPECT_NE(picture_of({file, {}}), first);
}

TEST_F(RecipePicture, OfNewFilesIsNotTrusted) {
    const std::string file = write("a.tone", "--create 8x4 3");
    const PicturePtr first = picture_of({file, {}});
    EXPECT_NE(picture_of({file, {}}), first);
}

TEST_F(RecipePicture, ManyAreNotKept) {
    const std::string file = write("a.tone", "--create ${w}x4 3");
    let_files_age();
    std::weak_ptr<const Picture> first = picture_of({file, {{"w", "1"}}});
    EXPECT_FALSE(first.expired());
    for (int w = 2; w < 100; ++w)
        (void)picture_of({file, {{"w", std::to_string(w)}}});
    EXPECT_TRUE(first.expired());
}

TEST_F(RecipePicture, LargeOnesAreNotKeptBesideEachOther) {
    const std::string file = write("a.tone", "--create 8192x${h} 1");
    let_files_age();
    std::weak_ptr<const Picture> first = picture_of({file, {{"h", "5000"}}});
    EXPECT_FALSE(first.expired());
    (void)picture_of({file, {{"h", "5001"}}});
    EXPECT_TRUE(first.expired());
}

TEST_F(RecipePicture, SourcesAreTakenApart) {
    OIIO::ImageSpec config;
    config.attribute("tone:frame", 7);
    config.attribute("tone:view", "b");
    config.attribute("oiio:UnassociatedAlpha", 1);
    const Source source = parse_source("/no/shot.tone?view=a=c&x=", config);
    EXPECT_EQ(source.file, "/no/shot.tone");
    EXPECT_THAT(source.parameters,
                ElementsAre(Pair("frame", "7"), Pair("view", "a=c"), Pair("x", "")));
    EXPECT_THROW((void)parse_source("shot.tone?frame", {}), RecipeError);
    const std::string file = write("q?a=1.tone", "--create 1x1 1");
    EXPECT_EQ(parse_source(file, {}).file, file);
}

} // namespace
} // namespace tonetool::recipe
