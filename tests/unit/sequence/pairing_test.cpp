#include "sequence/pairing.h"

#include <gmock/gmock.h>
#include <stdexcept>

namespace tonetool::sequence {
namespace {

using testing::ElementsAre;

Side side(const std::string& pattern, const std::vector<int>& frames, bool from_disk = true) {
    Side made{pattern, {}};
    for (int frame : frames) {
        made.files.items.push_back({frame, ""});
    }
    made.files.names = file_names(pattern, {}, made.files.items);
    made.files.from_disk = from_disk;
    return made;
}

std::vector<int> numbers(const std::vector<Side>& sides) {
    std::vector<int> found;
    for (const Item& item : paired(sides)) {
        found.push_back(item.frame);
    }
    return found;
}

TEST(Paired, The_union_by_number) {
    EXPECT_THAT(numbers({side("a.#", {1, 2}), side("b.#", {2, 3})}), ElementsAre(1, 2, 3));
}

TEST(Paired, Holes_of_what_is_on_the_disk_are_frames) {
    EXPECT_THAT(numbers({side("a.#", {1, 2, 5}), side("b.#", {1, 2, 5})}),
                ElementsAre(1, 2, 3, 4, 5));
    EXPECT_THAT(numbers({side("a.#", {-2, 1})}), ElementsAre(-2, 1)); // a step of three
}

TEST(Paired, Steps_and_ranges_have_no_holes) {
    EXPECT_THAT(numbers({side("a.#", {1, 3, 7})}), ElementsAre(1, 3, 5, 7));
    EXPECT_THAT(numbers({side("a.#", {1, 2, 9}, false), side("b.#", {2})}), ElementsAre(1, 2, 9));
}

TEST(Paired, Nothing_and_too_much) {
    EXPECT_TRUE(paired({side("a.#", {})}).empty());
    EXPECT_THROW(paired({side("a.#", {1, 2, 2000000000})}), std::runtime_error);
}

TEST(NamesOf, The_files_own_or_the_one_it_would_have) {
    Side found = side("a.#.exr", {1});
    found.files.names = {"./a.01.exr"};
    EXPECT_THAT(names_of(found, {}, {{1, ""}, {2, ""}}), ElementsAre("a.01.exr", "a.0002.exr"));
    found.pattern = "./a.#.exr";
    EXPECT_THAT(names_of(found, {}, {{1, ""}}), ElementsAre("./a.01.exr"));
}

} // namespace
} // namespace tonetool::sequence
