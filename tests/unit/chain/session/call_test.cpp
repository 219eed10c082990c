// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/call.h"

#include <functional>
#include <gmock/gmock.h>

#include "text/error.h"

namespace tonetool::chain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Command row_with(const Strings& keys) {
    Command row;
    row.names = {"test"};
    row.args = {"STOPS"};
    for (const std::string& key : keys)
        row.modifiers.push_back({key, "X", "help"});
    return row;
}

std::string message_of(const std::function<void()>& function) {
    try {
        function();
    } catch (const CommandError& error) {
        return error.what();
    }
    return "";
}

TEST(Call, RefusesUnknownModifiersAndSuggests) {
    Command row = row_with({"tonemapper", "fail"});
    std::string message = message_of([&] { Call(row, parse_token("--test:tonemaper=aces"), {}); });
    EXPECT_THAT(message, HasSubstr("\"tonemaper\""));
    EXPECT_THAT(message, HasSubstr("did you mean \"tonemapper\""));
    EXPECT_THAT(message, HasSubstr("--help test lists all"));
    message = message_of([&] { Call(row, parse_token("--test:zebra=1"), {}); });
    EXPECT_THAT(message, HasSubstr("valid: tonemapper, fail"));
}

TEST(Call, ReadsTypedModifiers) {
    Command row = row_with({"x", "n", "b", "c", "l"});
    Call call(row, parse_token("--test:x=0.5:n=3:b=1:c=aces:l=1,2,3"), {"-2"});
    EXPECT_EQ(call.number("x", {0, 1}), 0.5);
    EXPECT_EQ(call.integer("n", {1, 9}), 3);
    EXPECT_TRUE(call.flag("b", false));
    EXPECT_EQ(call.choice("c", {"aces", "hable"}), "aces");
    EXPECT_THAT(call.numbers("l", 3), ElementsAre(1, 2, 3));
    EXPECT_EQ(call.number_argument(0, {-9, 9}), -2);
}

TEST(Call, AbsentModifiersAreNotThere) {
    Command row = row_with({"x", "b"});
    Call call(row, parse_token("--test"), {});
    EXPECT_FALSE(call.number("x", {0, 1}).has_value());
    EXPECT_TRUE(call.flag("b", true));
    EXPECT_TRUE(call.numbers("x", 6).empty());
}

TEST(Call, SaysWhatWouldBeValid) {
    Command row = row_with({"x", "n", "b", "c", "l"});
    Call call(row, parse_token("--test:x=1.5:n=2.0:b=yes:c=ases:l=1,2"), {"0,05"});
    EXPECT_THAT(message_of([&] { call.number("x", {0, 1}); }), HasSubstr("valid: 0 to 1"));
    EXPECT_THAT(message_of([&] { call.integer("n", {1, 9}); }), HasSubstr("not a whole number"));
    EXPECT_THAT(message_of([&] { call.flag("b", false); }), HasSubstr("valid: 0, 1"));
    EXPECT_THAT(message_of([&] {
                    call.choice("c", {"aces", "hable"});
                }),
                HasSubstr("did you mean \"aces\""));
    EXPECT_THAT(message_of([&] { call.numbers("l", 6); }), HasSubstr("6 numbers"));
    EXPECT_THAT(message_of([&] {
                    call.number_argument(0, {-9, 9});
                }),
                HasSubstr("STOPS \"0,05\" is not a number"));
}

} // namespace
} // namespace tonetool::chain
