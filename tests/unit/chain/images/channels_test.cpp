// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/channels.h"

#include <gmock/gmock.h>

#include "text/error.h"
#include "text/text.h"

namespace tonetool::chain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

OIIO::ImageBuf image() {
    OIIO::ImageSpec spec(1, 1, 4, OIIO::TypeFloat);
    spec.channelnames = {"R", "G", "diffuse.R", "Z"};
    OIIO::ImageBuf pixels(spec);
    pixels.setpixel(0, 0, 0, std::vector<float>{1, 2, 3, 4}.data());
    return pixels;
}

std::vector<float> values(const OIIO::ImageBuf& pixels) {
    std::vector<float> found(size_t(pixels.nchannels()));
    pixels.getpixel(0, 0, 0, found.data(), pixels.nchannels());
    return found;
}

TEST(Channels, AreFoundByNameLetterCaseAsideIfNeedBe) {
    EXPECT_EQ(channel_index(image().spec(), "G"), 1);
    EXPECT_EQ(channel_index(image().spec(), "DIFFUSE.r"), 2);
    EXPECT_EQ(channel_index(image().spec(), "B"), -1);
}

TEST(Channels, AreChosenRenamedAndFilled) {
    const OIIO::ImageBuf chosen = select_channels(image(), "Z, 1,B=0.5,X=diffuse.R,=7");
    EXPECT_THAT(values(chosen), ElementsAre(4, 2, 0.5F, 3, 7));
    EXPECT_THAT(chosen.spec().channelnames, ElementsAre("Z", "G", "B", "X", testing::_));
}

TEST(Channels, ThatAreNotThereAreErrorsWithThoseThatAre) {
    for (const char* list : {"Q", "R,Q", "A=Q", "9", ""}) {
        try {
            select_channels(image(), list);
            FAIL() << list;
        } catch (const CommandError& problem) {
            EXPECT_THAT(problem.what(), testing::AnyOf(HasSubstr("R,G,diffuse.R,Z"),
                                                       HasSubstr("0 to 3"), HasSubstr("0-channel")))
                << list;
        }
    }
}

TEST(Channels, LenientlyTheyAreZeroWithAWarning) {
    Strings told;
    const auto warn = [&](const std::string& text) { told.push_back(text); };
    EXPECT_THAT(values(select_channels(image(), "R,Q", warn)), ElementsAre(1, 0));
    EXPECT_THAT(told, ElementsAre(HasSubstr("\"Q\"")));
}

} // namespace
} // namespace tonetool::chain
