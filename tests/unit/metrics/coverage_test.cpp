// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/coverage.h"

#include <cmath>
#include <cstring>
#include <gmock/gmock.h>
#include <limits>
#include <random>

#include "metrics/matte_findings.h"

namespace tonetool::metrics {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

float as_float(uint32_t id) {
    float value = 0;
    std::memcpy(&value, &id, sizeof value);
    return value;
}

// The shares of one pixel.
Coverage decoded(const std::vector<std::pair<uint32_t, float>>& ranks) {
    std::vector<float> values;
    for (const auto& [id, coverage] : ranks)
        values.insert(values.end(), {as_float(id), coverage});
    Coverage coverage;
    coverage.add(Coverage::decode(values, ranks.size()));
    return coverage;
}

TEST(Coverage, IdsOfNames) {
    EXPECT_EQ(cryptomatte_id("torus"), 0xf19c73fdu);
    EXPECT_EQ(cryptomatte_id("\u0440\u0430\u0432\u043d\u0438\u043d\u0430"), 0x9623511eu);
    // Exponents 0 and 255 become 1 and 254.
    EXPECT_EQ(cryptomatte_id(""), 0x00800000u);
    for (int i = 0; i < 2000; ++i) {
        const uint32_t exponent = cryptomatte_id("node" + std::to_string(i)) >> 23 & 255;
        EXPECT_NE(exponent, 0u);
        EXPECT_NE(exponent, 255u);
    }
}

TEST(Coverage, OneIdInTwoRanks) {
    const Coverage coverage = decoded({{7, 0.5f}, {9, 0.25f}, {7, 0.25f}});
    EXPECT_EQ(coverage.of(0, 7), 0.75);
    EXPECT_EQ(coverage.of(0, 9), 0.25);
    EXPECT_EQ(coverage.of(0, Coverage::kNone), 0);
    EXPECT_EQ(coverage.end(0) - coverage.begin(0), 2);
}

TEST(Coverage, WhatIsMissingIsNothing) {
    EXPECT_EQ(decoded({{7, 0.75f}}).of(0, Coverage::kNone), 0.25);
    EXPECT_EQ(decoded({{7, 0.5f}, {0, 0.25f}}).of(0, Coverage::kNone), 0.5); // and id 0
    EXPECT_EQ(decoded({{7, 0.f}}).of(0, Coverage::kNone), 1);
}

TEST(Coverage, MoreThanOneIsDivided) {
    const Coverage coverage = decoded({{7, 1.f}, {9, 0.5f}});
    EXPECT_NEAR(coverage.of(0, 7), 2. / 3, 1e-15);
    EXPECT_NEAR(coverage.of(0, 9), 1. / 3, 1e-15);
}

TEST(Coverage, BadCoveragesAreNone) {
    const Coverage coverage = decoded({{7, kNan}, {8, -0.5f}, {9, kInf}, {5, 0.25f}});
    for (const uint32_t id : {7u, 8u, 9u})
        EXPECT_EQ(coverage.of(0, id), 0);
    EXPECT_EQ(coverage.of(0, 5), 0.25);
    EXPECT_EQ(coverage.of(0, Coverage::kNone), 0.75);
}

TEST(Coverage, IdsAreBitsNotNumbers) {
    const uint32_t no_number = 0x7fc00001; // of no file that keeps to the rules
    EXPECT_EQ(decoded({{no_number, 0.5f}, {no_number, 0.5f}}).of(0, no_number), 1);
    EXPECT_EQ(decoded({{0x80000000u, 1.f}}).of(0, Coverage::kNone), 0); // -0
}

// A random picture of a few objects, two to a pixel.
struct Scene {
    static constexpr size_t kWidth = 24, kHeight = 16;
    Coverage reference, test;
    std::vector<float> error, light;

