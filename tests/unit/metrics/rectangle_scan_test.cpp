// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/rectangle_scan.h"

#include <cmath>
#include <gmock/gmock.h>
#include <limits>

namespace tonetool::metrics {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A picture whose pixels all differ.
struct Picture {
    int64_t width, height;
    std::vector<float> rgb;

    Picture(int64_t w, int64_t h) : width(w), height(h), rgb(size_t(3 * w * h)) {
        for (size_t i = 0; i < rgb.size(); ++i)
            rgb[i] = 1 + float(i);
    }
    void fill(int64_t x, int64_t y, int64_t w, int64_t h, float value) {
        for (int64_t row = y; row < y + h; ++row)
            for (int64_t i = 3 * x; i < 3 * (x + w); ++i)
                rgb[size_t(3 * row * width + i)] = value;
    }
    std::vector<FlatRun> runs(int64_t y) const {
        return scan_runs(&rgb[size_t(3 * y * width)], width, 100);
    }
    std::vector<FlatRectangle> rectangles(size_t most = 16, int64_t pixels = 100000) const {
        RectangleScan scan(most);
        for (int64_t y = 0; y < height; ++y)
            scan.add_row(50 + y, runs(y));
        return scan.finish(pixels);
    }
};

testing::Matcher<FlatRectangle> at(int64_t x, int64_t y, int64_t width, int64_t height) {
    return testing::Truly([=](const FlatRectangle& r) {
        return r.run.x == x && r.y == y && r.run.width == width && r.height == height;
    });
}

TEST(RectangleScan, RunsAreMaximalAndHaveEightPixels) {
    Picture picture(40, 1);
    picture.fill(3, 0, 8, 1, 0.5f);
    picture.fill(20, 0, 7, 1, 0.5f);
    picture.fill(31, 0, 9, 1, 0);
    const std::vector<FlatRun> runs = picture.runs(0);
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_EQ(runs[0].x, 103);
    EXPECT_EQ(runs[0].width, 8);
    EXPECT_EQ(runs[1].x, 131);
    EXPECT_EQ(runs[1].width, 9);
    EXPECT_THAT(runs[1].color, Each(0U));
}

TEST(RectangleScan, NanIsEqualToNanAndMinusZeroToZero) {
    Picture picture(20, 1);
    picture.fill(0, 0, 10, 1, kNan);
    picture.fill(4, 0, 1, 1, -kNan);
    picture.fill(10, 0, 10, 1, 0);
    picture.fill(10, 0, 1, 1, -0.0f);
    const std::vector<FlatRun> runs = picture.runs(0);
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_EQ(runs[0].width, 10);
    EXPECT_EQ(runs[1].width, 10);
    EXPECT_THAT(runs[1].color, Each(0U));
}

TEST(RectangleScan, RowsWithTheSameRunAreARectangle) {
    Picture picture(64, 40);
    picture.fill(5, 3, 16, 12, 0);
    picture.fill(30, 3, 16, 7, 0);   // too low
    picture.fill(40, 20, 24, 20, 2); // to the border
    EXPECT_THAT(picture.rectangles(), ElementsAre(at(105, 53, 16, 12), at(140, 70, 24, 20)));
}

// What darkness leaves: the runs differ from row to row.
TEST(RectangleScan, ARunOfAnotherLengthBeginsAnother) {
    Picture picture(64, 20);
    for (int64_t y = 0; y < 20; ++y)
        picture.fill(10, y, 20 + y % 2, 1, 0);
    EXPECT_THAT(picture.rectangles(), IsEmpty());
    for (int64_t y = 0; y < 20; ++y)
        picture.fill(10, y, 21, 1, y < 10 ? 0 : kNan);
    EXPECT_THAT(picture.rectangles(), ElementsAre(at(110, 50, 21, 10), at(110, 60, 21, 10)));
}

TEST(RectangleScan, TheLargestAreKeptByRow) {
    Picture picture(400, 400);
    for (int64_t i = 0; i < 40; ++i)
        picture.fill(10 * (i % 37), 10 * i, 9, 8 + (i == 30 || i == 7), 0);
    EXPECT_THAT(picture.rectangles(2), ElementsAre(at(170, 120, 9, 9), at(400, 350, 9, 9)));
    EXPECT_EQ(picture.rectangles(16).size(), 16U);
    picture.fill(0, 0, 400, 399, 0);
    EXPECT_THAT(picture.rectangles(16, 400 * 390), IsEmpty());
}

TEST(BorderScan, SharesAreOfThirtyTwoParts) {
    BorderScan border;
    for (int64_t i = 0; i < 64; ++i)
        border.add(i, 64, i == 0 || i >= 62);
    const auto shares = border.shares();
    EXPECT_EQ(shares[0], 50);
    EXPECT_EQ(shares[1], 0);
    EXPECT_EQ(shares[31], 100);
}

} // namespace
} // namespace tonetool::metrics
