// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/suite/suite_file.h"

#include <gmock/gmock.h>

namespace tonetool::sequence {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

constexpr char kHead[] =
    "tonetool-suite = 1\nname = \"lookdev\"\nreference = \"refs/%N.exr\"\n"
    "test = \"renders/%N.exr\"\ncheck = \"--hdrflip:fail=mean=0.3,p99.9=0.6\"\n";

std::string refusal(const std::string& text) {
    try {
        (void)suite_from(text, "x/suite.toml");
    } catch (const std::runtime_error& problem) {
        return problem.what();
    }
    return "";
}

TEST(SuiteFile, LaterRowsWinKeyByKey) {
    Suite suite = suite_from(std::string(kHead) + R"(
[[case]]
name = "hair/*"
fail = "mean=0.45"
warn = "mean=0.4"

[[case]]
name = "*/long"
method = "p?"
fail = "mean=0.5"
why = "noisy"

[[case]]
name = "glass"
skip = "flaky until #123"
)",
                             "x/suite.toml");
    EXPECT_EQ(suite.name, "lookdev");
    EXPECT_EQ(suite.test_line, 4);
    EXPECT_EQ(suite.path(suite.test), "x/renders/%N.exr");
    SuiteSettings found = suite.settings_of("hair/long", "pt");
    EXPECT_EQ(found.at("fail").text, "mean=0.5");
    EXPECT_EQ(found.at("fail").line, 12);
    EXPECT_EQ(found.at("warn").text, "mean=0.4");
    EXPECT_EQ(suite.settings_of("hair/long", "bdpt").at("fail").text, "mean=0.45");
    EXPECT_EQ(suite.settings_of("glass", "").at("skip").text, "flaky until #123");
    EXPECT_TRUE(suite.settings_of("glas", "").empty());
    EXPECT_EQ(suite.unmatched({{"hair/long", "pt"}, {"glass", ""}}), "");
    EXPECT_THAT(suite.unmatched({{"hair/long", "pt"}}),
                AllOf(HasSubstr("matches no case"), HasSubstr("suite.toml"), HasSubstr("18")));
}

TEST(SuiteFile, WhatIsWrongIsShownWithItsLine) {
    const std::string head = kHead;
    const auto row = [&](const std::string& text) {
        return refusal(head + "[[case]]\n" + text + "\n");
    };
    const auto marked = AnyOf(HasSubstr("~~~"), HasSubstr("^--")); // by toml11 3, by 4
    EXPECT_THAT(
        row("fial = \"mean=0.4\""),
        AllOf(HasSubstr("fial"), HasSubstr("did you mean fail?"), HasSubstr(" 7 "), marked));
    EXPECT_THAT(row("fail = 0.3"), AllOf(HasSubstr("fail is a text"), marked));
    EXPECT_THAT(row("mask = \"m.png\""), HasSubstr("mask needs why"));
    EXPECT_THAT(row("ignore = \"8x8+0+0\""), HasSubstr("ignore needs why"));
    EXPECT_THAT(row("name = \"a\""), HasSubstr("says nothing"));
    EXPECT_THAT(row("skip = \"\""), HasSubstr("skip is empty"));
    EXPECT_THAT(refusal(head + "nmae = \"x\"\n"), HasSubstr("did you mean name?"));
    EXPECT_THAT(refusal(head + "case = \"x\"\n"), HasSubstr("list of rows"));
    EXPECT_THAT(refusal(head + "p99.9 = 0.6\n"), HasSubstr("no key \"p99\""));
    EXPECT_THAT(refusal("name = \"x\"\n"), HasSubstr("tonetool-suite = 1"));
    EXPECT_THAT(refusal("tonetool-suite = 2\n"), HasSubstr("another format"));
    EXPECT_THAT(refusal("tonetool-suite = 1\ntest = \"%N\"\n"), HasSubstr("has no check"));
    EXPECT_THAT(refusal("tonetool-suite = = 1\n"), HasSubstr("suite.toml"));
    EXPECT_NE(refusal(""), "");
}

// A case may be named as a glob is.
TEST(SuiteFile, ARowOfACasesWholeNameIsForThatCaseAlone) {
    Suite suite = suite_from(
        std::string(kHead) + "[[case]]\nname = \"a[1]\"\nfail = \"mean=0.9\"\n", "suite.toml");
    EXPECT_EQ(suite.unmatched({{"a[1]", ""}, {"a1", ""}}), "");
    EXPECT_EQ(suite.settings_of("a[1]", "").at("fail").text, "mean=0.9");
    EXPECT_TRUE(suite.settings_of("a1", "").empty());
    EXPECT_EQ(suite.unmatched({{"a1", ""}}), "");
    EXPECT_FALSE(suite.settings_of("a1", "").empty());
}

TEST(FitsGlob, StarsQuestionMarksAndBrackets) {
    for (const auto& [glob, text, fits] :
         std::vector<std::tuple<const char*, const char*, bool>>{{"*", "", true},
                                                                 {"*", "hair/long", true},
                                                                 {"hair/*", "hair/a/b", true},
                                                                 {"hair/*", "hair", false},
                                                                 {"*long", "hair/long", true},
                                                                 {"a*b*c", "aXbYbZc", true},
                                                                 {"a*b*c", "aXbY", false},
                                                                 {"?", "", false},
                                                                 {"?", "ab", false},
                                                                 {"a?c", "a/c", true},
                                                                 {"[a-c]x", "bx", true},
                                                                 {"[a-c]x", "dx", false},
                                                                 {"[!a-c]x", "dx", true},
                                                                 {"[!a-c]x", "ax", false},
                                                                 {"[]]", "]", true},
                                                                 {"[a", "[a", true},
                                                                 {"[a-]", "-", true},
                                                                 {"A", "a", false},
                                                                 {"", "", true},
                                                                 {"", "a", false},
                                                                 {"**", "abc", true}})
        EXPECT_EQ(fits_glob(glob, text), fits) << glob << " " << text;
}

} // namespace
} // namespace tonetool::sequence
