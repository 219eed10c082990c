// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/windows.h"

#include <gmock/gmock.h>

namespace tonetool::chain {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const OIIO::ROI old(10, 110, 20, 70, 0, 1, 0, 3);

std::string adjusted(const std::string& text, Geometry allowed, bool lenient = false) {
    OIIO::ROI window = old;
    const Adjusted found = adjust_window(text, allowed, window, lenient);
    return found.error.empty()
               ? std::to_string(window.width()) + "x" + std::to_string(window.height()) + "+" +
                     std::to_string(window.xbegin) + "+" + std::to_string(window.ybegin) +
                     (found.warning.empty() ? "" : "!")
               : "error: " + found.error;
}

TEST(Windows, AreGivenInOiiotoolsWays) {
    const std::pair<const char*, const char*> cases[] = {
        {"40x30", "40x30+10+20"},    {"40x30+5+6", "40x30+5+6"}, {"+5+6", "100x50+5+6"},
        {"0,0,9,19", "10x20+0+0"},   {"50%", "50x25+10+20"},     {"0.5", "50x25+10+20"},
        {"50x0", "50x25+10+20"},     {"0x25", "50x25+10+20"},    {"50%x100%", "50x50+10+20"},
        {"40x30-5-6", "40x30+-5+-6"}};
    for (const auto& [text, expected] : cases)
        EXPECT_EQ(adjusted(text, Geometry::Scalable), expected) << text;
}

TEST(Windows, WhatIsNotAllowedIsAnErrorOrAWarning) {
    EXPECT_THAT(adjusted("50%", Geometry::Window), HasSubstr("rescale"));
    EXPECT_THAT(adjusted("40x30", Geometry::Position), HasSubstr("valid: +X+Y"));
    EXPECT_EQ(adjusted("40x30+1+2", Geometry::Position, true), "100x50+1+2!");
    EXPECT_EQ(adjusted("50%", Geometry::Window, true), "100x50+10+20!");
}

TEST(Windows, RestsAndNonsenseAreErrors) {
    EXPECT_THAT(adjusted("40x30oops", Geometry::Window), HasSubstr("40x30oops"));
    EXPECT_EQ(adjusted("40x30oops", Geometry::Window, true), "40x30+10+20");
    for (bool lenient : {false, true})
        EXPECT_THAT(adjusted("big", Geometry::Scalable, lenient), HasSubstr("Unrecognized"));
}

TEST(Windows, SizesAreTwoNumbers) {
    EXPECT_EQ(parsed_size("3x5")->height, 5);
    EXPECT_EQ(parsed_size("1.5x2")->width, 1.5F);
    for (const char* text : {"3", "3x", "3x5x7", "", "x5", "3 x5 "})
        EXPECT_FALSE(parsed_size(text)) << text;
}

TEST(Windows, TheDataWindowKeepsItsPlace) {
    OIIO::ImageSpec spec(40, 20, 3);
    spec.x = 30;
    spec.y = 10;
    spec.full_x = 10;
    spec.full_width = 100;
    spec.full_height = 50;
    const OIIO::ImageSpec scaled = scaled_spec(spec, OIIO::ROI(10, 210, 0, 25));
    EXPECT_EQ(scaled.roi_full(), OIIO::ROI(10, 210, 0, 25, 0, 1, 0, 3));
    EXPECT_EQ(scaled.roi(), OIIO::ROI(50, 130, 5, 15, 0, 1, 0, 3));
}

} // namespace
} // namespace tonetool::chain
