// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/records.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace tonetool::sequence {
namespace {

using nlohmann::ordered_json;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Signs within texts, empty lists and objects, numbers of every kind.
const char* const kText = R"({"frames": [
 {"frame": 1, "qc": {"a\"]}": [1, -2.5e-300, [], {}, "x: {\\"], "b": {"c": true}}, "status": "passed"},
 {"frame": 2, "qc" : [ "frames" ] },
 {"qc": "t, ]"},
 {"faults": [{"qc": 1}], "qc": 17, "frame": 3},
 {"frame": 4}
], "qc": {"not": "of a frame"}, "other": [{"qc": 5}]})";

TEST(Records, AreTakenOutOfTheFramesAlone) {
    const auto found = without_records(kText);
    ASSERT_TRUE(found);
    EXPECT_THAT(found->records,
                ElementsAre(R"({"a\"]}":[1,-2.5e-300,[],{},"x: {\\"],"b":{"c":true}})",
                            R"(["frames"])", R"("t, ]")", "17"));
    ordered_json rest = ordered_json::parse(kText);
    for (int i = 0; i < 4; ++i)
        rest["frames"][size_t(i)]["qc"] = i;
    EXPECT_EQ(ordered_json::parse(found->text), rest);
}

TEST(Records, NoneIsTakenWhereThereIsNone) {
    for (const std::string text : {"[]", "{}", R"({"frames": {"qc": 1}})", "17", "",
                                   R"({"frame": [{"qc": 1}]})", R"([{"frames": [{"qc": 1}]}])"}) {
        const auto found = without_records(text);
        ASSERT_TRUE(found) << text;
        EXPECT_EQ(found->text, text);
        EXPECT_THAT(found->records, IsEmpty());
    }
}

// A text that ends at any byte has no value in a place that it does not have.
TEST(Records, OfATextThatIsCutOff) {
    const std::string text = kText;
    for (size_t size = 1; size < text.size(); ++size)
        EXPECT_FALSE(without_records(text.substr(0, size))) << text.substr(0, size);
    EXPECT_FALSE(without_records(R"({"frames": [{"qc": 1]})"));
    EXPECT_FALSE(without_records(std::string(200, '[') + std::string(200, ']')));
}

TEST(Records, AreLaidOutAsTheLibraryDoes) {
    for (const std::string text :
         {kText, "[]", "{}", "[[],{}]", "3", R"("a,b")", R"([{"a":[1,2]}])"}) {
        const ordered_json json = ordered_json::parse(text);
        EXPECT_EQ(laid_out(json.dump(), 0), json.dump(1));
        EXPECT_EQ(laid_out(text, 0), json.dump(1)); // spaces do not count
    }
    const ordered_json inner = ordered_json::parse(kText);
    const std::string whole = ordered_json{{"a", {{"b", inner}}}}.dump(1);
    EXPECT_EQ("{\n \"a\": {\n  \"b\": " + laid_out(inner.dump(), 2) + "\n }\n}", whole);
}

} // namespace
} // namespace tonetool::sequence
