// SPDX-License-Identifier: BSD-3-Clause
#include "text/printable.h"

#include <gmock/gmock.h>
#include <sstream>

#include "text/text.h"

namespace tonetool {
namespace {

TEST(Printable, ControlCharactersAreNoOrders) {
    EXPECT_EQ(printable("a b.exr"), "a b.exr");
    EXPECT_EQ(printable("\x1b[2J\a\x7f"), "\\x1b[2J\\x07\\x7f");
    EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
    EXPECT_EQ(printable_lines("a\nb\tc\rd\x1b"), "a\nb\tc\\rd\\x1b");
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
}

TEST(Printable, TextOfAllLanguagesStays) {
    for (const char* text :
         {"\xc3\xa9t\xc3\xa9", "\xe6\x98\xa0\xe7\x94\xbb", "\xf0\x9f\x8e\xac", "\xc2\xa0"})
        EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printable("\xe9t\xe9"), "\xe9t\xe9"); // Latin-1
}

TEST(Printable, ControlsOfEightBitsAndTurnedText) {
    EXPECT_EQ(printable("\xc2\x9b"
                        "2J"),
              "\\x9b2J");
    EXPECT_EQ(printable("\x9b"
                        "2J"),
              "\\x9b2J");
    EXPECT_EQ(printable("a\xe2\x80\xae"
                        "rxe.exr"),
              "a\\u202erxe.exr");
    EXPECT_EQ(printable("\xe2\x81\xa6x\xe2\x81\xa9"), "\\u2066x\\u2069");
    EXPECT_EQ(printable("\xe2\x80\xa8"), "\\u2028");
}

TEST(Printable, JsonStaysJson) {
    EXPECT_EQ(printable_json("{\n \"a\": \"\\u001b\x7f\xc2\x9b\xe2\x80\xae\xc3\xa9\"\n}"),
              "{\n \"a\": \"\\u001b\\u007f\\u009b\\u202e\xc3\xa9\"\n}");
}

TEST(Printable, AStreamIsTheSameHoweverItIsCut) {
    const std::string text = "a\xe2\x80\xae\x1b[1m\xc3\xa9\xc2\x9b\r\nb\rc\n\rx\xe6\x98";
    for (size_t piece = 1; piece <= text.size(); ++piece) {
        std::ostringstream to;
        {
            const PrintableStream guard(to);
            for (size_t at = 0; at < text.size(); at += piece)
                to << text.substr(at, piece);
        }
        EXPECT_EQ(to.str(), "a\\u202e\\x1b[1m\xc3\xa9\\x9b\r\nb\\rc\n\rx\xe6\\x98") << piece;
    }
}

TEST(Printable, WhatCannotBeWrittenIsTold) {
    struct Full : std::streambuf {};
    Full full;
    std::ostream stream(&full);
    PrintableBuffer buffer(&full);
    stream.rdbuf(&buffer);
    stream << "text" << std::flush;
    EXPECT_FALSE(stream);
}

TEST(ShellQuoted, ControlCharactersStayInOneLine) {
    EXPECT_EQ(shell_quoted("a\nb"), "$'a\\nb'");
    EXPECT_EQ(shell_quoted("it's\x1b\\"), "$'it\\'s\\x1b\\\\'");
    EXPECT_EQ(shell_quoted("it's"), "'it'\\''s'");
}

} // namespace
} // namespace tonetool