    explicit Scene(unsigned seed) : error(kWidth * kHeight), light(3 * error.size(), 0.5f) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> share(0, 1);
        for (Coverage* coverage : {&reference, &test})
            for (size_t y = 0; y < kHeight; ++y) {
                std::vector<float> ranks;
                for (size_t x = 0; x < kWidth; ++x)
                    for (int i = 0; i < 2; ++i)
                        ranks.insert(ranks.end(), {as_float(uint32_t(1000 + random() % 5)),
                                                   0.7f * share(random)});
                coverage->add(Coverage::decode(ranks, 2));
            }
        for (float& e : error)
            e = share(random);
    }
    CoveredPixels pixels() const { return {kWidth, error.data(), light.data(), light.data()}; }
};

TEST(CoveragePairs, MassesAddUpToOne) {
    for (unsigned seed = 0; seed < 5; ++seed) {
        const Scene scene(seed);
        double sum = 0, none = 0;
        for (const AttributedMatte& row :
             attributed_mattes(scene.reference, scene.test, scene.pixels(),
                               [](uint32_t id) { return std::to_string(id); })) {
            sum += row.mass;
            none += row.name == kMatteNone ? row.mass : 0;
        }
        EXPECT_NEAR(sum, 1, 1e-9);
        EXPECT_GT(none, 0.1);
    }
}

TEST(CoveragePairs, SidesExchangedExchangeGainedAndLost) {
    const Scene scene(7);
    const auto there = compare_coverage(scene.reference, scene.test, scene.pixels());
    const auto back = compare_coverage(scene.test, scene.reference, scene.pixels());
    ASSERT_EQ(there.size(), back.size());
    for (size_t i = 0; i < there.size(); ++i) {
        EXPECT_EQ(there[i].id, back[i].id);
        EXPECT_GT(there[i].gained, 0);
        EXPECT_NEAR(there[i].gained, back[i].lost, 1e-12);
        EXPECT_NEAR(there[i].lost, back[i].gained, 1e-12);
        EXPECT_NEAR(there[i].a, back[i].b, 1e-12);
        EXPECT_NEAR(there[i].error, back[i].error, 1e-12);
        EXPECT_EQ(there[i].changes.size(), back[i].changes.size());
    }
}

TEST(CoveragePairs, LightThatIsNotFiniteIsInNoGain) {
    Scene scene(3);
    scene.light[0] = kNan;
    scene.light[40] = kInf;
    for (const CoveragePair& pair : compare_coverage(scene.reference, scene.test, scene.pixels())) {
        EXPECT_THAT(pair.light[0].gain(), DoubleNear(1, 1e-12));
        EXPECT_THAT(pair.light[2].error(), DoubleNear(0, 1e-6));
    }
}

TEST(LightRatio, IsOffWeakerStrongerOrNew) {
    const auto of = [](double r, double t, double noise = 0) {
        LightRatio ratio;
        for (int i = 0; i < 100; ++i)
            ratio.add(r, t + (i % 2 == 0 ? noise : -noise));
        return ratio;
    };
    EXPECT_EQ(of(1, 0).finding(100), "off");
    EXPECT_EQ(of(1, 0.9).finding(100), "weaker");
    EXPECT_EQ(of(1, 1.1).finding(100), "stronger");
    EXPECT_EQ(of(0, 1).finding(100), "new");
    EXPECT_EQ(of(0, 0).finding(100), "");
    EXPECT_EQ(of(1, 1.04).finding(100), ""); // less than 5 %
    EXPECT_EQ(of(1, 0.96).finding(100), "");
    // 10 % at an error of 1.6 % and of 1.7 %: 6.25 and 5.9 standard errors.
    EXPECT_EQ(of(1, 1.1, 0.16).finding(100), "stronger");
    EXPECT_EQ(of(1, 1.1, 0.17).finding(100), "");
    EXPECT_EQ(of(1, 0).finding(100 * 999), "off");
    EXPECT_EQ(of(1, 0).finding(100 * 1001), ""); // too faint to matter
    EXPECT_TRUE(std::isnan(of(0, 1).gain()));
    EXPECT_FALSE(of(0, 1).differs());
    EXPECT_NEAR(of(1, 1.1, 0.2).error(), std::sqrt(100 * 0.04) / 100, 1e-9);
}

} // namespace
} // namespace tonetool::metrics
