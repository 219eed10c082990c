// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/names.h"

#include <gmock/gmock.h>

namespace tonetool {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EditDistance, CountsCharacters) {
    EXPECT_EQ(edit_distance("", ""), 0u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", "abc"), 0u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
    EXPECT_TRUE(are_swapped("fial", "fail"));
    EXPECT_TRUE(are_swapped("ab", "ba"));
    for (const char* other : {"", "f", "fial", "fails", "afil", "fali", "liaf"})
        EXPECT_FALSE(are_swapped("fial", other)) << other;
    EXPECT_THAT(nearest_names("fial", {"fill", "fail", "from"}, 1), ElementsAre("fail"));
}

TEST(NearestNames, FindsMisspeltOnes) {
    const std::vector<std::string> names = {"hdrflip", "ldrflip", "flipdiff", "label", "o"};
    EXPECT_THAT(nearest_names("hdrflp", names), ElementsAre("hdrflip", "ldrflip"));
    EXPECT_THAT(nearest_names("flip", names), ElementsAre("flipdiff"));
    EXPECT_THAT(nearest_names("zzzzzzzz", names), IsEmpty());
    EXPECT_THAT(nearest_names("hdrflp", names, 1), ElementsAre("hdrflip"));
    EXPECT_THAT(nearest_names("HDRflip", names, 1), ElementsAre("hdrflip"));
}

TEST(UnknownName, ListsWhatIsValid) {
    EXPECT_EQ(unknown_name("look", "b", {}), "unknown look \"b\"; there are none");
    EXPECT_EQ(unknown_name("view", "ACES SDX", {"Raw", "ACES SDR"}),
              "unknown view \"ACES SDX\"; did you mean \"ACES SDR\"? valid: Raw, ACES SDR");
}

} // namespace
} // namespace tonetool
