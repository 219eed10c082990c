// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/row_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "files.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/has_pixels.h"
#include "imagebuf/pixels/paged_array.h"
#include "imagebuf/pixels/planes.h"
#include "imagebuf/pixels/rows_together.h"
#include "refusal.h"
#include "tonetool/flip.h"
#include "tonetool/luminance.h"

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
        source.open(file.image, {{1, 3}, {3, 4}});
        EXPECT_TRUE(source.from_file());
        const std::pair<int, int> rows[] = {{-7, 43}, {20, 21}, {-7, 3}, {8, 30}, {42, 43}};
        for (const auto& [begin, end] : rows)
            for (size_t run = 0; run < 2; ++run) {
                const ChannelRun& channels = source.runs()[run];
                const ROI roi(3, 23, begin, end, 0, 1, channels.begin, channels.end);
                std::vector<float> expected(size_t(roi.npixels()) * size_t(channels.count()));
                auto found = expected;
                image.get_pixels(roi, OIIO::TypeFloat, expected.data());
                source.read(begin, end, run, found.data());
                EXPECT_EQ(found, expected) << begin;
                source.rest();
            }
    }
}

// Of one row a strip, as OpenImageIO writes them; the program's tests have larger ones.
TEST(RowSource, ReadsAnyRowsOfPlanarTiffFiles) {
    const Folder folder;
    for (const char* compression : {"none", "lzw", "zip"}) {
        SCOPED_TRACE(compression);
        auto image = noise(20, 50, 1);
        image.specmod().attribute("planarconfig", "separate");
        const UnreadFile file(
            write_file(folder / "a.tif", image, {OIIO::TypeFloat, compression, 0}));
        ASSERT_EQ(file.image.spec().get_string_attribute("planarconfig"), "separate");
        RowSource source;
        source.open(file.image, {{0, 1}, {1, 3}});
        const std::pair<int, int> rows[] = {{1, 2}, {4, 20}, {0, 50}, {2, 4}, {49, 50}};
        for (const auto& [begin, end] : rows)
            for (size_t run = 0; run < 2; ++run) {
                const ChannelRun& channels = source.runs()[run];
                const ROI roi(0, 20, begin, end, 0, 1, channels.begin, channels.end);
                std::vector<float> expected(size_t(roi.npixels()) * size_t(channels.count()));
                auto found = expected;
                image.get_pixels(roi, OIIO::TypeFloat, expected.data());
                source.read(begin, end, run, found.data());
                EXPECT_EQ(found, expected) << begin;
            }
    }
}

TEST(RowSource, OnlyTiffFilesHaveStrips) {
    ImageSpec spec(64, 48, 3, OIIO::TypeFloat);
    spec.attribute("planarconfig", "separate");
    for (int said : {0, 1, 3, 48, 1000, -1}) {
        spec.attribute("tiff:RowsPerStrip", said);
        EXPECT_EQ(rows_together(spec, "openexr"), 0) << said;
        EXPECT_EQ(whole_rows(64, spec, "openexr"), 64) << said;
        EXPECT_LE(rows_together(spec, "tiff"), 48) << said;
        EXPECT_GT(whole_rows(64, spec, "tiff"), 0) << said;
    }
    spec.attribute("tiff:RowsPerStrip", 3);
    EXPECT_EQ(whole_rows(64, spec, "tiff"), 63);
    EXPECT_EQ(whole_rows(1, spec, "tiff"), 3);
}

TEST(RowSource, CopiesAnyPartOfAnImage) {
    const Folder folder;
    auto spec = make_spec(20, 50, {"R", "G", "B", "Z"});
    spec.x = 3;
    spec.y = -7;
    const auto image = noise(spec, 1);
    const UnreadFile file(write_file(folder / "a.exr", image, {OIIO::TypeFloat, "zip", 16}));
    for (const ImageBuf* from : {&image, &file.image})
        for (const ROI& wanted :
             {ROI(), ROI(5, 9, -3, 40), ROI(-100, 100, 42, 100), ROI(3, 4, -7, -6, 0, 1, 0, 1)}) {
            const ROI part = part_of(*from, wanted);
            const ImageBuf copy = copy_pixels(*from, part, 0);
            EXPECT_EQ(copy.roi(), part);
            EXPECT_EQ(copy.nchannels(), 4);
            std::vector<float> expected(size_t(part.npixels()) * 4);
            image.get_pixels(part, OIIO::TypeFloat, expected.data());
            EXPECT_EQ(values(copy), expected);
        }
    EXPECT_THAT(refusal([&] { part_of(image, ROI(30, 40, 0, 5)); }), HasSubstr("holds no pixel"));
}

