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

} // namespace
} // namespace tonetool::sequence
