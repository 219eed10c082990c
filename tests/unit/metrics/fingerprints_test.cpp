// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/fingerprints.h"

#include <algorithm>
#include <gmock/gmock.h>
#include <random>

namespace tonetool::metrics {
namespace {

using testing::Each;
using testing::Ge;
using testing::Le;

// Pixels by their coordinates, from (x, y) on.
struct Picture {
    int64_t x, y, width, height;
    std::vector<float> rgb;
    float* at(int64_t column, int64_t row) {
        return &rgb[size_t(3 * ((row - y) * width + column - x))];
    }
};

Picture noise(int64_t x, int64_t y, int64_t width, int64_t height) {
    Picture picture{x, y, width, height, std::vector<float>(size_t(3 * width * height))};
    for (int64_t row = y; row < y + height; ++row)
        for (int64_t column = x; column < x + width; ++column) {
            std::mt19937 random(unsigned(row * 10007 + column));
            std::generate_n(picture.at(column, row), 3,
                            [&] { return std::generate_canonical<float, 24>(random); });
        }
    return picture;
}

constexpr int64_t kLeft = 10, kTop = 20, kWidth = 160, kHeight = 90;
constexpr size_t kWide = 8, kHigh = 6;

std::vector<uint16_t> codes_of(const Picture& picture) {
    FingerprintScan scan(kLeft, kTop, kWidth, kHeight, kWide, kHigh);
    for (int64_t row = 0; row < picture.height; ++row) {
        const auto begin = picture.rgb.begin() + std::ptrdiff_t(3 * row * picture.width);
        scan.add_row(picture.y + row, {begin, begin + std::ptrdiff_t(3 * picture.width)},
                     picture.x);
    }
    return scan.codes();
}

TEST(FingerprintScan, PicturesHaveCodesAndWhatIsConstantHasNone) {
    const std::vector<uint16_t> codes = codes_of(noise(kLeft, kTop, kWidth, kHeight));
    ASSERT_EQ(codes.size(), kWide * kHigh);
    EXPECT_THAT(codes, Each(Ge(1)));
    EXPECT_THAT(codes, Each(Le(65535)));
    Picture one = noise(kLeft, kTop, kWidth, kHeight);
    std::fill(one.rgb.begin(), one.rgb.end(), 0.5f);
    EXPECT_THAT(codes_of(one), Each(0));
    for (size_t i = 1; i < one.rgb.size(); i += 3)
        one.rgb[i] = 0.25f; // one colour, not one value
    EXPECT_THAT(codes_of(one), Each(0));
}

TEST(FingerprintScan, APixelInTheMiddleOfACellChangesItsCodeAlone) {
    const std::vector<uint16_t> before = codes_of(noise(kLeft, kTop, kWidth, kHeight));
    // Cells are 20 x 15 pixels; the squares are at their centres.
    const int64_t x = kLeft + 3 * 20 + 10, y = kTop + 2 * 15 + 7;
    for (const int64_t offset : {-2, 1}) {
        Picture changed = noise(kLeft, kTop, kWidth, kHeight);
        changed.at(x + offset, y + offset)[2] *= 1.001f;
        std::vector<uint16_t> after = codes_of(changed);
        EXPECT_NE(after[2 * kWide + 3], before[2 * kWide + 3]);
        after[2 * kWide + 3] = before[2 * kWide + 3];
        EXPECT_EQ(after, before);
    }
    for (const int64_t offset : {-3, 2}) {
        Picture changed = noise(kLeft, kTop, kWidth, kHeight);
        changed.at(x + offset, y)[0] = 7;
        EXPECT_EQ(codes_of(changed), before);
    }
}

TEST(FingerprintScan, OverscanDoesNotMatter) {
    const std::vector<uint16_t> codes = codes_of(noise(kLeft, kTop, kWidth, kHeight));
    EXPECT_EQ(codes_of(noise(0, 0, kWidth + 40, kHeight + 40)), codes);
    EXPECT_EQ(codes_of(noise(kLeft - 3, kTop + 1, kWidth + 3, kHeight - 2)), codes);
}

// Pixels beside the picture are black, and where rows lack there is no code.
TEST(FingerprintScan, ACroppedPictureHasTheCodesOfWhatItHas) {
    const std::vector<uint16_t> codes = codes_of(noise(kLeft, kTop, kWidth, kHeight));
    const std::vector<uint16_t> right = codes_of(noise(kLeft + 80, kTop, 80, kHeight));
    const std::vector<uint16_t> upper = codes_of(noise(kLeft, kTop, kWidth, 45));
    for (size_t i = 0; i < codes.size(); ++i) {
        EXPECT_EQ(right[i], i % kWide < 4 ? 0 : codes[i]) << i;
        EXPECT_EQ(upper[i], i / kWide < 3 ? codes[i] : 0) << i;
    }
}

TEST(FingerprintScan, WantsTheRowsOfItsSquares) {
    const FingerprintScan scan(kLeft, kTop, kWidth, kHeight, kWide, kHigh);
    int64_t wanted = 0;
    for (int64_t y = kTop; y < kTop + kHeight; ++y)
        wanted += scan.wants(y);
    EXPECT_EQ(wanted, int64_t(kHigh) * FingerprintScan::kSize);
    EXPECT_TRUE(scan.wants(kTop + 5));
    EXPECT_TRUE(scan.wants(kTop + 8));
    EXPECT_FALSE(scan.wants(kTop + 4));
    EXPECT_FALSE(scan.wants(kTop + 9));
}

} // namespace
} // namespace tonetool::metrics
