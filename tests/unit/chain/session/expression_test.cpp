// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/expression.h"

#include <gmock/gmock.h>
#include <sstream>

#include "chain/language/arithmetic.h"
#include "text/error.h"

namespace tonetool::chain {
namespace {

using testing::HasSubstr;

class Expression : public testing::Test {
protected:
    std::string value(const std::string& word) { return with_values(session, word); }
    std::string problem(const std::string& word) {
        try {
            return "no error but " + value(word);
        } catch (const CommandError& error) {
            return error.what();
        }
    }
    std::ostringstream out, err;
    Session session{out, err, "tonetool"};
};

TEST_F(Expression, ComputesAsOiiotoolDoes) {
    const std::pair<const char*, const char*> cases[] = {
        {"{1+2*3}", "7"},    {"{(1+2)*3}", "9"},     {"{7/2}", "3.5"},
        {"{7//2}", "3"},     {"{-7//2}", "-3"},      {"{7%3}", "1"},
        {"{3 -1}", "2"},     {"{1/3}", "0.333333"},  {"{1000000*10}", "1e+07"},
        {"{1<2&&2<3}", "1"}, {"{1||0}", "1"},        {"{1<=>2}", "-1"},
        {"{2>=2}", "1"},     {"{1!=1}", "0"},        {"{not(1)}", "0"},
        {"{!0}", "1"},       {"{eq('a','a')}", "1"}, {"{neq('a','a')}", "0"},
        {"{'1'==1.0}", "1"}};
    for (const auto& [word, expected] : cases)
        EXPECT_EQ(value(word), expected) << word;
}

TEST_F(Expression, StandsWithinAWordAndNotWithoutItsEnd) {
    EXPECT_EQ(value("a{1}b{2}c"), "a1b2c");
    EXPECT_EQ(value("{1} {2"), "1 {2");
    EXPECT_EQ(value("}{"), "}{");
    session.settings.evaluate = false;
    EXPECT_EQ(value("{1+1}"), "{1+1}");
}

TEST_F(Expression, KnowsVariablesAndTheFrame) {
    session.stack.variables.attribute("x", 3);
    session.stack.variables.attribute("name", "hello");
    session.frame.number = 7;
    session.frame.padding = 4;
    EXPECT_EQ(value("{x*x} {name}"), "9 hello");
    EXPECT_EQ(value("{FRAME_NUMBER} {FRAME_NUMBER_PAD}"), "7 0007");
}

TEST_F(Expression, KnowsImages) {
    OIIO::ImageSpec spec(4, 3, 2, OIIO::TypeFloat);
    spec.attribute("a/b", "deep inside");
    spec.x = 5;
    OIIO::ImageBuf pixels(spec);
    pixels.setpixel(5, 0, 0, std::vector<float>{2, 4}.data());
    session.stack.push(Image::created("below.exr", OIIO::ImageBuf(OIIO::ImageSpec(9, 9, 1))));
    session.stack.push(Image::created("dir/top.exr", std::move(pixels)));
    EXPECT_EQ(value("{TOP.width}x{TOP.height} {TOP.x} {TOP.nchannels}"), "4x3 5 2");
    EXPECT_EQ(value("{TOP.geom} {TOP.MAXCOLOR}"), "4x3+5+0 2,4");
    EXPECT_EQ(value("{TOP.'a/b'} {TOP[a/b]}"), "deep inside deep inside");
    EXPECT_EQ(value("{TOP.filename} {TOP.file_extension}"), "dir/top.exr .exr");
    EXPECT_EQ(value("{TOP.file_noextension} {IMG[1].width}"), "dir/top 9");
}

TEST_F(Expression, WhatIsNotUnderstoodIsAnErrorWithItsPlace) {
    EXPECT_THAT(problem("{1+}"), HasSubstr("syntax error at char 3 of '1+'"));
    EXPECT_THAT(problem("{TOP.width}"), HasSubstr("not a valid image"));
    EXPECT_THAT(problem("{nosuch}"), HasSubstr("syntax error"));
    EXPECT_THAT(problem("{'a'=='b'}"), HasSubstr("eq() and neq() compare text"));
    EXPECT_THAT(problem("{sin(1)}"), HasSubstr("valid: not, eq, neq, getattribute"));
}

TEST_F(Expression, IsLenientWithCompat) {
    session.settings.compat = true;
    EXPECT_EQ(value("{1+}"), "1+");
    EXPECT_EQ(session.outcome.errors, 1);
    EXPECT_THAT(err.str(), HasSubstr("expression : syntax error"));
}

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i)
        all += text;
    return all;
}

TEST_F(Expression, IsBoundedInItsDepth) {
    const int most = kMostNestedExpressions;
    EXPECT_EQ(value("{" + repeated("!", most - 1) + "1}"), "0");
    EXPECT_EQ(value("{" + repeated("(", most - 1) + "7" + repeated(")", most - 1) + "}"), "7");
    const std::string deep[] = {
        repeated("!", most) + "1",
        repeated("!", 10000) + "1",
        repeated("-+", 10000) + "1",
        repeated("(", 10000) + "1" + repeated(")", 10000),
        repeated("not(", 10000) + "1" + repeated(")", 10000),
        repeated("eq(1,", 10000) + "1" + repeated(")", 10000),
        repeated("1+(", 10000) + "1" + repeated(")", 10000),
    };
    for (const std::string& text : deep)
        EXPECT_THAT(problem("{" + text + "}"), HasSubstr("nested deeper than 100")) << text;
}

TEST_F(Expression, MayHaveAnyLengthBesideOneAnother) {
    EXPECT_EQ(value(repeated("{1}", 20000)), repeated("1", 20000));
    EXPECT_EQ(value("{0" + repeated("+1", 2000) + "}"), "2000");
    session.settings.compat = true;
    EXPECT_EQ(value("{1+}{" + repeated("!", 300) + "1}"), "1+" + repeated("!", 300) + "1");
    EXPECT_EQ(session.outcome.errors, 2);
}

TEST_F(Expression, DoesNotGrowWithoutAnEnd) {
    session.stack.variables.attribute("x", repeated("abcdefgh", 100000));
    EXPECT_EQ(value("{x}").size(), 800000U);
    EXPECT_THAT(problem("{x}{x}"), HasSubstr("longer than 1.0 MB"));
}

TEST(IsTrue, NeitherEmptyNorZeroNorFalse) {
    for (const char* word : {"1", "-0.5", "yes", "hello"})
        EXPECT_TRUE(is_true(word)) << word;
    for (const char* word : {"", "0", "0.0", "false", "No", "off"})
        EXPECT_FALSE(is_true(word)) << word;
}

} // namespace
} // namespace tonetool::chain
