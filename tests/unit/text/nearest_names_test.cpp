#include "text/nearest_names.h"

#include <gmock/gmock.h>

namespace tonetool::text {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(EditDistance, CountsCharacters) {
    EXPECT_EQ(edit_distance("", ""), 0u);
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("abc", "abc"), 0u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
}

TEST(NearestNames, FindsMisspeltOnes) {
    const std::vector<std::string> names = {"hdrflip", "ldrflip", "flipdiff", "label", "o"};
    EXPECT_THAT(nearest_names("hdrflp", names), ElementsAre("hdrflip", "ldrflip"));
    EXPECT_THAT(nearest_names("flip", names), ElementsAre("flipdiff"));
    EXPECT_THAT(nearest_names("zzzzzzzz", names), IsEmpty());
    EXPECT_THAT(nearest_names("hdrflp", names, 1), ElementsAre("hdrflip"));
}

} // namespace
} // namespace tonetool::text
