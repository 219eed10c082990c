// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/name_pattern.h"

#include <gmock/gmock.h>

namespace tonetool::sequence {
namespace {

std::optional<int> number(const std::string& pattern, const std::string& name,
                          const std::string& view = "") {
    const auto found = NamePattern(pattern).number_of(name, view);
    return found ? std::optional<int>(found->value) : std::nullopt;
}

TEST(NamePattern, TextIsText) {
    EXPECT_EQ(number("p+q.%04d.exr", "p+q.0001.exr"), 1);
    EXPECT_EQ(number("p+q.%04d.exr", "ppq.0001.exr"), std::nullopt);
    EXPECT_EQ(number("a.%04d.exr", "a_0001.exr"), std::nullopt);
    EXPECT_EQ(number("a[12].%04d.exr", "a[12].0002.exr"), 2);
    EXPECT_EQ(number("a(b)*.%04d.exr", "a(b)*.0002.exr"), 2);
    EXPECT_EQ(number("a.%04d.exr", "a.0002.exr.bak"), std::nullopt);
    EXPECT_EQ(number("s.%V.%04d.exr", "s.left.0002.exr", "left"), 2);
    EXPECT_EQ(number("s.%V.%04d.exr", "s.leXt.0002.exr", "le.t"), std::nullopt);
    EXPECT_EQ(number("s.%v.exr", "s.l.exr", "left"), 0);
}

TEST(NamePattern, NumbersOfAllWidths) {
    EXPECT_EQ(number("a.%04d.exr", "a.12345.exr"), 12345);
    EXPECT_EQ(number("a.%d.exr", "a.007.exr"), 7);
    EXPECT_EQ(number("a%04d7.exr", "a00027.exr"), 2);
    EXPECT_EQ(number("a.%04d.b.%02d.exr", "a.0003.b.0003.exr"), 3);
    EXPECT_EQ(number("a.%04d.b.%04d.exr", "a.0003.b.0004.exr"), std::nullopt);
    EXPECT_FALSE(NamePattern("a.%04d.exr").number_of("a.3.exr", "")->of_width);
    EXPECT_TRUE(NamePattern("a.%01d.exr").number_of("a.3.exr", "")->of_width);
    EXPECT_TRUE(NamePattern("v.%04d.exr").number_of("v.20261128123456.exr", "")->beyond);
    EXPECT_TRUE(NamePattern("v.%04d.exr").number_of("v.-20261128123456.exr", "")->beyond);
    EXPECT_FALSE(NamePattern("v.%04d.exr").number_of("v.2147483647.exr", "")->beyond);
}

TEST(NamePattern, NegativeNumbersInBothForms) {
    EXPECT_EQ(number("a.%04d.exr", "a.-002.exr"), -2);
    EXPECT_EQ(number("a.%04d.exr", "a.-0002.exr"), -2);
    EXPECT_EQ(number("a.%01d.exr", "a.-2.exr"), -2);
    EXPECT_EQ(number("a-%04d.exr", "a-0002.exr"), 2);
    EXPECT_EQ(number("a-%04d.exr", "a--002.exr"), -2);
    EXPECT_EQ(number("a.%04d.exr", "a.-.exr"), std::nullopt);
    EXPECT_EQ(NamePattern("a.%04d.exr").filled({-2, ""}), "a.-002.exr");
    EXPECT_EQ(NamePattern("a.%04d.exr").filled({-2, ""}, true), "a.-0002.exr");
}

// "name method number" of what the placeholders stand for; empty where the file does not match.
std::string matched(const char* pattern, const char* file) {
    const auto found = NamePattern(pattern, true).match(file, "");
    return found ? found->name + " " + found->method + " " + std::to_string(found->number.value) +
                       (found->number.of_width ? "" : " narrow")
                 : "";
}

TEST(NamePattern, NamesAndMethods) {
    EXPECT_EQ(matched("r/%N.exr", "r/hair/long.exr"), "hair/long  0");
    EXPECT_EQ(matched("r/%N.exr", "r/.exr"), "");
    EXPECT_EQ(matched("r/%N.exr", "r/a.exr.tmp"), "");
    EXPECT_EQ(matched("out/%M/%N.exr", "out/pt/x/a.exr"), "x/a pt 0");
    EXPECT_EQ(matched("%M.exr", "a/b.exr"), "");
    EXPECT_EQ(matched("%N/%N.exr", "x/y/x/y.exr"), "x/y  0"); // twice the same text
    EXPECT_EQ(matched("%N/%N.exr", "x/z.exr"), "");
    EXPECT_EQ(matched("%N_%M.exr", "a_b_c.exr"), "a_b c 0"); // the first takes what it can
    EXPECT_EQ(matched("%N.%04d.exr", "a.1.0002.exr"), "a.1  2");
    EXPECT_EQ(matched("%N%04d.exr", "a10012.exr"), "a1  12"); // a number keeps its digits
    EXPECT_EQ(matched("%N.%04d.exr", "a.1.exr"), "a  1 narrow");
    EXPECT_EQ(matched("%N.exr", "\xff\n.exr"), "\xff\n  0");
    EXPECT_EQ(NamePattern("r/%N.exr").filled({}), "r/%N.exr"); // plain text where they are no names
    EXPECT_EQ(NamePattern("r/%M/%N.%02d.exr", true).filled({7, "", "a/b", "pt"}),
              "r/pt/a/b.07.exr");
    EXPECT_EQ(NamePattern("r/x/%N.exr", true).fixed_part(), "r/x/");
}

TEST(Item, FramesByNumberCasesByName) {
    EXPECT_LT((Item{1, "right"}), (Item{2, "left"}));
    EXPECT_LT((Item{2, "left", "a", ""}), (Item{1, "right", "a", ""})); // a case by its view first
    EXPECT_LT((Item{9, "", "B", "z"}), (Item{0, "", "a", "a"}));        // bytes
    EXPECT_EQ(item_title({5, "left"}), "frame 5 left");
    EXPECT_EQ(item_title({5, "left", "hair/long", "pt"}), "case hair/long [pt] frame 5 left");
    EXPECT_EQ(item_title({0, "", "", "pt"}), "case [pt]");
}

} // namespace
} // namespace tonetool::sequence
