// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lut/lut_acv.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tonetool {
namespace {

std::string hex(const std::string& bytes) {
    static const char digits[] = "0123456789abcdef";
    std::string text;
    for (const char byte : bytes) {
        text += digits[(static_cast<unsigned char>(byte)) >> 4];
        text += digits[(static_cast<unsigned char>(byte)) & 15];
    }
    return text;
}

const AcvPoints kSame = {{0, 0}, {255, 255}};

// Written by another program from the format's description: 16 even points of a square root.
TEST(Acv, BytesAreBigEndianOutputsBeforeInputs) {
    AcvPoints points;
    for (int i = 0; i < 16; ++i)
        points.emplace_back(17 * i, int(std::lround(255 * std::sqrt(17.0 * i / 255))));
    EXPECT_EQ(hex(acv_bytes(points, {kSame, kSame, kSame})),
              "0004000500100000000000420011005d002200720033008400440093005500a1006600ae007700ba0088"
              "00c6009900d000aa00da00bb00e400cc00ed00dd00f600ee00ff00ff00020000000000ff00ff00020000"
              "000000ff00ff00020000000000ff00ff00020000000000ff00ff");
}

TEST(Acv, TheSplineGoesThroughItsPointsAndIsStraightAtItsEnds) {
    const AcvPoints points = {{0, 10}, {40, 90}, {41, 100}, {200, 210}, {255, 220}};
    const AcvCodes codes = acv_spline(points);
    for (const auto& [x, y] : points)
        EXPECT_NEAR(codes[size_t(x)], y, 1e-9) << x;
    // Natural: the second derivative is 0 at both ends.
    EXPECT_NEAR(codes[0] - 2 * codes[1] + codes[2], 0, 0.05);
    EXPECT_NEAR(codes[255] - 2 * codes[254] + codes[253], 0, 0.05);
}

TEST(Acv, OfAStraightLineHasTwoPoints) {
    AcvCodes codes;
    for (size_t i = 0; i < codes.size(); ++i)
        codes[i] = double(i);
    EXPECT_EQ(acv_points(codes), kSame);
}

TEST(Acv, PointsComeWhereTheSplineMisses) {
    AcvCodes codes;
    for (size_t i = 0; i < codes.size(); ++i)
        codes[i] = 255 * std::pow(double(i) / 255, 3);
    const AcvPoints points = acv_points(codes);
    EXPECT_LE(points.size(), 16U);
    const AcvCodes spline = acv_spline(points);
    for (size_t i = 0; i < codes.size(); ++i)
        EXPECT_NEAR(spline[i], codes[i], 0.75) << i;
}

} // namespace
} // namespace tonetool
