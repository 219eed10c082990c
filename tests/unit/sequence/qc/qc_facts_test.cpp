// SPDX-License-Identifier: BSD-3-Clause
// What is kept of a frame does not depend on threads, nor on how its pixels were read.
#include <OpenImageIO/filesystem.h>
#include <filesystem>
#include <gmock/gmock.h>

#include "sequence/against/against_record.h"
#include "shots.h"
#include "tonetool/against.h"

namespace tonetool::sequence {
namespace {

using OIIO::ImageBuf;

// All that is measured, with more rows than a band has, in an odd window.
ImageBuf render(unsigned seed) {
    // In the order of files.
    const std::vector<std::string> channels = {
        "R",          "G",          "B",        "A",          "C_env.R",    "C_env.G",
        "C_env.B",    "C_key.R",    "C_key.G",  "C_key.B",    "Crypto00.r", "Crypto00.g",
        "Crypto00.b", "Crypto00.a", "Depth.Z",  "DiffCol.R",  "DiffCol.G",  "DiffCol.B",
        "Normal.X",   "Normal.Y",   "Normal.Z", "Position.X", "Position.Y", "Position.Z",
        "Vector.X",   "Vector.Y"};
    OIIO::ImageSpec spec(211, 307, int(channels.size()), OIIO::TypeFloat);
    spec.channelnames = channels;
    spec.x = 5;
    spec.y = -9;
    spec.full_width = 220;
    spec.full_height = 290;
    ImageBuf image(spec);
    std::mt19937 random(seed), place(7);
    std::gamma_distribution<float> noise(4, 0.25f);
    for (ImageBuf::Iterator<float> p(image); !p.done(); ++p) {
        const float ground = 0.2f + std::generate_canonical<float, 24>(place);
        for (int c = 0; c < image.nchannels(); ++c)
            p[c] = c < 3 || (c > 3 && c < 10) ? ground * noise(random) : ground + float(c);
        p[3] = 1;
        if (random() % 4000 == 0)
            p[1] = 500;
        if (p.x() > 100 && p.x() < 130 && p.y() > 40 && p.y() < 90)
            for (int c = 0; c < 3; ++c)
                p[c] = 0;
    }
    return image;
}

QcFacts qc_of(const ImageBuf& image, int threads) {
    QcFacts facts;
    std::string why;
    EXPECT_TRUE(ToneAlgo::qc_facts(facts, {&image}, why, {}, threads)) << why;
    facts.parts[0].metadata.clear(); // a file has more
    facts.parts[0].compression.clear();
    return facts;
}

AgainstFacts against_of(const ImageBuf& approved, const ImageBuf& image, int threads) {
    AgainstFacts facts;
    std::string why;
    EXPECT_TRUE(ToneAlgo::against_facts(facts, {&approved}, {&image}, why, {}, threads)) << why;
    for (AgainstFile* file : {&facts.approved, &facts.file}) {
        file->parts[0].metadata.clear();
        file->parts[0].compression.clear();
    }
    return facts;
}

class RecordOfAFrame : public testing::Test {
protected:
    void SetUp() override {
        for (size_t i = 0; i < 2; ++i) {
            files[i] = OIIO::Filesystem::unique_path(testing::TempDir() + "tonetool-%%%%%%%%.exr");
            images[i] = render(unsigned(i));
            ASSERT_TRUE(images[i].write(files[i]));
        }
    }
    void TearDown() override {
        for (const std::string& file : files)
            std::filesystem::remove(file);
    }
    std::string files[2];
    ImageBuf images[2];
};

TEST_F(RecordOfAFrame, OfQc) {
    const std::string one = to_json(QcRecord{qc_of(images[0], 1)});
    EXPECT_EQ(to_json(QcRecord{qc_of(images[0], 4)}), one);
    EXPECT_EQ(to_json(QcRecord{qc_of(ImageBuf(files[0]), 1)}), one);
    EXPECT_EQ(to_json(QcRecord{qc_of(ImageBuf(files[0]), 4)}), one);
    EXPECT_NE(to_json(QcRecord{qc_of(images[1], 1)}), one);
    const QcPicture picture = qc_of(images[0], 3).picture;
    EXPECT_GT(picture.fine, 0);
    EXPECT_FALSE(picture.spikes.empty());
    EXPECT_EQ(picture.rectangles.size(), 1U);
    EXPECT_EQ(qc_of(images[0], 3).guides.size(), 2U);
}

TEST_F(RecordOfAFrame, OfAgainst) {
    const auto record = [](const ImageBuf& approved, const ImageBuf& image, int threads) {
        return to_json(record_of(against_of(approved, image, threads), {}));
    };
    const std::string one = record(images[0], images[1], 1);
    EXPECT_EQ(record(images[0], images[1], 4), one);
    EXPECT_EQ(record(ImageBuf(files[0]), ImageBuf(files[1]), 1), one);
    EXPECT_EQ(record(ImageBuf(files[0]), images[1], 4), one);
    EXPECT_EQ(against_from_json(one).layers.size(), 9U);
    EXPECT_NE(record(images[0], images[0], 1), one);
}

} // namespace
} // namespace tonetool::sequence
