// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/frame_range.h"

#include <gmock/gmock.h>
#include <stdexcept>

namespace tonetool::sequence {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal_of(const std::string& range) {
    try {
        parse_frames(range);
    } catch (const std::runtime_error& problem) {
        return problem.what();
    }
    return "";
}

TEST(ParseFrames, EveryFormOfOiiotool) {
    EXPECT_THAT(parse_frames("7"), ElementsAre(7));
    EXPECT_THAT(parse_frames("1,3,10-20x5"), ElementsAre(1, 3, 10, 15, 20));
    EXPECT_THAT(parse_frames("1-7y3"), ElementsAre(2, 3, 5, 6));
    EXPECT_THAT(parse_frames("3-1"), ElementsAre(3, 2, 1));
    EXPECT_THAT(parse_frames("10-1x4"), ElementsAre(10, 6, 2));
    EXPECT_THAT(parse_frames("10-1x-4"), ElementsAre(10, 6, 2));
    EXPECT_THAT(parse_frames("1-10x-4"), ElementsAre(10, 6, 2));
    EXPECT_THAT(parse_frames("1-5y-2"), ElementsAre(4, 2));
    EXPECT_THAT(parse_frames("-3--1"), ElementsAre(-3, -2, -1));
    EXPECT_THAT(parse_frames("-1-1"), ElementsAre(-1, 0, 1));
    EXPECT_THAT(parse_frames("001-002, 4"), ElementsAre(1, 2, 4));
    EXPECT_THAT(parse_frames("2147483646-2147483647"), ElementsAre(2147483646, 2147483647));
}

TEST(ParseFrames, IsReadToItsEnd) {
    for (const char* range : {"",      "x",       "1-",   "1 2", "1-2 5-6", "1.5-3", "1;2",
                              "1:5",   "1-5x2y2", "1,,3", "1,",  ",1",      "1-3#",  "0x10",
                              "1-10x", "1-10x0",  "--1",  "+1",  "1-2,x",   "1\n2",  "1e3"}) {
        EXPECT_THAT(refusal_of(range), HasSubstr("no frame range: \"")) << range;
        EXPECT_THAT(refusal_of(range), HasSubstr("(valid: 1-10")) << range;
    }
}

TEST(ParseFrames, TooManyAndTooLargeAreRefusedWithASentence) {
    EXPECT_THAT(refusal_of("1-2000000000"), HasSubstr("has 2000000000 frames (valid: at most"));
    EXPECT_THAT(refusal_of("-2147483648-2147483647"), HasSubstr("4294967296 frames"));
    EXPECT_THAT(refusal_of("1-900000,1-900000"), HasSubstr("1800000 frames"));
    EXPECT_THAT(refusal_of("20261128123456"), HasSubstr("beyond 2147483647"));
    EXPECT_EQ(parse_frames("1-2000000000x1000000").size(), 2000u);
}

TEST(ParseFrames, LenientlyAsOiiotoolIgnoresTheRest) {
    EXPECT_THAT(parse_frames("1-2 5-6", true), ElementsAre(1, 2));
    EXPECT_THAT(parse_frames("1.5-3,4", true), ElementsAre(1, 4));
    EXPECT_THAT(parse_frames("1,,3", true), ElementsAre(1, 1, 3));
    EXPECT_THAT(parse_frames("1-3x0", true), ElementsAre(1, 2, 3));
    EXPECT_THROW(parse_frames("1-2000000000", true), std::runtime_error);
}

TEST(RangeText, RunsAndSingleNumbers) {
    EXPECT_EQ(range_text({1, 2, 3, 7, 9, 10}), "1-3,7,9-10");
    EXPECT_EQ(range_text({-2, -1}), "-2--1");
    EXPECT_EQ(range_text({}), "");
}

} // namespace
} // namespace tonetool::sequence
