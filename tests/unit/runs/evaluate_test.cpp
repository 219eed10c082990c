// SPDX-License-Identifier: BSD-3-Clause
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>
#include <filesystem>
#include <gmock/gmock.h>
#include <set>
#include <unistd.h>

#include "chain/language/registry.h"
#include "runs/runs.h"

namespace tonetool::runs {
namespace {

using namespace chain;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const Policy kInTestimages{true, TESTIMAGES_DIR, 1000};

std::vector<float> values_of(const OIIO::ImageBuf& image) {
    std::vector<float> values(image.spec().image_pixels() * size_t(image.nchannels()));
    EXPECT_TRUE(image.get_pixels(image.roi(), OIIO::TypeFloat, values.data()));
    return values;
}

OIIO::ImageBuf grey(float value) {
    OIIO::ImageBuf image(OIIO::ImageSpec(4, 3, 3, OIIO::TypeFloat));
    OIIO::ImageBufAlgo::fill(image, {value, value, value});
    return image;
}

TEST(Evaluate, LeavesTheStackWithItsTopLast) {
    Evaluation done = evaluate({"plain.exr", "--addc", "1", "constant.exr"}, {}, kInTestimages);
    ASSERT_EQ(done.status, 0) << done.err;
    ASSERT_THAT(done.stack, SizeIs(2));
    EXPECT_EQ(done.stack[1].name, TESTIMAGES_DIR "/constant.exr");
    EXPECT_THAT(done.files,
                ElementsAre(TESTIMAGES_DIR "/plain.exr", TESTIMAGES_DIR "/constant.exr"));
    OIIO::ImageBuf file(TESTIMAGES_DIR "/plain.exr");
    std::vector<float> expected = values_of(file);
    for (float& value : expected)
        value += 1.0f;
    EXPECT_EQ(values_of(done.stack[0].subimages.at(0)), expected);
}

TEST(Evaluate, BoundsTheNestingOfBlocks) {
    for (const char* kind : {"--if", "--while", "--for"}) {
        Strings words;
        for (int i = 0; i < 101; ++i) {
            words.insert(words.end(), {kind, std::string(kind) == "--for" ? "i" : "1"});
            if (std::string(kind) == "--for")
                words.emplace_back("1");
        }
        const Evaluation done = evaluate(words, {}, kInTestimages);
        EXPECT_EQ(done.status, 1) << kind;
        EXPECT_THAT(done.error, HasSubstr("nested deeper than 100")) << kind;
    }
}

TEST(Evaluate, TakesImagesAndTheirFormat) {
    OIIO::ImageBuf image = grey(0.25f);
    std::vector<OIIO::ImageBuf> images;
    images.push_back(image.copy(OIIO::TypeHalf));
    Evaluation done = evaluate({"--mulc", "2", "--dup", "--hdrflip"}, std::move(images));
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_THAT(done.stack, SizeIs(1));
    EXPECT_EQ(done.stack[0].formats.at(0), OIIO::TypeFloat);
    EXPECT_EQ(values_of(done.stack[0].subimages.at(0)), std::vector<float>(12, 0.0f));

    images.clear();
    images.push_back(image.copy(OIIO::TypeHalf));
    done = evaluate({"--mulc", "2"}, std::move(images));
    EXPECT_EQ(done.stack.at(0).formats.at(0), OIIO::TypeHalf);
    EXPECT_EQ(values_of(done.stack[0].subimages.at(0)), std::vector<float>(36, 0.5f));
}

TEST(Evaluate, ReadsImagesThatWereNotReadYetAndKeepsChangedOnes) {
    std::vector<OIIO::ImageBuf> images(2);
    images[0] = OIIO::ImageBuf(TESTIMAGES_DIR "/srgb8.png");
    images[1] = OIIO::ImageBuf(TESTIMAGES_DIR "/plain.exr");
    ASSERT_TRUE(images[1].read(0, 0, true, OIIO::TypeFloat));
    OIIO::ImageBuf::Iterator<float> first(images[1]);
    first[0] = 7.0f;
    Evaluation done = evaluate({}, std::move(images));
    ASSERT_EQ(done.status, 0) << done.err;
    ASSERT_THAT(done.stack, SizeIs(2));
    EXPECT_EQ(done.stack[0].formats.at(0), OIIO::TypeUInt8);
    EXPECT_EQ(values_of(done.stack[0].subimages[0]),
              values_of(OIIO::ImageBuf(TESTIMAGES_DIR "/srgb8.png")));
    EXPECT_EQ(values_of(done.stack[1].subimages[0])[0], 7.0f);
}

TEST(Evaluate, AnImageWithoutPixelsIsNamed) {
    std::vector<OIIO::ImageBuf> images(2);
    images[0] = grey(1);
    images[1] = OIIO::ImageBuf("nosuch.exr");
    Evaluation done = evaluate({"--hdrflip"}, std::move(images));
    EXPECT_EQ(done.status, 1);
    EXPECT_THAT(done.error, HasSubstr("image 2 has no pixels"));
    EXPECT_THAT(done.stack, IsEmpty());
}

TEST(Evaluate, ImagesHaveTheirLabels) {
    Evaluation done = evaluate(
        {"plain.exr", "--label", "z", "--mulc", "2", "--label", "b", "--dup", "--addc", "1"}, {},
        kInTestimages);
    ASSERT_EQ(done.status, 0) << done.err;
    ASSERT_THAT(done.stack, SizeIs(2));
    EXPECT_EQ(done.stack[0].label, "b");
    EXPECT_EQ(done.stack[1].label, "");
}

TEST(Evaluate, ErrorsThresholdsAndWarningsAreTold) {
    Evaluation done = evaluate({"plain.exr", "--hdrflp"}, {}, kInTestimages);
    EXPECT_EQ(done.status, 1);
    EXPECT_THAT(done.error, HasSubstr("unknown command \"--hdrflp\""));
    done = evaluate({"white.exr", "black.exr", "--hdrflip:fail=0.01"}, {}, kInTestimages);
    EXPECT_EQ(done.status, 3);
    EXPECT_EQ(done.error, "a threshold was exceeded");
    EXPECT_THAT(done.out, HasSubstr("FAIL mean"));
    done = evaluate({"plain.exr", "plain.exr", "--pop", "--dup", "--pop"}, {}, kInTestimages);
    EXPECT_EQ(done.status, 0);
    EXPECT_THAT(evaluate({"truncated.exr"}, {}, kInTestimages).error, HasSubstr("truncated.exr"));
}

TEST(Evaluate, OneFrameOfASequence) {
    const Strings both = {"cornell_%V.exr", "--views", "ref,test"};
    Evaluation done = evaluate(both, {}, kInTestimages);
    EXPECT_EQ(done.status, 1);
    EXPECT_THAT(done.error, HasSubstr("wildcards fit 2 frames, not one"));
    done = evaluate({"cornell_%V.exr", "--views", "test"}, {}, kInTestimages);
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(done.stack.at(0).name, TESTIMAGES_DIR "/cornell_test.exr");
}

TEST(Evaluate, AnEndlessLoopEnds) {
    Evaluation done = evaluate({"--while", "1", "--endwhile"}, {}, kInTestimages);
    EXPECT_EQ(done.status, 1);
    EXPECT_THAT(done.error, HasSubstr("stopped after 1000 words"));
}

TEST(Evaluate, CommandsWhoseEffectRemainsAreRefused) {
    for (const Strings& words :
         {Strings{"-o", "x.exr"}, Strings{"--otex", "x.tx"}, Strings{"--iccwrite", "x.icc"},
          Strings{"--exportlut", "x.cube"}, Strings{"--hdrflip:saveexposures=x"},
          Strings{"--oiioattrib", "threads", "1"}, Strings{"--threads", "1"},
          Strings{"--memory", "1G"}, Strings{"--cache", "10"}}) {
        Strings all = {"plain.exr", "plain.exr"};
        all.insert(all.end(), words.begin(), words.end());
        Evaluation done = evaluate(all, {}, kInTestimages);
        EXPECT_EQ(done.status, 1) << words[0];
        EXPECT_THAT(done.error, HasSubstr("not allowed here")) << words[0];
    }
}

// No command at all leaves a file behind, whatever its arguments and modifiers say.
TEST(Evaluate, NoCommandWrites) {
    const std::filesystem::path old = std::filesystem::current_path();
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("tonetool_evaluate." + std::to_string(getpid()));
    std::filesystem::create_directory(folder);
    std::filesystem::current_path(folder);
    const int threads = OIIO::get_int_attribute("threads");
    know_all_commands();
    for (const Command& row : all_commands()) {
        for (size_t m = 0; m <= row.modifiers.size(); ++m) {
            Strings words = {TESTIMAGES_DIR "/plain.exr", TESTIMAGES_DIR "/plain.exr"};
            words.push_back("--" + row.names.front());
            if (m > 0)
                words.back() += ":" + row.modifiers[m - 1].key + "=written.exr";
            words.insert(words.end(), row.args.size(), "written.exr");
            (void)evaluate(words, {}, Policy{true, folder.string(), 100});
            ASSERT_TRUE(std::filesystem::is_empty(folder)) << words[2];
        }
    }
    EXPECT_EQ(OIIO::get_int_attribute("threads"), threads);
    std::filesystem::current_path(old);
    std::filesystem::remove_all(folder);
}

// A new command that names a file is in Group::Write unless it only reads the file: then it is
// listed here.
TEST(Evaluate, CommandsThatNameAFileSayWhetherTheyReadIt) {
    const std::set<std::string> readers = {"i", "colorconfig", "ociofiletransform", "iccread"};
    for (const Command& row : all_commands()) {
        for (const std::string& argument : row.args) {
            if (argument.find("FILE") != std::string::npos) {
                EXPECT_NE(row.outlives_chain(), readers.count(row.names.front()) == 1)
                    << row.names.front();
            }
        }
    }
}

TEST(Evaluate, ACheckIsRefusedAndNotLeftOut) {
    for (const char* word : {"--json", "--csv", "--junit", "--state", "--statistics"}) {
        Evaluation done = evaluate({TESTIMAGES_DIR "/plain.exr", TESTIMAGES_DIR "/plain.exr",
                                    "--hdrflip:exposures=shot:fail=0", word, "written"},
                                   {}, Policy{false, "", 0});
        EXPECT_EQ(done.status, 1) << word;
        EXPECT_THAT(done.error, HasSubstr(word));
    }
}

TEST(Evaluate, FilesOfModifiersAreInTheFolder) {
    Evaluation done =
        evaluate({"gallery_ref.exr", "--lightindex:lights=nosuch.json"}, {}, kInTestimages);
    EXPECT_THAT(done.error, HasSubstr(TESTIMAGES_DIR "/nosuch.json"));
    EXPECT_THAT(done.files, Contains(TESTIMAGES_DIR "/nosuch.json"));
}

} // namespace
} // namespace tonetool::runs
