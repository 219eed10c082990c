// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_text.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace tonetool::sequence {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Escaped, MarkupIsOnlyText) {
    EXPECT_EQ(escaped("<img src=x onerror=\"a('b')\">&"),
              "&lt;img src=x onerror=&quot;a(&#39;b&#39;)&quot;&gt;&amp;");
}

TEST(Escaped, BytesThatAreNoTextAreReplacedAndControlsAreSpaces) {
    EXPECT_EQ(escaped("a\xff.exr"), "a\xef\xbf\xbd.exr");
    EXPECT_EQ(escaped("a\n\x01"
                      "b"),
              "a  b");
    EXPECT_EQ(escaped("\xc3\xa9"), "\xc3\xa9");
}

TEST(ScriptData, IsTheSameValueWithoutACharacterOfMarkup) {
    const nlohmann::json value{{"<k>", "</script><!-- <img onerror=1> & \" \\ \xc3\xa9"}};
    const std::string data = script_data(value.dump());
    EXPECT_EQ(data.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(data), value);
}

TEST(Filled, WhatIsFilledInIsNotLookedAtAgain) {
    EXPECT_EQ(filled("a {{x}} {{y}} {", {{"x", "{{y}}"}, {"y", "$1 \\0 {{"}}),
              "a {{y}} $1 \\0 {{ {");
}

TEST(Filled, ANameWithoutAValueIsAnError) {
    try {
        filled("{{nobody}}", {});
        FAIL();
    } catch (const std::runtime_error& problem) {
        EXPECT_THAT(problem.what(), HasSubstr("nobody"));
    }
}

TEST(Policy, NothingButItsOwnScriptsAndStylesByTheirHashes) {
    const std::string policy = page_policy();
    EXPECT_THAT(policy, HasSubstr("default-src 'none'; img-src data:;"));
    EXPECT_THAT(policy, testing::ContainsRegex("script-src 'sha256-[A-Za-z0-9+/]{43}=' 'sha256-"));
    EXPECT_THAT(policy, Not(HasSubstr("unsafe")));
    EXPECT_THAT(policy, Not(HasSubstr("http")));
}

TEST(Status, EveryStatusHasAShapeAndAllErrorsOneColour) {
    EXPECT_EQ(page_class(Status::Passed), "passed");
    EXPECT_EQ(page_class(Status::SizeMismatch), "error");
    EXPECT_EQ(page_sign(Status::Missing), "missing");
    EXPECT_EQ(page_sign(Status::Unreadable), "error");
}

} // namespace
} // namespace tonetool::sequence
