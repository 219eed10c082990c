// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/pairing.h"

#include <gmock/gmock.h>
#include <stdexcept>

namespace tonetool::sequence {
namespace {

using testing::ElementsAre;

Side side(const std::string& pattern, const std::vector<int>& frames, bool from_disk = true) {
    Side made{pattern, {}};
    for (int frame : frames)
        made.files.items.push_back({frame, ""});
    made.files.names = file_names(pattern, {}, made.files.items);
    made.files.from_disk = from_disk;
    return made;
}

std::vector<int> numbers(const std::vector<Side>& sides) {
    std::vector<int> found;
    for (const Item& item : paired(sides))
        found.push_back(item.frame);
    return found;
}

TEST(Paired, TheUnionByNumber) {
    EXPECT_THAT(numbers({side("a.#", {1, 2}), side("b.#", {2, 3})}), ElementsAre(1, 2, 3));
}

TEST(Paired, HolesOfWhatIsOnTheDiskAreFrames) {
    EXPECT_THAT(numbers({side("a.#", {1, 2, 5}), side("b.#", {1, 2, 5})}),
                ElementsAre(1, 2, 3, 4, 5));
    EXPECT_THAT(numbers({side("a.#", {-2, 1})}), ElementsAre(-2, -1, 0, 1)); // two make no step
}

TEST(Paired, StepsAndRangesHaveNoHoles) {
    EXPECT_THAT(numbers({side("a.#", {1, 3, 7})}), ElementsAre(1, 3, 5, 7));
    EXPECT_THAT(numbers({side("a.#", {1, 2, 9}, false), side("b.#", {2})}), ElementsAre(1, 2, 9));
}

TEST(Paired, NothingAndTooMuch) {
    EXPECT_TRUE(paired({side("a.#", {})}).empty());
    EXPECT_THROW(paired({side("a.#", {1, 2, 2000000000})}), std::runtime_error);
}

std::string refusal_of(const std::vector<Side>& sides, bool same_numbers = false) {
    try {
        same_numbers ? check_same_numbers(sides) : void(pair_sides(sides, {}));
    } catch (const std::runtime_error& problem) {
        return problem.what();
    }
    return "";
}

TEST(PairSides, RangesOfEqualLengthByPosition) {
    const Pairing pairs =
        pair_sides({side("r.1001-1002#", {1001, 1002}, false), side("t.1-2#", {1, 2}, false)}, {});
    EXPECT_THAT(pairs.items, ElementsAre(Item{1001, ""}, Item{1002, ""}));
    EXPECT_THAT(pairs.names[0], ElementsAre("r.1001", "r.1002"));
    EXPECT_THAT(pairs.names[1], ElementsAre("t.0001", "t.0002"));
    EXPECT_THAT(pairs.own[0], testing::IsEmpty());
    EXPECT_THAT(pairs.own[1], ElementsAre(Item{1, ""}, Item{2, ""}));
}

TEST(PairSides, ARangeHoldsForASideWithoutOne) {
    const Pairing pairs =
        pair_sides({side("r.2-3#", {2, 3}, false), side("t.#", {1, 2, 3, 4})}, {});
    EXPECT_THAT(pairs.items, ElementsAre(Item{2, ""}, Item{3, ""}));
    EXPECT_THAT(pairs.names[1], ElementsAre("t.0002", "t.0003"));
}

TEST(PairSides, WhatDoesNotFitIsRefusedWithTheCure) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal_of({side("r.1-3#", {1, 2, 3}, false), side("t.1-2#", {1, 2}, false)}),
                HasSubstr("\"r.1-3#\" has 3 frames, \"t.1-2#\" 2"));
    EXPECT_THAT(refusal_of({side("r.1,1#", {1, 1}, false), side("t.1-2#", {1, 2}, false)}),
                HasSubstr("frame 1 twice"));
    EXPECT_THAT(refusal_of({side("r.1#", {1}, false), side("t.2#", {2}, false), side("u.#", {1})}),
                HasSubstr("\"u.#\" has no frame range"));
    EXPECT_THAT(refusal_of({side("r.#.exr", {1001, 1002}), side("t.#.exr", {1, 2})}),
                HasSubstr("r.1001-1002#.exr t.1-2#.exr"));
    EXPECT_EQ(refusal_of({side("r.#", {1, 2}), side("t.#", {2, 3})}), "");
    EXPECT_EQ(refusal_of({side("r.#", {1, 2}), side("t.#", {})}), "");
}

TEST(CheckSameNumbers, OfWhatIsOnTheDisk) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal_of({side("r.#", {1, 2, 3}), side("t.#", {1, 2, 4})}, true),
                HasSubstr("\"t.#\" has frames 1-2,4"));
    EXPECT_EQ(refusal_of({side("r.#", {1, 2}), side("t.#", {1, 2})}, true), "");
    EXPECT_EQ(refusal_of({side("r.3-4#", {3, 4}, false), side("t.1-2#", {1, 2}, false)}, true), "");
}

TEST(NamesOf, TheFilesOwnOrTheOneItWouldHave) {
    Side found = side("a.#.exr", {1});
    found.files.names = {"./a.01.exr"};
    EXPECT_THAT(names_of(found, {}, {{1, ""}, {2, ""}}), ElementsAre("a.01.exr", "a.0002.exr"));
    found.pattern = "./a.#.exr";
    EXPECT_THAT(names_of(found, {}, {{1, ""}}), ElementsAre("./a.01.exr"));
}

} // namespace
} // namespace tonetool::sequence
