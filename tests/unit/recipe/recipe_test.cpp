// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/recipe.h"

#include <gmock/gmock.h>

namespace tonetool::recipe {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Strings words(const std::string& text, const Parameters& given = {}) {
    return parse("tonetool 1\n" + text, given);
}

std::string error_of(const std::string& text, const Parameters& given = {}) {
    try {
        (void)words(text, given);
        return "none";
    } catch (const RecipeError& problem) {
        return problem.what();
    }
}

TEST(Recipe, WordsEndAtSpacesAndLineEnds) {
    EXPECT_THAT(words("a.exr  b.exr\t--hdrflip\r\n-o\n\nx"),
                ElementsAre("a.exr", "b.exr", "--hdrflip", "-o", "x"));
    EXPECT_THAT(words(""), IsEmpty());
    EXPECT_THAT(parse("tonetool 1", {}), IsEmpty());
    EXPECT_THAT(words("a\\\nb \\\n c"), ElementsAre("ab", "c"));
}

TEST(Recipe, CommentsBeginWords) {
    EXPECT_THAT(words("# first\na.#.exr # rest 'of\n#\nb#"), ElementsAre("a.#.exr", "b#"));
    EXPECT_THAT(words("'#' \\#x"), ElementsAre("#", "#x"));
}

TEST(Recipe, QuotesKeepWordsTogether) {
    EXPECT_THAT(words("'a b' \"c d\" e' 'f \"it's\" 'say \"x\"'"),
                ElementsAre("a b", "c d", "e f", "it's", "say \"x\""));
    EXPECT_THAT(words("\"a\\\"b\" a\\ b '\\$x' ''"), ElementsAre("a\"b", "a b", "\\$x", ""));
    EXPECT_THAT(error_of("a\n'b\nc"), HasSubstr("unfinished quotation, no closing '"));
    EXPECT_THAT(error_of("a\\"), HasSubstr("line 2: nothing after the backslash"));
}

TEST(Recipe, Parameters) {
    const std::string text = "$frame = 7\n$name=\"two words\" # said\n  $none =\n"
                             "a.$frame.exr ${frame}x \"$name\" $none$$ '$frame'";
    EXPECT_THAT(words(text), ElementsAre("a.7.exr", "7x", "two words", "$", "$frame"));
    EXPECT_THAT(words(text, {{"frame", "-o x"}, {"none", "$frame"}}),
                ElementsAre("a.-o x.exr", "-o xx", "two words", "$frame$", "$frame"));
    EXPECT_THAT(words("$a = 1\n$b = ${a}2\n$b"), ElementsAre("12"));
    EXPECT_THAT(words("x $a = 1", {{"a", "y"}}), ElementsAre("x", "y", "=", "1"));
}

// "A billion laughs."
TEST(Recipe, ParametersDoNotGrowWithoutAnEnd) {
    std::string text = "$a0 = 0123456789\n";
    for (int i = 1; i < 40; ++i) {
        const std::string before = "$a" + std::to_string(i - 1);
        text += "$a" + std::to_string(i) + " = " + before + before + "\n";
    }
    EXPECT_THAT(error_of(text + "$a39"), HasSubstr("longer than 16 MB"));
    EXPECT_EQ(words("$a = 0123456789\n$a$a$a").front().size(), 30U);
}

TEST(Recipe, ParametersThatAreNotThere) {
    EXPECT_THAT(error_of("a\nb $frame"), HasSubstr("line 3: parameter \"frame\" has no value"));
    EXPECT_THAT(error_of("$frame = 1", {{"fram", "2"}}),
                HasSubstr("no parameter \"fram\", did you mean \"frame\"? (valid: frame)"));
    EXPECT_THAT(error_of("a", {{"x", "2"}}), HasSubstr("(it has none)"));
    EXPECT_EQ(error_of("$x", {{"x", "2"}}), "none");
    EXPECT_THAT(error_of("${x"), HasSubstr("no name of a parameter"));
    EXPECT_THAT(error_of("${x", {{"x", "1"}}), HasSubstr("no name of a parameter"));
    EXPECT_THAT(error_of("$x = 1 2"), HasSubstr("one value after \"$x =\""));
}

} // namespace
} // namespace tonetool::recipe
