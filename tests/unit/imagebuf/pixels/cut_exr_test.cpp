// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/cut_exr.h"

#include <OpenImageIO/deepdata.h>
#include <gmock/gmock.h>

#include "imagebuf/files.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;

uint64_t size_of(const std::string& file) {
    return std::filesystem::file_size(file);
}

// Written by OpenEXR: every kind of file that it has, the last chunk at its end.
std::vector<std::string> kinds_of_files(const Folder& folder) {
    std::vector<std::string> files;
    const auto written = [&](const std::string& name, const std::vector<ImageSpec>& parts) {
        const std::string file = (folder / name);
        auto out = OIIO::ImageOutput::create(file);
        EXPECT_TRUE(out->open(file, int(parts.size()), parts.data()));
        for (size_t i = 0; i < parts.size(); ++i) {
            if (i > 0)
                EXPECT_TRUE(out->open(file, parts[i], OIIO::ImageOutput::AppendSubimage));
            const std::vector<float> pixels(size_t(parts[i].width * parts[i].height * 3), 0.3f);
            EXPECT_TRUE(out->write_image(OIIO::TypeFloat, pixels.data()));
        }
        EXPECT_TRUE(out->close());
        files.push_back(file);
    };
    for (const char* compression : {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "dwaa"}) {
        for (const int tile : {0, 16}) {
            ImageSpec spec(70, 45, 3, OIIO::TypeHalf);
            spec.attribute("compression", compression);
            spec.tile_width = spec.tile_height = tile;
            const std::string name = std::string(compression) + std::to_string(tile);
            written(name + ".exr", {spec});
            ImageSpec first = spec, second = spec;
            first.attribute("oiio:subimagename", "a");
            second.attribute("oiio:subimagename", "b");
            written(name + "parts.exr", {first, second});
        }
    }
    ImageSpec decreasing(70, 45, 3, OIIO::TypeFloat);
    decreasing.attribute("compression", "none");
    decreasing.attribute("openexr:lineOrder", "decreasingY");
    written("decreasing.exr", {decreasing});
    files.emplace_back(TESTIMAGES_DIR "/deep.exr");
    files.emplace_back(TESTIMAGES_DIR "/cornell_ref.exr");
    return files;
}

TEST(CutExr, AFileEndsWithItsLastChunk) {
    const Folder folder;
    for (const std::string& file : kinds_of_files(folder))
        EXPECT_EQ(ExrEnd(file).bytes(), size_of(file)) << file;
}

TEST(CutExr, WhatIsCutOffIsMissing) {
    const Folder folder;
    for (const std::string& file : kinds_of_files(folder)) {
        const std::string cut = (folder / "cut.exr");
        for (const uint64_t bytes : {1, 20, 40}) {
            std::filesystem::copy_file(file, cut,
                                       std::filesystem::copy_options::overwrite_existing);
            std::filesystem::resize_file(cut, size_of(file) - bytes);
            EXPECT_GT(ExrEnd(cut).bytes(), size_of(cut)) << file << " without " << bytes;
        }
    }
}

TEST(CutExr, WhatIsNoSuchFileTellsNothing) {
    const Folder folder;
    EXPECT_EQ(ExrEnd((folder / "nothing.exr")).bytes(), 0);
    EXPECT_EQ(ExrEnd(TESTIMAGES_DIR "/filmstrip.png").bytes(), 0);
}

} // namespace
} // namespace tonetool
