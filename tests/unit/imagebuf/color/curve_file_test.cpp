// SPDX-License-Identifier: BSD-3-Clause
// Readers of curves. What each refuses stands in tests/cli/test_curve_files.py.
#include "imagebuf/color/curve_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "files.h"
#include "imagebuf/color/curve_plan.h"
#include "kernels/curve_reference.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CurveFile : public testing::Test {
protected:
    CurveOptions file(const std::string& name, const std::string& text) {
        CurveOptions options;
        options.name = m_folder / name;
        std::ofstream(options.name, std::ios::binary) << text;
        return options;
    }
    static std::string refusal(const CurveOptions& options) {
        try {
            read_curve_file(options);
        } catch (const Refusal& why) {
            return why.what();
        }
        return "none";
    }
    static double at(const CurveOptions& options, double x) {
        return kernels::curve_reference(plan_curve(options, false).numbers, x);
    }

    Folder m_folder;
};

TEST(CurveFileNames, HaveADotOrASlash) {
    EXPECT_TRUE(is_curve_file("x.csv"));
    EXPECT_TRUE(is_curve_file("./x"));
    EXPECT_FALSE(is_curve_file("reinhard-extended"));
    for (const std::string& name : ToneAlgo::tone_curve_names())
        EXPECT_FALSE(is_curve_file(name)) << name;
}

TEST_F(CurveFile, Spi1dHasEvenX) {
    const auto rows = read_curve_file(file(
        "a.spi1d", "Version 1\nFrom -1 3\nLength 3\nComponents 1\n{\n 0\n .5\n 2e0\n}\n# end"));
    EXPECT_THAT(rows.x, ElementsAre(-1, 1, 3));
    ASSERT_EQ(rows.y.size(), 1U);
    EXPECT_THAT(rows.y[0], ElementsAre(0, 0.5, 2));
}

TEST_F(CurveFile, CubeHasADomain) {
    const auto rows = read_curve_file(
        file("a.cube", "#\nLUT_1D_SIZE 2\nLUT_1D_INPUT_RANGE 1 5\n0 0.1 0.2\n1 0.9 0.8\n"));
    EXPECT_THAT(rows.x, ElementsAre(1, 5));
    ASSERT_EQ(rows.y.size(), 3U);
    EXPECT_THAT(rows.y[2], ElementsAre(0.2, 0.8));
}

TEST_F(CurveFile, CsvMayHaveATitleAndSigns) {
    const auto rows = read_curve_file(file("a.csv", "light, y\n+0, -1e-3\n1e0, +1\n"));
    EXPECT_THAT(rows.x, ElementsAre(0, 1));
    EXPECT_THAT(rows.y[0], ElementsAre(-1e-3, 1));
}

TEST_F(CurveFile, ATitleIsOneLineOnly) {
    EXPECT_THAT(refusal(file("a.csv", "x,y\nx,y\n0,0\n1,1\n")), HasSubstr("line 2"));
}

TEST_F(CurveFile, ItsExtensionCountsWithoutCase) {
    EXPECT_EQ(read_curve_file(file("A.CSV", "0,0\n1,1\n")).x.size(), 2U);
}

TEST_F(CurveFile, AsManyRowsAsAreAllowed) {
    std::string text;
    for (int i = 0; i < 65536; ++i)
        text += std::to_string(i) + "," + std::to_string(i / 65536.0) + "\n";
    EXPECT_EQ(read_curve_file(file("a.csv", text)).x.size(), 65536U);
    EXPECT_THAT(refusal(file("a.csv", text + "65536,1\n")), HasSubstr("line 65537"));
}

TEST_F(CurveFile, LongLinesAndManyLinesAreRefused) {
    EXPECT_THAT(refusal(file("a.csv", std::string(3 << 20, '1'))), HasSubstr("bytes"));
    EXPECT_THAT(refusal(file("a.csv", std::string(1 << 20, '\n'))), HasSubstr("lines"));
    EXPECT_THAT(refusal(file("a.csv", std::string(17 << 20, ' '))), HasSubstr("bytes"));
}

TEST_F(CurveFile, NumbersAreThoseOfPlainText) {
    for (const char* word : {"1e999", "-1e999", "nan", "inf", "1e10"})
        EXPECT_THAT(refusal(file("a.csv", std::string("0,0\n1,") + word + "\n")),
                    HasSubstr(std::string(word) + "\" cannot be in a curve"));
    for (const char* word : {"1;5", "0x1", "1 2", "", "++1", "1e", "--1"})
        EXPECT_THAT(refusal(file("a.csv", std::string("0,0\n1,") + word + "\n")),
                    HasSubstr("is not a number"))
            << word;
    EXPECT_EQ(read_curve_file(file("a.csv", "0,0\n1,1e-999\n")).y[0][1], 0);
}

TEST_F(CurveFile, DensitiesAreOfEachChannel) {
    CurveOptions options = file("a.csv", "0,3,2.5,2\n1,1,0.5,0\n");
    options.table_output = "density";
    const auto numbers = plan_curve(options, false).numbers;
    for (size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(kernels::curve_reference(numbers, c, 1.0), 1, 1e-12);
        EXPECT_NEAR(kernels::curve_reference(numbers, c, 0.0), 0.01, 1e-12);
        EXPECT_NEAR(kernels::curve_reference(numbers, c, 0.5), 0.1, 1e-6);
    }
}

TEST_F(CurveFile, EncodedResultsFollowTheEncodingBetweenRows) {
    CurveOptions options = file("a.csv", "0,0\n1,1\n");
    options.table_output = "encoded";
    const auto numbers = plan_curve(options, false, "gamma2.2").numbers;
    for (double x : {0.0003, 0.01, 0.3, 0.77})
        EXPECT_NEAR(kernels::curve_reference(numbers, x), std::pow(x, 2.2), 1e-6) << x;
}

TEST_F(CurveFile, ItsEndsAreHeld) {
    const CurveOptions options = file("a.csv", "1,0.2\n2,0.7\n");
    EXPECT_DOUBLE_EQ(at(options, 0), 0.2);
    EXPECT_DOUBLE_EQ(at(options, 1e12), 0.7);
}

TEST_F(CurveFile, FactsAreOfTheMeanOfTheChannels) {
    const auto plan =
        plan_curve(file("a.csv", "0,0,0,0\n1,0.9,0.6,0.6\n2,0.6,0.9,0.6\n3,0,1,0\n"), false);
    ASSERT_TRUE(plan.table);
    EXPECT_TRUE(plan.table->by_channel);
    EXPECT_NEAR(plan.table->largest, 0.7, 1e-12);
    ASSERT_TRUE(plan.table->falls_at);
    EXPECT_EQ(*plan.table->falls_at, 2);
    EXPECT_FALSE(tonemap::first_reach(plan.numbers, 0.85));
    EXPECT_NEAR(tonemap::first_reach(plan.numbers, 0.35).value_or(0), 0.5, 1e-12);
}

} // namespace
} // namespace tonetool
