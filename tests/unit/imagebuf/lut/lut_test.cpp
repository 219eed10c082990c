// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/lut.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "files.h"

namespace tonetool {
namespace {

class Lut : public ::testing::Test {
protected:
    std::string path(const std::string& name) const { return m_folder / name; }

    std::string text(const std::string& name) const {
        std::ifstream file(path(name));
        std::ostringstream out;
        out << file.rdbuf();
        return out.str();
    }

    std::string failure(const LutOptions& options, const std::string& name = "lut.cube") const {
        std::string error;
        EXPECT_FALSE(ToneAlgo::export_lut(path(name), options, nullptr, error));
        EXPECT_FALSE(std::filesystem::exists(path(name)));
        return error;
    }

    Folder m_folder;
};

TEST_F(Lut, SaysWhatItWroteAndHowFarItIsOff) {
    LutOptions options;
    options.curve.name = "hable";
    LutSummary summary;
    std::string error;
    ASSERT_TRUE(ToneAlgo::export_lut(path("lut.spi1d"), options, &summary, error)) << error;
    EXPECT_EQ(summary.format, "spi1d");
    EXPECT_EQ(summary.structure, "1D 4096");
    EXPECT_EQ(summary.low, 0);
    EXPECT_NEAR(summary.high, 1024, 1e-6);
    EXPECT_GT(summary.samples, 100000);
    EXPECT_GT(summary.max_error, 0);
    EXPECT_LT(summary.max_error, 1e-3);
    EXPECT_LE(summary.mean_error, summary.grey_max_error);
    EXPECT_LE(summary.grey_max_error, summary.max_error);
}

TEST_F(Lut, TheStructureFollowsTheCurveAndTheFormat) {
    const std::vector<std::array<std::string, 3>> expected = {
        {"aces", "cube", "1D 16"},     {"aces", "clf", "1D 16"},
        {"agx", "cube", "3D 16"},      {"agx", "clf", "matrix, 1D 16, matrix"},
        {"reinhard", "clf", "3D 16"},  {"reinhard", "ctf", "xyY, 1D 16 of Y"},
        {"neutral", "spi3d", "3D 16"}, {"neutral", "ctf", "HSV, 3 x 1D 16"}};
    for (const auto& [curve, format, structure] : expected) {
        LutOptions options;
        options.curve.name = curve;
        options.size = 16;
        LutSummary summary;
        std::string error;
        ASSERT_TRUE(ToneAlgo::export_lut(path("lut." + format), options, &summary, error)) << error;
        EXPECT_EQ(summary.structure, structure) << curve << " " << format;
    }
}

TEST_F(Lut, NumbersHaveSixDigits) {
    LutOptions options;
    options.curve.name = "linear";
    options.encode = "none";
    options.shaper = "linear";
    options.size = 4;
    std::string error;
    ASSERT_TRUE(ToneAlgo::export_lut(path("lut.spi1d"), options, nullptr, error)) << error;
    EXPECT_NE(text("lut.spi1d").find("    0\n    0.333333\n    0.666667\n    1\n"),
              std::string::npos);
}

TEST_F(Lut, WhatIsNotValidIsAnErrorThatSaysWhatWouldBe) {
    LutOptions options;
    options.shaper = "cineon";
    EXPECT_NE(failure(options).find("log2, acescct, linear"), std::string::npos);
    options = {};
    options.encode = "pq";
    EXPECT_NE(failure(options).find("srgb"), std::string::npos);
    options = {};
    options.size = -1;
    EXPECT_NE(failure(options).find("2 to 65536"), std::string::npos);
    options = {};
    options.min = std::numeric_limits<double>::quiet_NaN();
    EXPECT_NE(failure(options).find("-24 to 0"), std::string::npos);
    options = {};
    options.max = 17;
    EXPECT_NE(failure(options).find("1 to 16"), std::string::npos);
    options = {};
    options.curve.name = "nosuch";
    EXPECT_NE(failure(options).find("agx"), std::string::npos);
    EXPECT_NE(failure({}, "lut.3dl").find(".cube"), std::string::npos);
}

} // namespace
} // namespace tonetool
