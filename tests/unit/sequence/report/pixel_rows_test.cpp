// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/pixel_rows.h"

#include <OpenImageIO/imagebuf.h>
#include <cstring>
#include <gtest/gtest.h>
#include <vector>

namespace tonetool::sequence {
namespace {

// OpenEXR's own halves are what OpenImageIO converts with.
TEST(PixelRows, HalvesAreTheNearest) {
    std::vector<float> values;
    for (uint64_t bits = 0; bits < 1ULL << 32; bits += 4093) {
        const auto word = uint32_t(bits);
        float value = 0;
        std::memcpy(&value, &word, sizeof value);
        values.push_back(value);
    }
    for (uint32_t half = 0; half < 65536; ++half) { // ties, and what lies beside them
        const uint32_t word = (half & 0x8000U) << 16 | (((half & 0x7fffU) << 13) + (112U << 23));
        for (const uint32_t beside : {word + 0xfffU, word + 0x1000U, word + 0x1001U}) {
            float value = 0;
            std::memcpy(&value, &beside, sizeof value);
            values.push_back(value);
        }
    }
    for (int i = 0; i < 2050; ++i) // quarters of the smallest
        values.push_back(float(i) / 67108864.0f);
    std::vector<uint16_t> own(values.size()), theirs(values.size());
    half_bits(values, own.data());
    OIIO::convert_pixel_values(OIIO::TypeFloat, values.data(), OIIO::TypeHalf, theirs.data(),
                               int(values.size()));
    for (size_t i = 0; i < values.size(); ++i)
        ASSERT_EQ(own[i], theirs[i]) << values[i];
}

OIIO::ImageBuf counted(OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(4, 3, 5, OIIO::TypeFloat);
    spec.x = 10;
    spec.y = -2;
    OIIO::ImageBuf image(spec);
    for (OIIO::ImageBuf::Iterator<float> pixel(image); !pixel.done(); ++pixel)
        for (int c = 0; c < 5; ++c)
            pixel[c] = float(100 * pixel.y() + 10 * pixel.x() + c);
    return image.copy(type);
}

TEST(PixelRows, ChannelsComeAsAskedFor) {
    for (const OIIO::TypeDesc& type : {OIIO::TypeFloat, OIIO::TypeHalf}) {
        const OIIO::ImageBuf image = counted(type);
        PixelRows rows(image, OIIO::ROI(11, 13, -1, 1), {3, 0, 1});
        EXPECT_EQ(rows.read(-1), (std::vector<float>{13, 10, 11, 23, 20, 21}));
        EXPECT_EQ(rows.read(0), (std::vector<float>{113, 110, 111, 123, 120, 121}));
    }
}

TEST(PixelRows, OutsideTheDataWindowAllIsBlack) {
    const OIIO::ImageBuf image = counted(OIIO::TypeFloat);
    PixelRows rows(image, OIIO::ROI(9, 12, -3, 0), {4, 0});
    EXPECT_EQ(rows.read(-3), (std::vector<float>{0, 0, 0, 0, 0, 0}));
    EXPECT_EQ(rows.read(-2), (std::vector<float>{0, 0, -96, -100, -86, -90}));
}

} // namespace
} // namespace tonetool::sequence
