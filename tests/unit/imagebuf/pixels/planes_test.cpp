// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/color_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cfloat>
#include <cmath>
#include <limits>

#include "imagebuf/pixels/colorimetry.h"
#include "images.h"
#include "refusal.h"

namespace tonetool {
namespace {

using testing::Each;
using testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

ColorPlanes read(const ImageBuf& image, const PixelOptions& options = {}, ROI region = {},
                 bool alpha = false) {
    return read_planes(image, options, region.defined() ? region : image.roi(), alpha, 1);
}

TEST(ReadPlanes, FindsChannelsInAnyOrder) {
    const auto image = noise(make_spec(7, 70, {"A", "B", "Z", "G", "R"}), 1);
    const auto all = values(image);
    const ColorPlanes planes = read(image);
    const size_t source[3] = {4, 3, 1};
    for (size_t p = 0; p < 3; ++p)
        for (size_t i = 0; i < planes.plane[p].size(); ++i)
            ASSERT_EQ(planes.plane[p][i], all[i * 5 + source[p]]);
    EXPECT_EQ(planes.counts.nonfinite + planes.counts.negative + planes.uncovered_count, 0);
}

template <typename T>
void expect_srgb_decoded(OIIO::TypeDesc format, const std::vector<T>& stored, double most) {
    ImageBuf image(make_spec(int(stored.size()), 1, {"R", "G", "B"}, format));
    std::vector<T> rgb;
    for (T v : stored)
        rgb.insert(rgb.end(), 3, v);
    image.set_pixels(image.roi(), format, rgb.data());
    const ColorPlanes planes = read(image);
    for (const auto& plane : planes.plane)
        for (size_t i = 0; i < stored.size(); ++i) {
            const double exact = srgb_to_linear(double(stored[i]) / most);
            // v / most in float, its error times the slope 2.3 of the curve.
            EXPECT_NEAR(plane[i], exact, 2e-7) << stored[i];
        }
}

TEST(ReadPlanes, DecodesSrgbIntegers) {
    std::vector<uint8_t> bytes;
    std::vector<uint16_t> words;
    for (int i = 0; i < 256; ++i) {
        bytes.push_back(uint8_t(i));
        words.push_back(uint16_t(i * 257));
    }
    expect_srgb_decoded(OIIO::TypeUInt8, bytes, 255);
    expect_srgb_decoded(OIIO::TypeUInt16, words, 65535);
}

TEST(ReadPlanes, ConvertsToRec709) {
    auto spec = make_spec(9, 9, {"R", "G", "B"});
    spec.attribute("oiio:ColorSpace", "acescg");
    const auto image = noise(spec, 2);
    const ColorSpace space = find_space(spec, "");
    const auto all = values(image);
    const ColorPlanes planes = read(image);
    int64_t negative = 0;
    for (size_t i = 0; i < 81; ++i) {
        bool below = false;
        for (size_t p = 0; p < 3; ++p) {
            const auto& m = space.to_rec709[p];
            const double v = m[0] * double(all[3 * i]) + m[1] * double(all[3 * i + 1]) +
                             m[2] * double(all[3 * i + 2]);
            below = below || v < 0;
            ASSERT_EQ(planes.plane[p][i], float(std::max(v, 0.0)));
        }
        negative += below;
    }
    EXPECT_EQ(planes.counts.negative, negative);
    EXPECT_GT(negative, 0) << "ACEScg noise leaves Rec.709";
}

TEST(ReadPlanes, CountsAndMendsPixelsNotValues) {
    auto image = constant(8, 3, {1, 2, 3});
    image = with_pixel(image, 0, 0, {kNan, kNan, 3});
    image = with_pixel(image, 1, 0, {1, -kInf, 3});
    image = with_pixel(image, 2, 0, {-1, -2, 3});
    image = with_pixel(image, 3, 0, {-1e-30f, 2, 3});
    image = with_pixel(image, 4, 0, {-0.0f, 2, 3});
    image = with_pixel(image, 5, 0, {FLT_MAX, 2, 3});
    const ColorPlanes planes = read(image);
    EXPECT_EQ(planes.counts.nonfinite, 2);
    EXPECT_EQ(planes.counts.negative, 2) << "-0 is not negative";
    EXPECT_EQ(planes.nonfinite[0], 3 | 3 << 2) << "NaN, NaN, a number";
    EXPECT_EQ(planes.nonfinite[1], 2 << 2) << "a number, -Inf, a number";
    EXPECT_EQ(planes.plane[2][0], 0.0f) << "a non-finite pixel is black in all channels";
    EXPECT_EQ(planes.plane[1][2], 0.0f);
    EXPECT_EQ(planes.plane[2][2], 3.0f) << "negative components alone become 0";
    EXPECT_EQ(planes.counts.largest, FLT_MAX);
}

TEST(ReadPlanes, OutsideTheDataWindowIsBlack) {
    auto spec = make_spec(4, 3, {"R", "G", "B", "A"});
    spec.x = 2;
    spec.y = -1;
    const auto image = constant(spec, {1, 1, 1, 0.5f});
    const ColorPlanes planes = read(image, {}, ROI(0, 8, -2, 4, 0, 1, 0, 1), true);
    EXPECT_EQ(planes.uncovered_count, 48 - 12);
    for (int y = -2; y < 4; ++y)
        for (int x = 0; x < 8; ++x) {
            const bool inside = x >= 2 && x < 6 && y >= -1 && y < 2;
            const auto i = size_t((y + 2) * 8 + x);
            EXPECT_EQ(planes.plane[0][i], inside ? 1.0f : 0.0f) << x << "," << y;
            EXPECT_EQ(planes.alpha[i], inside ? 0.5f : 0.0f) << x << "," << y;
        }
}

TEST(ReadPlanes, MissingAlphaIsOpaqueWithinTheDataWindow) {
    auto spec = make_spec(2, 2, {"R", "G", "B"});
    const auto image = constant(spec, {1, 1, 1});
    const ColorPlanes planes = read(image, {}, {}, true);
    EXPECT_THAT(planes.alpha, Each(1.0f));
    const ColorPlanes wider = read(image, {}, ROI(0, 3, 0, 2, 0, 1, 0, 1), true);
    EXPECT_EQ(wider.alpha[2], 0.0f);
}

TEST(ReadPlanes, ThreadsDoNotChangeABit) {
    const auto image = noise(33, 300, 5);
    const ColorPlanes one = read(image);
    for (int n : {2, 3, 8}) {
        const ColorPlanes many = read_planes(image, {}, image.roi(), false, n);
        for (int p = 0; p < 3; ++p)
            EXPECT_TRUE(one.plane[p] == many.plane[p]);
    }
}

TEST(CheckReadable, SaysWhatIsWrong) {
    const auto error = [](const ImageBuf& image, const char* what = "test") {
        return refusal([&] { check_readable(image, what); });
    };
    EXPECT_THAT(error(ImageBuf(), "reference"), HasSubstr("reference image: is not initialized"));
    const ImageBuf missing("no/such/file.exr");
    EXPECT_THAT(error(missing), HasSubstr("test image \"no/such/file.exr\""));
    const ImageBuf deep(TESTIMAGES_DIR "/deep.exr");
    EXPECT_THAT(error(deep), HasSubstr("deep images are not supported"));
    auto volume = make_spec(2, 2, {"R", "G", "B"});
    volume.depth = volume.full_depth = 2;
    EXPECT_THAT(error(ImageBuf(volume)), HasSubstr("volumes are not supported"));
    EXPECT_EQ(error(noise(2, 2, 1)), "");
}

} // namespace
} // namespace tonetool
