// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/texture.h"
#include "tonetool/write.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "images.h"

namespace tonetool {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr const char* kDir = "TONETOOL_WRITE_TEST_DIR";

std::string contents(const std::string& name) {
    std::ifstream in(name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class Write : public testing::Test {
protected:
    // A death test's child runs SetUp anew, in its parent's folder.
    void SetUp() override {
        testing::FLAGS_gtest_death_test_style = "threadsafe";
        if (const char* inherited = std::getenv(kDir)) {
            m_dir = inherited;
            return;
        }
        std::string name = testing::TempDir() + "tonetool-write-XXXXXX";
        ASSERT_NE(::mkdtemp(name.data()), nullptr);
        m_dir = name;
        ::setenv(kDir, name.c_str(), 1);
    }
    void TearDown() override {
        ::unsetenv(kDir);
        fs::permissions(m_dir, fs::perms::owner_all);
        fs::remove_all(m_dir);
    }

    std::string in(const std::string& name) const { return (m_dir / name).string(); }
    std::set<std::string> files() const {
        std::set<std::string> out;
        for (const auto& entry : fs::directory_iterator(m_dir))
            out.insert(entry.path().filename().string());
        return out;
    }
    void put(const std::string& name, const std::string& text) const {
        std::ofstream(in(name), std::ios::binary) << text;
    }

    fs::path m_dir;
    std::string m_error;
};

// In a death test: 0 if the write failed for the reason that was expected.
int expect_failure(bool written, const std::string& error, const std::string& words) {
    std::fprintf(stderr, "%s\n", written ? "it was written" : error.c_str());
    return !written && error.find(words) != std::string::npos ? 0 : 1;
}

TEST_F(Write, FormatsKeepTheirPixels) {
    const auto image = noise(37, 21, 1);
    const struct {
        const char* name;
        double tolerance;
    } cases[] = {{"a.exr", 0}, {"a.tif", 0}, {"a.EXR", 0}, {"a.hdr", 0.02}}; // RGBE: 8 bits
    for (const auto& c : cases) {
        ASSERT_TRUE(write_image(image, in(c.name), m_error)) << m_error;
        ImageBuf back(in(c.name));
        ASSERT_TRUE(back.read(0, 0, true, OIIO::TypeFloat)) << back.geterror();
        const auto a = values(image), b = values(back);
        ASSERT_EQ(a.size(), b.size());
        for (size_t i = 0; i < a.size(); ++i)
            ASSERT_NEAR(a[i], b[i], c.tolerance * 8) << c.name; // values reach 8
    }
    EXPECT_THAT(files(), UnorderedElementsAre("a.exr", "a.tif", "a.EXR", "a.hdr"));
}

TEST_F(Write, TheDataFormatIsTheSpecs) {
    const auto image = noise(8, 8, 1);
    OutputImage half{&image, image.spec()};
    half.spec.set_format(OIIO::TypeHalf);
    half.spec.attribute("Artist", "nobody");
    ASSERT_TRUE(write_images({half}, in("half.exr"), m_error)) << m_error;
    const ImageBuf back(in("half.exr"));
    EXPECT_EQ(back.nativespec().format, OIIO::TypeHalf);
    EXPECT_EQ(back.spec().get_string_attribute("Artist"), "nobody");
}

TEST_F(Write, SeveralSubimagesGoIntoOneExr) {
    // The parts of an EXR share their display window.
    auto part = make_spec(5, 4, {"Y"});
    part.x = 2;
    part.full_width = 9;
    part.full_height = 7;
    const auto a = noise(9, 7, 1), b = noise(part, 2);
    ASSERT_TRUE(write_images({{&a, a.spec()}, {&b, b.spec()}}, in("two.exr"), m_error)) << m_error;
    const ImageBuf first(in("two.exr"), 0, 0), second(in("two.exr"), 1, 0);
    EXPECT_EQ(first.nsubimages(), 2);
    EXPECT_EQ(values(first), values(a));
    EXPECT_EQ(values(second), values(b));
    EXPECT_THAT(files(), ElementsAre("two.exr"));
}

// The writer of this format would leave 80 bytes as they happen to be in memory.
TEST_F(Write, AnSgiFileWithoutADescriptionHasZerosThere) {
    const auto image = noise(9, 7, 1);
    ASSERT_TRUE(write_image(image, in("a.sgi"), m_error)) << m_error;
    EXPECT_TRUE(contents(in("a.sgi")).substr(24, 80) == std::string(80, '\0'));
    OutputImage described{&image, image.spec()};
    described.spec.attribute("ImageDescription", "noise");
    ASSERT_TRUE(write_images({described}, in("b.sgi"), m_error)) << m_error;
    EXPECT_EQ(ImageBuf(in("b.sgi")).spec().get_string_attribute("ImageDescription"), "noise");
}

// Such a file ends with where its tiles lie, which a reader would else have to search for.
TEST_F(Write, MipLevelsAreWrittenToTheirEnd) {
    std::vector<ImageBuf> levels;
    std::vector<OutputImage> images;
    for (const int size : {16, 8, 4, 2, 1})
        levels.push_back(noise(size, size, size));
    for (const ImageBuf& level : levels) {
        OutputImage image{&level, level.spec()};
        image.spec.tile_width = image.spec.tile_height = 8;
        image.spec.attribute("textureformat", "Plain Texture");
        image.mip_level = !images.empty();
        images.push_back(image);
    }
    ASSERT_TRUE(write_images(images, in("ours.exr"), m_error)) << m_error;
    {
        const auto out = OIIO::ImageOutput::create("exr");
        for (const OutputImage& image : images)
            ASSERT_TRUE(out->open(in("plain.exr"), image.spec,
                                  image.mip_level ? OIIO::ImageOutput::AppendMIPLevel
                                                  : OIIO::ImageOutput::Create) &&
                        image.pixels->write(out.get()))
                << out->geterror();
    }
    const auto ours = OIIO::ImageInput::open(in("ours.exr"));
    ASSERT_TRUE(ours);
    EXPECT_TRUE(ours->seek_subimage(0, 4) && !ours->seek_subimage(0, 5));
    EXPECT_TRUE(contents(in("ours.exr")) == contents(in("plain.exr")));
}

TEST_F(Write, RefusalsChangeNothing) {
    const auto image = noise(9, 7, 1);
    const ImageBuf empty;
    const OutputImage one{&image, image.spec()};
    put("old.exr", "old");
    put("old.png", "old");
    put("old.foo", "old");
    fs::create_directory(in("folder.exr"));
    const struct {
        std::vector<OutputImage> images;
        std::string name;
        const char* words;
    } cases[] = {{{one}, "old.foo", "old.foo"},
                 {{one, one}, "old.png", "png files hold one image, there are 2"},
                 {{}, "old.exr", "there is no image"},
                 {{{&empty, {}}}, "old.exr", "holds no pixels"},
                 {{{nullptr, {}}}, "old.exr", "holds no pixels"},
                 {{one}, "folder.exr", "is a directory"},
                 {{one}, "none/x.exr", "cannot create a file in"}};
    const auto before = files();
    for (const auto& c : cases) {
        EXPECT_FALSE(write_images(c.images, in(c.name), m_error)) << c.name;
        EXPECT_THAT(m_error, HasSubstr(c.words));
        EXPECT_THAT(m_error, HasSubstr(c.name));
        EXPECT_EQ(files(), before);
    }
    for (const char* name : {"old.exr", "old.png", "old.foo"})
        EXPECT_EQ(contents(in(name)), "old") << name;
}

TEST_F(Write, ReplacesAndKeepsPermissions) {
    for (const mode_t mode : {0600u, 0640u, 0644u, 0666u}) {
        put("a.txt", "old");
        ASSERT_EQ(::chmod(in("a.txt").c_str(), mode), 0);
        ASSERT_TRUE(write_bytes("new", in("a.txt"), m_error)) << m_error;
        struct stat info {};
        ASSERT_EQ(::stat(in("a.txt").c_str(), &info), 0);
        EXPECT_EQ(info.st_mode & 0777u, mode);
        EXPECT_EQ(contents(in("a.txt")), "new");
    }
    EXPECT_THAT(files(), ElementsAre("a.txt"));
}

TEST_F(Write, NewFilesFollowTheUmask) {
    const mode_t mask = ::umask(027);
    const bool written = write_bytes("x", in("a.txt"), m_error);
    ::umask(mask);
    ASSERT_TRUE(written) << m_error;
    struct stat info {};
    ASSERT_EQ(::stat(in("a.txt").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777u, 0640u);
}

TEST_F(Write, SymbolicLinksAreFollowedAndStay) {
    fs::create_directory(in("sub"));
    put("sub/real.exr", "old");
    fs::create_symlink("sub/real.exr", in("link.exr"));
    fs::create_symlink("link.exr", in("chain.exr"));
    fs::create_symlink("sub/later.exr", in("dangling.exr"));
    const auto image = noise(6, 5, 1);
    ASSERT_TRUE(write_image(image, in("chain.exr"), m_error)) << m_error;
    ASSERT_TRUE(write_image(image, in("dangling.exr"), m_error)) << m_error;
    for (const char* link : {"link.exr", "chain.exr", "dangling.exr"})
        EXPECT_TRUE(fs::is_symlink(in(link))) << link;
    EXPECT_EQ(values(ImageBuf(in("sub/real.exr"))), values(image));
    EXPECT_EQ(values(ImageBuf(in("sub/later.exr"))), values(image));
    EXPECT_EQ(std::distance(fs::directory_iterator(in("sub")), {}), 2)
        << "a temporary file is left";
}

TEST_F(Write, AFullDeviceIsAnError) {
    if (!fs::exists("/dev/full"))
        GTEST_SKIP() << "there is no /dev/full";
    fs::create_symlink("/dev/full", in("full.exr"));
    fs::create_symlink("/dev/full", in("full.tif"));
    const auto image = noise(64, 64, 1);
    for (const char* name : {"full.exr", "full.tif"}) {
        EXPECT_FALSE(write_image(image, in(name), m_error)) << name;
        EXPECT_THAT(m_error, HasSubstr(name));
    }
    EXPECT_FALSE(write_bytes("text", in("full.exr"), m_error));
    EXPECT_THAT(m_error, HasSubstr("No space left on device"));
    EXPECT_THAT(files(), UnorderedElementsAre("full.exr", "full.tif"));
    EXPECT_TRUE(fs::is_symlink(in("full.exr")));
}

TEST_F(Write, DevicesAreWrittenDirectly) {
    fs::create_symlink("/dev/null", in("null.txt"));
    EXPECT_TRUE(write_bytes("text", in("null.txt"), m_error)) << m_error;
    EXPECT_TRUE(fs::is_character_file(in("null.txt")));
}

TEST_F(Write, AFullDiskKeepsTheOldFile) {
    put("old.exr", "old");
    EXPECT_EXIT(
        {
            // The limit of a file's size stands for a disk that fills up half way.
            ::signal(SIGXFSZ, SIG_IGN);
            struct rlimit limit = {};
            limit.rlim_cur = limit.rlim_max = 4096;
            ::setrlimit(RLIMIT_FSIZE, &limit);
            std::string error;
            const bool written = write_image(noise(128, 128, 1), in("old.exr"), error);
            std::_Exit(expect_failure(written, error, "old.exr"));
        },
        testing::ExitedWithCode(0), "File too large");
    EXPECT_EQ(contents(in("old.exr")), "old");
    EXPECT_THAT(files(), ElementsAre("old.exr"));
}

// Their writer waits for ever where a write fails.
TEST_F(Write, AFullDiskEndsTiledFilesOfSeveralPartsAndTextures) {
    put("old.exr", "old");
    EXPECT_EXIT(
        {
            ::signal(SIGXFSZ, SIG_IGN);
            ::alarm(60);
            struct rlimit limit = {};
            limit.rlim_cur = limit.rlim_max = 4096;
            ::setrlimit(RLIMIT_FSIZE, &limit);
            const ImageBuf image = noise(256, 256, 3);
            OIIO::ImageSpec spec = image.spec();
            spec.tile_width = spec.tile_height = 32;
            std::string error;
            bool written = write_images({{&image, spec}, {&image, spec}}, in("old.exr"), error);
            int wrong = expect_failure(written, error, "old.exr");
            written =
                write_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, in("old.exr"), {}, error);
            wrong += expect_failure(written, error, "");
            written =
                write_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, in("new.tx"), {}, error);
            wrong += expect_failure(written, error, "");
            std::_Exit(wrong);
        },
        testing::ExitedWithCode(0), "");
    EXPECT_EQ(contents(in("old.exr")), "old");
    EXPECT_THAT(files(), ElementsAre("old.exr"));
}

TEST_F(Write, TiledFilesOfSeveralPartsAreWhole) {
    const auto image = noise(70, 50, 3);
    OIIO::ImageSpec spec = image.spec();
    spec.tile_width = spec.tile_height = 32;
    ASSERT_TRUE(write_images({{&image, spec}, {&image, spec}}, in("a.exr"), m_error)) << m_error;
    EXPECT_EQ(values(ImageBuf(in("a.exr"), 1, 0)), values(image));
}

// An ImageBuf of OpenImageIO 2.5 only knows them of a file in a cache.
int mip_levels(const std::string& file) {
    const auto reader = OIIO::ImageInput::open(file);
    int levels = 0;
    while (reader && reader->seek_subimage(0, levels))
        ++levels;
    return levels;
}

TEST_F(Write, TexturesHaveLevelsAndTheRightsOfWhatTheyReplace) {
    const auto image = noise(64, 64, 3);
    put("old.exr", "old");
    ASSERT_EQ(::chmod(in("old.exr").c_str(), 0640), 0);
    for (const char* name : {"old.exr", "new.tx", "new.exr"}) {
        ASSERT_TRUE(write_texture(OIIO::ImageBufAlgo::MakeTxTexture, image, in(name), {}, m_error))
            << m_error;
        const ImageBuf back(in(name));
        EXPECT_EQ(values(back), values(image)) << name;
        EXPECT_EQ(mip_levels(in(name)), 7) << name;
    }
    struct stat info {};
    ASSERT_EQ(::stat(in("old.exr").c_str(), &info), 0);
    EXPECT_EQ(info.st_mode & 0777u, 0640u);
    EXPECT_THAT(files(), ElementsAre("new.exr", "new.tx", "old.exr"));
}

TEST_F(Write, ATextureIsNoDeviceAndNoUnknownFormat) {
    fs::create_symlink("/dev/null", in("null.tx"));
    const auto image = noise(8, 8, 3);
    const auto mode = OIIO::ImageBufAlgo::MakeTxTexture;
    EXPECT_FALSE(write_texture(mode, image, in("null.tx"), {}, m_error));
    EXPECT_THAT(m_error, HasSubstr("device"));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_FALSE(write_texture(mode, image, in("a.nosuch"), {}, m_error));
    EXPECT_FALSE(write_texture(mode, image, in("a.png"), {}, m_error));
    EXPECT_THAT(m_error, HasSubstr("tile"));
    EXPECT_THAT(files(), ElementsAre("null.tx"));
}

constexpr uid_t kNobody = 65534;

TEST_F(Write, AnUnwritableFolderKeepsTheOldFile) {
    put("old.txt", "old");
    ASSERT_EQ(::chmod(in("old.txt").c_str(), 0666), 0);
    ASSERT_EQ(::chmod(m_dir.c_str(), 0555), 0);
    EXPECT_EXIT(
        {
            if (::geteuid() == 0 && ::setuid(kNobody) != 0)
                std::_Exit(2);
            std::string error;
            const bool written = write_bytes("new", in("old.txt"), error);
            std::_Exit(expect_failure(written, error, "cannot create a file in"));
        },
        testing::ExitedWithCode(0), "Permission denied");
    EXPECT_EQ(contents(in("old.txt")), "old");
    EXPECT_THAT(files(), ElementsAre("old.txt"));
}

TEST_F(Write, AReadOnlyFileIsNotReplaced) {
    put("old.txt", "old");
    ASSERT_EQ(::chmod(in("old.txt").c_str(), 0444), 0);
    ASSERT_EQ(::chmod(m_dir.c_str(), 0777), 0);
    EXPECT_EXIT(
        {
            if (::geteuid() == 0 && ::setuid(kNobody) != 0)
                std::_Exit(2);
            std::string error;
            std::_Exit(expect_failure(write_bytes("new", in("old.txt"), error), error, "old.txt"));
        },
        testing::ExitedWithCode(0), "Permission denied");
    EXPECT_EQ(contents(in("old.txt")), "old");
    EXPECT_THAT(files(), ElementsAre("old.txt"));
}

TEST_F(Write, BytesAreWrittenAsTheyAre) {
    const std::string bytes("a\0b\r\n\xff", 6);
    ASSERT_TRUE(write_bytes(bytes, in("a.bin"), m_error)) << m_error;
    EXPECT_EQ(contents(in("a.bin")), bytes);
    ASSERT_TRUE(write_bytes("", in("a.bin"), m_error)) << m_error;
    EXPECT_EQ(contents(in("a.bin")), "");
}

TEST_F(Write, NothingUnfinishedIsLeftToRemove) {
    ASSERT_TRUE(write_bytes("x", in("a.txt"), m_error));
    remove_unfinished_outputs();
    EXPECT_EQ(contents(in("a.txt")), "x");
}

TEST_F(Write, ASpecOfAnotherSizeIsRefused) {
    const auto image = noise(4, 4, 1);
    std::string error;
    auto spec = image.spec();
    spec.width = spec.full_width = 4000;
    EXPECT_FALSE(write_images({{&image, spec}}, in("x.exr"), error));
    EXPECT_THAT(error, HasSubstr("size and channels"));
    EXPECT_TRUE(files().empty());
}

} // namespace
} // namespace tonetool
