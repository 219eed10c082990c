// SPDX-License-Identifier: BSD-3-Clause
#include "chain/language/line.h"

#include <gmock/gmock.h>

#include "runs/runs.h"

namespace tonetool::runs {
namespace {

using chain::parse_line;
using chain::ParsedLine;
using chain::Word;
using testing::ElementsAre;

class Line : public testing::Test {
protected:
    void SetUp() override { know_all_commands(); }
};

// Each word with the words that it takes: "--attrib(a,b)".
Strings shape(const Strings& texts) {
    const ParsedLine line = parse_line(texts);
    Strings shapes;
    for (const Word& word : line.words) {
        Strings arguments;
        for (size_t at : word.arguments)
            arguments.push_back(line.texts[at]);
        if (!word.missing.empty())
            arguments.push_back("no " + word.missing);
        shapes.push_back(word.token.text +
                         (arguments.empty() ? "" : "(" + join(arguments, ",") + ")"));
    }
    return shapes;
}

TEST_F(Line, CommandsTakeTheirArguments) {
    EXPECT_THAT(shape({"a.exr", "--attrib", "x", "-1", "-o:all=1", "b.exr"}),
                ElementsAre("a.exr", "--attrib(x,-1)", "-o:all=1(b.exr)"));
    EXPECT_THAT(shape({"--nosuch", "a"}), ElementsAre("--nosuch", "a"));
}

TEST_F(Line, AForgottenArgumentIsNotTheNextCommand) {
    EXPECT_THAT(shape({"--frames", "--echo", "x"}), ElementsAre("--frames(no RANGE)", "--echo(x)"));
    EXPECT_THAT(shape({"--json", "--frames=1-3"}), ElementsAre("--json(no FILE)", "--frames(1-3)"));
    EXPECT_THAT(shape({"--label", "--frames=1-3"}), ElementsAre("--label(--frames=1-3)"));
    EXPECT_THAT(shape({"--json", "--compat"}), ElementsAre("--json(no FILE)", "--compat"));
    EXPECT_THAT(shape({"--mulc"}), ElementsAre("--mulc(no VALUES)"));
}

// oiiotool takes whatever is there; what it has not is as strict as ever.
TEST_F(Line, LenientlyItIs) {
    EXPECT_THAT(shape({"--compat", "--label", "--dup", "--frames", "--dup"}),
                ElementsAre("--compat", "--label(--dup)", "--frames(no RANGE)", "--dup"));
    EXPECT_THAT(shape({"--help", "--mulc"}), ElementsAre("--help(--mulc)"));
    EXPECT_THAT(shape({"--compat", "--help", "--mulc", "2"}),
                ElementsAre("--compat", "--help", "--mulc(2)"));
}

TEST_F(Line, ValuesOfWholeLinesStandApart) {
    EXPECT_THAT(
        parse_line({"--frames=1-9", "-jobs=2", "--json=a:b=c.json", "--progress=json"}).texts,
        ElementsAre("--frames", "1-9", "-jobs", "2", "--json", "a:b=c.json", "--progress=json"));
    EXPECT_THAT(parse_line({"--echo", "--nosuch=1", "--hdrflip=fail=1", "x=--frames=1"}).texts,
                ElementsAre("--echo", "--nosuch=1", "--hdrflip=fail=1", "x=--frames=1"));
}

TEST_F(Line, WildcardsHoldUntilTheyAreOff) {
    const ParsedLine line =
        parse_line({"a", "--wildcardoff", "b", "--echo", "x", "-wildcardon", "c"});
    std::vector<bool> on;
    for (const Word& word : line.words)
        on.push_back(word.wildcards);
    EXPECT_EQ(on, (std::vector<bool>{true, false, false, false, true, true}));
}

TEST_F(Line, IsToldAsItWasGiven) {
    const auto told = [](const Strings& texts, bool compat) {
        const ParsedLine line = parse_line(texts);
        return full_command_line(line, line.texts, compat);
    };
    EXPECT_EQ(told({"a b.exr", "--attrib", "x", "y"}, false), "tonetool 'a b.exr' --attrib x y");
    EXPECT_EQ(told({"a b.exr", "--attrib", "x", "y"}, true), "tonetool \"a b.exr\" --attrib x y");
    EXPECT_EQ(told({"a", "-sansattrib", "--attrib:type=int", "x", "1", "--sattrib", "a", "b", "-n"},
                   false),
              "tonetool a -n");
    EXPECT_EQ(told({"a", "--echo", "--attrib", "--attrib", "x", "y"}, true),
              "tonetool a --echo --attrib --attrib x y");
}

} // namespace
} // namespace tonetool::runs
