#include "imagebuf/row_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "files.h"
#include "include/tonetool/flip.h"
#include "include/tonetool/luminance.h"

namespace tonetool {
namespace {

using testing::HasSubstr;

TEST(RowSource, ReadsAnyRowsInAnyOrder) {
    const Folder folder;
    auto spec = make_spec(20, 50, {"R", "G", "B", "Z"});
    spec.x = 3;
    spec.y = -7;
    const auto image = noise(spec, 1);
    for (int tile : {0, 16}) {
        const UnreadFile file(write_file(folder / "a.exr", image, {OIIO::TypeFloat, "zip", tile}));
        RowSource source;
        std::string error;
        ASSERT_TRUE(source.open(file.image, {{1, 3}, {3, 4}}, error)) << error;
        EXPECT_TRUE(source.from_file());
        const std::pair<int, int> rows[] = {{-7, 43}, {20, 21}, {-7, 3}, {8, 30}, {42, 43}};
        for (const auto& [begin, end] : rows)
            for (size_t run = 0; run < 2; ++run) {
                const ChannelRun& channels = source.runs()[run];
                const ROI roi(3, 23, begin, end, 0, 1, channels.begin, channels.end);
                std::vector<float> expected(size_t(roi.npixels()) * size_t(channels.count()));
                auto found = expected;
                image.get_pixels(roi, OIIO::TypeFloat, expected.data());
                ASSERT_TRUE(source.read(begin, end, run, found.data(), error)) << error;
                EXPECT_EQ(found, expected) << begin;
                source.rest();
            }
    }
}

TEST(RowSource, AFileThatChangesIsAnError) {
    const Folder folder;
    const auto name = write_file(folder / "a.exr", noise(8, 40, 2));
    const UnreadFile file(name);
    RowSource source;
    std::string error;
    std::vector<float> rows(8 * 40 * 3);
    ASSERT_TRUE(source.open(file.image, {{0, 3}}, error));
    ASSERT_TRUE(source.read(0, 10, 0, rows.data(), error));
    write_file(name, noise(8, 41, 3));
    EXPECT_FALSE(source.read(10, 20, 0, rows.data(), error));
    EXPECT_THAT(error, HasSubstr("has changed"));
    RowSource late;
    EXPECT_FALSE(late.open(file.image, {{0, 3}}, error)) << "its header is another";
    EXPECT_THAT(error, HasSubstr("has changed"));
}

void cut_file(const std::string& name, double share) {
    std::string bytes;
    OIIO::Filesystem::read_text_file(name, bytes);
    std::ofstream(name, std::ios::binary)
        .write(bytes.data(), std::streamsize(double(bytes.size()) * share));
}

TEST(RowSource, ATruncatedFileIsAnError) {
    const Folder folder;
    const auto fine = noise(64, 300, 4);
    for (const char* name : {"a.exr", "t.exr", "a.png", "a.tif", "a.jpg"}) {
        SCOPED_TRACE(name);
        const auto bad = folder / name;
        const bool real = std::string(name).find("exr") != std::string::npos;
        write_file(bad, fine,
                   {real ? OIIO::TypeFloat : OIIO::TypeUInt8, "zip", *name == 't' ? 32 : 0});
        cut_file(bad, 0.6);
        for (uint64_t memory : {uint64_t(0), uint64_t(130) << 20}) {
            HdrFlipOptions options;
            options.memory = memory;
            const UnreadFile file(bad);
            for (bool first : {true, false}) {
                const ImageBuf map = first ? ToneAlgo::hdr_flip(file.image, fine, options)
                                           : ToneAlgo::hdr_flip(fine, file.image, options);
                EXPECT_FALSE(map.initialized());
                EXPECT_THAT(map.geterror(), HasSubstr(name));
            }
            LuminanceStats stats;
            std::string error;
            EXPECT_FALSE(ToneAlgo::luminance_stats(stats, file.image, error));
        }
    }
}

TEST(RowSource, ASubimageOfAFile) {
    const Folder folder;
    const auto name = folder / "two.exr";
    const ImageBuf parts[] = {noise(16, 12, 5), noise(16, 12, 6)};
    const std::vector<ImageSpec> specs = {parts[0].spec(), parts[1].spec()};
    auto out = OIIO::ImageOutput::create(name);
    ASSERT_TRUE(out->open(name, 2, specs.data()));
    for (int i = 0; i < 2; ++i) {
        if (i > 0) {
            ASSERT_TRUE(out->open(name, specs[1], OIIO::ImageOutput::AppendSubimage));
        }
        ASSERT_TRUE(out->write_image(OIIO::TypeFloat, parts[i].localpixels()));
    }
    ASSERT_TRUE(out->close());
    for (int i = 0; i < 2; ++i) {
        const UnreadFile file(name, i);
        FlipResult result;
        ToneAlgo::hdr_flip(parts[i], file.image, {}, &result);
        EXPECT_EQ(result.summary.pool.pixels, 16 * 12);
        EXPECT_EQ(result.summary.pool.max, 0.0) << "the same pixels";
    }
}

} // namespace
} // namespace tonetool
