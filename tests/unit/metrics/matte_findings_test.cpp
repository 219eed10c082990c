// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/matte_findings.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <map>

namespace tonetool::metrics {
namespace {

// Painted objects on a floor; each pixel has one, or a share of one and the floor.
constexpr size_t kWidth = 60, kHeight = 40;
constexpr uint32_t kFloor = 1;

struct Painting {
    std::vector<std::map<uint32_t, double>> pixels;
    std::vector<float> light;

    Painting() : pixels(kWidth * kHeight, {{kFloor, 1.0}}), light(3 * kWidth * kHeight, 0.5f) {}

    Painting& box(uint32_t id, size_t x, size_t y, size_t width, size_t height, double share = 1) {
        for (size_t v = y; v < y + height; ++v)
            for (size_t u = x; u < x + width; ++u) {
                auto& pixel = pixels[v * kWidth + u];
                for (auto& [other, part] : pixel)
                    part *= 1 - share;
                pixel[id] += share;
            }
        return *this;
    }
    // Multiplies red where the object is.
    Painting& tint(uint32_t id, float factor) {
        for (size_t p = 0; p < pixels.size(); ++p)
            if (pixels[p].count(id) > 0)
                light[3 * p] *= factor;
        return *this;
    }

    Coverage coverage() const {
        Coverage all;
        for (size_t y = 0; y < kHeight; ++y) {
            constexpr size_t pairs = 4;
            std::vector<float> ranks;
            for (size_t x = 0; x < kWidth; ++x) {
                size_t used = 0;
                for (const auto& [id, share] : pixels[y * kWidth + x]) {
                    float bits = 0;
                    std::memcpy(&bits, &id, sizeof bits);
                    ranks.insert(ranks.end(), {bits, float(share)});
                    ++used;
                }
                ranks.resize(ranks.size() + 2 * (pairs - used));
            }
            all.add(Coverage::decode(ranks, pairs));
        }
        return all;
    }
};

std::vector<AttributedMatte> rows(const Painting& a, const Painting& b) {
    const std::vector<float> error(kWidth * kHeight, 0.25f);
    const CoveredPixels pixels{kWidth, error.data(), a.light.data(), b.light.data()};
    return attributed_mattes(a.coverage(), b.coverage(), pixels, [](uint32_t id) {
        return id == kFloor ? "floor" : std::string(1, char('a' + id - 10));
    });
}

std::map<std::string, std::string> findings(const Painting& a, const Painting& b) {
    std::map<std::string, std::string> found;
    for (const AttributedMatte& row : rows(a, b))
        if (!row.finding.empty())
            found[row.name] = row.finding;
    return found;
}

using Found = std::map<std::string, std::string>;
constexpr uint32_t kA = 10, kB = 11, kC = 12;

TEST(MatteFindings, NothingChanged) {
    const Painting scene = Painting().box(kA, 5, 5, 10, 10).box(kB, 30, 20, 3, 3);
    EXPECT_EQ(findings(scene, scene), Found());
    for (const AttributedMatte& row : rows(scene, scene)) {
        EXPECT_EQ(row.cover, 0);
        EXPECT_EQ(row.changed, 0);
        EXPECT_THAT(row.gain, testing::Each(1.0));
        EXPECT_THAT(row.gain_error, testing::Each(0.0));
        ASSERT_TRUE(row.shift);
        EXPECT_EQ((*row.shift)[0], 0);
    }
}

// What noise does to edges: less than half of a pixel.
TEST(MatteFindings, CoverageThatIsOffByLessThanHalfIsNoFinding) {
    const Painting a = Painting().box(kA, 5, 5, 10, 10, 0.3);
    const Painting b = Painting().box(kA, 5, 5, 10, 10, 0.7);
    EXPECT_EQ(findings(a, b), Found());
    EXPECT_EQ(rows(a, b).front().changed, 0);
    const Painting c = Painting().box(kA, 5, 5, 10, 10, 0.9);
    EXPECT_EQ(findings(a, c), Found({{"a", "larger"}, {"floor", "uncovered or hidden"}}));
}

TEST(MatteFindings, MovedAndWhatItUncovers) {
    const Painting a = Painting().box(kA, 5, 5, 10, 10), b = Painting().box(kA, 11, 3, 10, 10);
    EXPECT_EQ(findings(a, b),
              Found({{"a", "moved or reshaped"}, {"floor", "uncovered or hidden"}}));
    for (const AttributedMatte& row : rows(a, b))
        if (row.name == "a") {
            EXPECT_NEAR((*row.shift)[0], 6, 1e-9);
            EXPECT_NEAR((*row.shift)[1], -2, 1e-9);
        }
}

TEST(MatteFindings, WhatIsOnlyUncoveredExplainsNothing) {
    // The floor is uncovered by a, and so is b, which a has hidden.
    const Painting a = Painting().box(kB, 5, 5, 8, 8).box(kA, 5, 5, 10, 10);
    const Painting b = Painting().box(kB, 5, 5, 8, 8).box(kA, 30, 20, 10, 10);
    EXPECT_EQ(findings(a, b), Found({{"a", "moved or reshaped"},
                                     {"b", "new"}, // not seen before: it is told
                                     {"floor", "uncovered or hidden"}}));
}

TEST(MatteFindings, MissingNewLargerSmaller) {
    const Painting empty;
    const Painting small = Painting().box(kA, 5, 5, 8, 8), large = Painting().box(kA, 5, 5, 12, 12);
    const Found floor{{"floor", "uncovered or hidden"}};
    const auto with = [&](const char* what) {
        Found found = floor;
        found["a"] = what;
        return found;
    };
    EXPECT_EQ(findings(small, empty), with("missing"));
    EXPECT_EQ(findings(empty, small), with("new"));
    EXPECT_EQ(findings(small, large), with("larger"));
    EXPECT_EQ(findings(large, small), with("smaller"));
    for (const AttributedMatte& row : rows(small, empty))
        if (row.name == "a") {
            EXPECT_FALSE(row.shift);
            EXPECT_TRUE(std::isnan(row.gain[0]));
        }
}

TEST(MatteFindings, FewPixelsAreNone) {
    const Painting empty;
    EXPECT_EQ(findings(Painting().box(kA, 5, 5, 3, 1), empty), Found());
    EXPECT_EQ(findings(Painting().box(kA, 5, 5, 4, 1), empty).at("a"), "missing");
    // 1 % of the area of a large one: 900 and 15 more.
    const Painting large = Painting().box(kA, 0, 0, 30, 30);
    EXPECT_EQ(findings(large, Painting().box(kA, 0, 0, 30, 30).box(kA, 30, 0, 8, 1)), Found());
    EXPECT_EQ(findings(large, Painting().box(kA, 0, 0, 30, 30).box(kA, 30, 0, 15, 1)).at("a"),
              "larger");
}

TEST(MatteFindings, OneInPlaceOfTheOther) {
    const Painting a = Painting().box(kA, 5, 5, 10, 10), b = Painting().box(kB, 5, 5, 10, 10);
    EXPECT_EQ(findings(a, b), Found({{"a", "replaced by b"}, {"b", "replaces a"}}));
    // Nine tenths of the pixels make it so, less does not.
    const Painting some = Painting().box(kB, 6, 5, 10, 10), half = Painting().box(kB, 7, 5, 10, 10);
    EXPECT_EQ(findings(a, some).at("a"), "replaced by b");
    EXPECT_EQ(findings(a, half).at("a"), "missing");
    EXPECT_EQ(findings(a, half).at("b"), "new");
}

TEST(MatteFindings, AnotherColourNeedsAnArea) {
    const Painting a = Painting().box(kA, 5, 5, 8, 8).box(kB, 30, 20, 7, 9);
    Painting b = a;
    b.tint(kA, 1.2f).tint(kB, 1.2f);
    EXPECT_EQ(findings(a, b), Found({{"a", "other colour"}})); // 64 pixels; b has 63
    Painting little = a;
    little.tint(kA, 1.04f);
    EXPECT_EQ(findings(a, little), Found());
}

TEST(MatteFindings, NothingIsNeverFound) {
    // Where no object is, neither is a finding of coverage; its row is there.
    Painting a = Painting().box(Coverage::kNone, 0, 0, 20, 20), b = Painting();
    b.box(Coverage::kNone, 30, 10, 20, 20);
    for (const AttributedMatte& row : rows(a, b))
        if (row.name == kMatteNone) {
            EXPECT_EQ(row.finding, "");
            EXPECT_EQ(row.pixels_reference, 400);
            EXPECT_EQ(row.changed, 800);
        }
    EXPECT_EQ(findings(a, b), Found({{"floor", "moved or reshaped"}}));
    EXPECT_EQ(rows(a, b).size(), 2u);
}

TEST(MatteFindings, RowsHaveFindingsFirstThenTheLargestMass) {
    const Painting a = Painting().box(kA, 5, 5, 8, 8).box(kB, 30, 0, 30, 40).box(kC, 2, 30, 2, 2);
    Painting b = a;
    b.tint(kA, 2);
    std::vector<std::string> names;
    for (const AttributedMatte& row : rows(a, b))
        names.push_back(row.name);
    EXPECT_THAT(names, testing::ElementsAre("a", "b", "floor", "c"));
}

} // namespace
} // namespace tonetool::metrics
