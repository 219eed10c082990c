// SPDX-License-Identifier: BSD-3-Clause
#include "text/text.h"

#include <gmock/gmock.h>

namespace tonetool::chain {
namespace {

using testing::ElementsAre;

TEST(ParseSize, TakesWholeNumbersWithAUnit) {
    EXPECT_EQ(parse_size("1"), 1u);
    EXPECT_EQ(parse_size("268435456"), uint64_t(1) << 28);
    EXPECT_EQ(parse_size("256M"), uint64_t(1) << 28);
    EXPECT_EQ(parse_size("3K"), 3u * 1024);
    EXPECT_EQ(parse_size("8589934591G"), ((uint64_t(1) << 33) - 1) << 30);
    for (const char* bad : {"", "0", "00K", "K", "1.5G", "-1", "+1", " 1", "1 ", "1k", "1MB", "1T",
                            "8589934592G", "99999999999999999999"})
        EXPECT_FALSE(parse_size(bad)) << bad;
}

TEST(ParseNumber, TakesDecimals) {
    const std::pair<const char*, double> cases[] = {
        {"0", 0},         {"-2", -2},     {"+1.5", 1.5},  {".5", 0.5},
        {"5.", 5},        {"1e-3", 1e-3}, {"1E+3", 1000}, {"-0.25e2", -25},
        {"1e300", 1e300}, {"00.10", 0.1}, {"1e-400", 0}};
    for (const auto& [text, value] : cases) {
        ASSERT_TRUE(parse_number(text).has_value()) << text;
        EXPECT_EQ(*parse_number(text), value) << text;
    }
}

TEST(ParseNumber, RefusesEverythingElse) {
    for (const char* text :
         {"",    " ",     " 1",    "1 ",     "0,05", "5%",    "abc",  "nan", "NaN",
          "inf", "-inf",  "0x10",  "1e",     "1e+",  "e5",    ".",    "-",   "+",
          "--1", "1.2.3", "1e400", "-1e400", "1f",   "1_000", "1e5.0"})
        EXPECT_FALSE(parse_number(text).has_value()) << '"' << text << '"';
}

TEST(ParseInteger, TakesWholeNumbersOnly) {
    EXPECT_EQ(parse_integer("12"), 12);
    EXPECT_EQ(parse_integer("-7"), -7);
    EXPECT_EQ(parse_integer("2147483647"), 2147483647);
    for (const char* text :
         {"", "1.0", "1e3", "2147483648", "99999999999999999999", "x", "0x1", " 1", "-", "1 "})
        EXPECT_FALSE(parse_integer(text).has_value()) << '"' << text << '"';
}

TEST(FormatApart, NeverShowsDifferentNumbersAlike) {
    EXPECT_EQ(format_apart(0.05, 0.25), "0.05");
    EXPECT_NE(format_apart(0.05000001, 0.05), format_apart(0.05, 0.05000001));
    EXPECT_NE(format_apart(0.050000000000001, 0.05), format_apart(0.05, 0.050000000000001));
    EXPECT_EQ(format_apart(0.05, 0.05), "0.05");
}

TEST(Split, KeepsEmptyWords) {
    EXPECT_THAT(split("a,,b,", ','), ElementsAre("a", "", "b", ""));
    EXPECT_THAT(split("", ','), ElementsAre(""));
}

TEST(ShellQuoted, QuotesWhatAShellWouldSplit) {
    EXPECT_EQ(shell_quoted("--a:b=c"), "--a:b=c");
    EXPECT_EQ(shell_quoted("a b"), "'a b'");
    EXPECT_EQ(shell_quoted(""), "''");
    EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
}

} // namespace
} // namespace tonetool::chain
