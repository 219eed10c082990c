// SPDX-License-Identifier: BSD-3-Clause
#include "text/token.h"

#include <gmock/gmock.h>

#include "text/error.h"

namespace tonetool::chain {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(ParseToken, BareWordsAndALoneDashAreFiles) {
    for (const char* word : {"a.exr", "-", "", "a:b=c.exr", "dir/-x"}) {
        EXPECT_FALSE(parse_token(word).is_command) << word;
        EXPECT_EQ(parse_token(word).text, word);
    }
}

TEST(ParseToken, OneDashIsTwo) {
    EXPECT_EQ(parse_token("-hdrflip").name, "hdrflip");
    EXPECT_EQ(parse_token("--hdrflip").name, "hdrflip");
    EXPECT_EQ(parse_token("--o").name, "o");
    EXPECT_EQ(parse_token("--").name, "");
    EXPECT_TRUE(parse_token("--").is_command);
}

TEST(ParseToken, TakesModifiers) {
    EXPECT_THAT(parse_token("--c:a=1:b=two").modifiers,
                ElementsAre(Pair("a", "1"), Pair("b", "two")));
    EXPECT_THAT(parse_token("--c:a='x: y=z':b=2").modifiers,
                ElementsAre(Pair("a", "x: y=z"), Pair("b", "2")));
    EXPECT_THAT(parse_token("--c:a=\"it's\"").modifiers, ElementsAre(Pair("a", "it's")));
    EXPECT_THAT(parse_token("--c:a=b=c").modifiers, ElementsAre(Pair("a", "b=c")));
}

TEST(ParseToken, RefusesMalformedModifiers) {
    for (const char* word :
         {"--c:", "--c::", "--c:a", "--c:a=", "--c:=1", "--c:a=1:", "--c:a=1::b=2", "--c:a=''",
          "--c:a='x", "--c:a='x'y", "--c:a b=1", "--c:1a=1", "--c:a-b=1", "--c:a:b=1"})
        EXPECT_THROW(parse_token(word), CommandError) << word;
}

TEST(ParseToken, LenientlyTellsWhatItDropped) {
    const Token token = parse_token("--c:a=1:bad:1x=3:b=2:", true);
    EXPECT_EQ(token.dropped, (std::vector<std::string>{"bad", "1x=3"}));
    EXPECT_EQ(token.modifiers.size(), 2U);
}

TEST(ParseToken, RefusesAModifierGivenTwice) {
    EXPECT_THROW(parse_token("--c:fail=0.5:fail=0.1"), CommandError);
}

TEST(ParseToken, LenientlyTellsItsFirstProblem) {
    EXPECT_EQ(parse_token("--c:a=1:a=2:bad", true).problem, "modifier \"a\" is given twice");
    EXPECT_EQ(parse_token("--c:bad:a=1:a=2", true).problem,
              "malformed modifier \"bad\", not key=value");
    EXPECT_EQ(parse_token("--c:a=1:b=2").problem, "");
}

TEST(ParseToken, AValueIsReplacedWhereItStands) {
    EXPECT_EQ(parse_token("--c:a=1:b='x:y':d=3").with_value("b", "z"), "--c:a=1:b=z:d=3");
    EXPECT_EQ(parse_token("--c:a=':b=1':b=2").with_value("b", "z"), "--c:a=':b=1':b=z");
    EXPECT_EQ(parse_token("-c:a=1").with_value("b", "z"), "-c:a=1");
    EXPECT_EQ(parse_token("-c:a='x:y'").with_value("a", "x:z"), "-c:a='x:z'");
    EXPECT_EQ(parse_token("-c:a=1").with_modifier("a", "2"), "-c:a=2");
    EXPECT_EQ(parse_token("-c:a=1").with_modifier("b", "it's:2"), "-c:a=1:b=\"it's:2\"");
    EXPECT_EQ(parse_token("-c:a=1").with_modifier("b", "it's").find("b=\"it's\""), 7u);
}

} // namespace
} // namespace tonetool::chain