TEST(Allocation, MoreThanThisComputerHasIsAnError) {
    const uint64_t all = OIIO::Sysutil::physical_memory();
    expect_memory(all);
    EXPECT_THROW(expect_memory(all + 1), std::bad_alloc);
    PagedArray<float> array;
    EXPECT_THROW(array.resize(size_t(all / 4 + 1)), std::bad_alloc);
    EXPECT_THROW(array.resize(SIZE_MAX / 4), std::bad_alloc);
    EXPECT_TRUE(array.empty());
    EXPECT_THROW(allocated_image(ImageSpec(1 << 30, 1 << 30, 4, OIIO::TypeFloat)), std::bad_alloc);
    std::string error;
    EXPECT_FALSE(contained(error, [&] { throw TooLarge(all + 1, all); }));
    EXPECT_THAT(error, HasSubstr("not enough memory: the pixels would take"));
    EXPECT_FALSE(contained(error, [] { throw std::length_error("vector"); }));
    EXPECT_EQ(error, "not enough memory");
}

TEST(Errors, AreUtf8AndNameAFileOnce) {
    std::string error;
    EXPECT_FALSE(contained(error, [] { throw Refusal("layer \xfc"); }));
    EXPECT_EQ(error, "layer \xEF\xBF\xBD");
    EXPECT_FALSE(contained(error, [] { throw std::runtime_error("\xff"); }));
    EXPECT_EQ(error, "\xEF\xBF\xBD");
    const UnreadFile missing("gone.exr");
    EXPECT_EQ(with_name(missing.image, "no end"), "\"gone.exr\": no end");
    EXPECT_EQ(with_name(missing.image, "gone.exr has no end"), "gone.exr has no end");
    const std::string side = side_name("test", missing.image);
    EXPECT_EQ(with_side(side, with_name(missing.image, "no end")),
              "test image \"gone.exr\": no end");
    EXPECT_EQ(with_side(side, "needs R,G,B"), "test image \"gone.exr\": needs R,G,B");
    EXPECT_EQ(with_side(side_name("test", ImageBuf()), "no end"), "test image: no end");
}

// Against the table of the Unicode Standard (15, 3-7) and its example of maximal subparts (3-8).
TEST(Utf8, BadBytesBecomeOneReplacementEach) {
    const std::string bad = "\xEF\xBF\xBD";
    EXPECT_EQ(valid_utf8(""), "");
    EXPECT_EQ(valid_utf8(std::string("a\0b", 3)), std::string("a\0b", 3));
    for (const char* good : {"\u00fc", "\u20ac", "\ud55c", "\U0001F600", "\uffff", "\U0010FFFF",
                             "\u0800", "\U00010000", "\u0080", "\x7f"})
        EXPECT_EQ(valid_utf8(good), good);
    const std::pair<const char*, int> wrong[] = {
        {"\xfc\xe9", 2},         {"\xc0\x80", 2},         {"\xe0\x80\x80", 3}, {"\xed\xa0\x80", 3},
        {"\xf4\x90\x80\x80", 4}, {"\xf0\x80\x80\x80", 4}, {"\xe2\x82", 1},     {"\xf0\x9f\x98", 1},
        {"\x80\xbf", 2},         {"\xf5\xff\xfe", 3},     {"\xc3", 1}};
    for (const auto& [bytes, count] : wrong) {
        std::string expected = "<";
        for (int i = 0; i < count; ++i)
            expected += bad;
        EXPECT_EQ(valid_utf8("<" + std::string(bytes) + ">"), expected + ">");
    }
}

TEST(RowSource, AFileThatChangesIsAnError) {
    const Folder folder;
    const auto name = write_file(folder / "a.exr", noise(8, 40, 2));
    const UnreadFile file(name);
    RowSource source;
    std::vector<float> rows(8 * 40 * 3);
    source.open(file.image, {{0, 3}});
    source.read(0, 10, 0, rows.data());
    write_file(name, noise(8, 41, 3));
    EXPECT_THAT(refusal([&] { source.read(10, 20, 0, rows.data()); }), HasSubstr("has changed"));
    RowSource late;
    EXPECT_THAT(refusal([&] {
                    late.open(file.image, {{0, 3}});
                }),
                HasSubstr("has changed"))
        << "its header is another";
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
        if (i > 0)
            ASSERT_TRUE(out->open(name, specs[1], OIIO::ImageOutput::AppendSubimage));
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
