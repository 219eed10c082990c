// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/guided_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "guided_scene.h"
#include "kernels/guided_reference.h"
#include "kernels/guided_tile.h"
#include "target.h"
#include "tonemap/poisson.h"

namespace tonetool::kernels {
namespace {

// A weight is within 2.8e-6 for its polynomial; x itself, up to 10 where weights count, within a
// few roundings of 6e-8; sums of 1681 of them, by eights, 1e-6.
constexpr double kClose = 1e-5;
// Where values of 1e30 are about, means can hang on weights of 2^-120, whose exponents are known to
// 120 times a few roundings.
constexpr double kCloseIfHard = 4e-5;

/// Which terms there are: bits of a number below kChoices.
enum Choice { kP = 1, kN = 2, kA = 4, kL = 8, kOwnRange = 16, kAngles = 32, kChoices = 64 };

GuidePlanes chosen(GuidePlanes image, int choice) {
    for (int c = 0; c < 3; ++c) {
        image.position[c] = choice & kP ? image.position[c] : nullptr;
        image.normal[c] = choice & kN ? image.normal[c] : nullptr;
        image.albedo[c] = choice & kA ? image.albedo[c] : nullptr;
    }
    if (!(choice & kL))
        image.range = nullptr;
    else if (!(choice & kOwnRange))
        image.range = image.value;
    return image;
}

GuidedTerms terms_of(int choice) {
    GuidedTerms terms;
    terms.normal_term = choice & kAngles ? NormalTerm::Angle : NormalTerm::Distance;
    if (!(choice & kOwnRange))
        terms.range = 2;
    return terms;
}

const TapSets& whole() {
    static const TapSets taps({whole_window(20)}, 8);
    return taps;
}

const TapSets& some() {
    static const TapSets taps(tonemap::poisson_sets(20, 61), 8);
    return taps;
}

const TapSets& hashed() {
    static const TapSets taps(tonemap::poisson_sets(20, 61), 8, RunOrigin::Hashed);
    return taps;
}

std::vector<float> filtered(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                            Window window = {}) {
    if (window.width == 0)
        window = {0, 0, image.width, image.height};
    std::vector<float> out(size_t(window.width) * size_t(window.height));
    GuidedTile(image, terms, taps, window.width)
        .filter(window, [&](int x0, int y, int count, const float* base) {
            std::copy_n(base, count,
                        out.data() + (y - window.y0) * window.width + (x0 - window.x0));
        });
    return out;
}

bool same(float a, float b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}

double off(float ours, double exact) {
    if (std::isnan(exact) || std::isinf(exact))
        return std::isnan(exact) ? (std::isnan(ours) ? 0 : 1) : (double(ours) == exact ? 0 : 1);
    return exact == 0 ? std::abs(double(ours)) : std::abs(double(ours) / exact - 1);
}

double worst_of(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                double close) {
    const auto ours = filtered(image, terms, taps);
    double worst = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double here =
                off(ours[size_t(y * image.width + x)], guided_reference(image, terms, taps, x, y));
            EXPECT_LE(here, close) << x << " " << y;
            worst = std::max(worst, here);
        }
    return worst;
}

TEST(GuidedRows, AreCloseToTheReferenceImplementationForEveryChoiceOfTerms) {
    const GuidedScene plain(37, 23, 1), hard = hard_scene(37, 23, 2);
    double worst = 0;
    for (int choice = 0; choice < kChoices; ++choice)
        for (const GuidedScene* scene : {&plain, &hard}) {
            SCOPED_TRACE(choice);
            const double close = scene == &hard ? kCloseIfHard : kClose;
            const auto image = chosen(scene->view(), choice);
            worst = std::max(worst, worst_of(image, terms_of(choice), some(), close));
        }
    std::printf("  worst %.3g\n", worst);
}

TEST(GuidedRows, AreCloseToTheReferenceImplementationOnEveryTarget) {
    const GuidedScene plain(90, 47, 3), hard = hard_scene(90, 47, 4);
    for (int choice : {kP | kN | kA, kP | kN | kA | kL, kP | kN | kA | kL | kOwnRange | kAngles})
        on_every_target([&] {
            const double of_plain =
                worst_of(chosen(plain.view(), choice), terms_of(choice), whole(), kClose);
            const double of_hard =
                worst_of(chosen(hard.view(), choice), terms_of(choice), whole(), kCloseIfHard);
            std::printf("  %s: worst %.3g, %.3g\n", guided_rows().name, of_plain, of_hard);
        });
}

// Half a step of 1 / 8191 in each of two numbers moves an exponent of up to 8, which is where
// weights count, by less than 0.006, to both sides.
TEST(GuidedRows, InStepsAreCloseToTheReferenceImplementationOnEveryTarget) {
    constexpr double kCloseInSteps = 1e-3;
    const GuidedScene scene(90, 47, 3);
    GuidedTerms terms;
    terms.in_steps = true;
    for (int choice : {kP | kN | kA, kP | kN, int(kA), kN | kA | kL | kOwnRange, kP | kA | kL,
                       kP | kN | kA | kL | kAngles})
        on_every_target([&] {
            SCOPED_TRACE(choice);
            terms.range = choice & kOwnRange ? 0.4 : 2;
            terms.normal_term = choice & kAngles ? NormalTerm::Angle : NormalTerm::Distance;
            const auto image = chosen(scene.view(), choice);
            const double worst = worst_of(image, terms, some(), kCloseInSteps);
            std::printf("  %s: worst %.3g\n", guided_rows().name, worst);
        });
}

TEST(GuidedRows, InStepsOfUnlikeSigmas) {
    const GuidedScene scene(50, 30, 8);
    GuidedTerms terms;
    terms.in_steps = true;
    terms.normal = 0.5;
    terms.albedo = 0.1;
    worst_of(scene.view(), terms, some(), 2e-3);
}

TEST(GuidedRows, OfImagesSmallerThanTheWindow) {
    for (const auto& [w, h] : {std::pair{1, 1}, {2, 1}, {1, 3}, {5, 4}, {64, 2}, {65, 1}, {3, 70}})
        on_every_target([&, w = w, h = h] {
            const GuidedScene plain(w, h, 5), hard = hard_scene(w, h, 6);
            worst_of(chosen(plain.view(), kP | kN | kA | kL), terms_of(0), whole(), kClose);
            worst_of(chosen(hard.view(), kP | kN | kA | kL), terms_of(0), some(), kCloseIfHard);
        });
}

// Where an image of constant value has constant guides, every mean is that value.
TEST(GuidedRows, OfAConstantAreTheConstant) {
    GuidedScene scene(50, 45, 7);
    for (float value : {0.1f, 1.0f, 3.7e-5f, 12345.678f}) {
        std::fill(scene.plane[GuidedScene::kValue].begin(), scene.plane[GuidedScene::kValue].end(),
                  value);
        for (const TapSets* taps : {&whole(), &some()})
            on_every_target([&] {
                for (float mean : filtered(chosen(scene.view(), kP | kN | kA), {}, *taps))
                    ASSERT_NEAR(double(mean) / double(value), 1, 1e-6);
            });
    }
}

TEST(GuidedRows, BackgroundAndSurfacesDoNotMix) {
    GuidedScene scene(60, 50, 8);
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            scene.background[scene.at(x, y)] = uint8_t((x / 7 + y / 5) % 2);
            scene.plane[GuidedScene::kValue][scene.at(x, y)] = (x / 7 + y / 5) % 2 ? 1e30f : 1.0f;
        }
    for (int choice : {int(kN), kP | kN | kA, kN | kAngles}) {
        const auto out = filtered(chosen(scene.view(), choice), terms_of(choice), whole());
        for (size_t i = 0; i < out.size(); ++i)
            ASSERT_NEAR(double(out[i]), scene.background[i] ? 1e30 : 1, out[i] > 2 ? 1e24 : 1e-6);
    }
}

TEST(GuidedRows, ValuesThatAreNoneAreCopied) {
    const GuidedScene scene = hard_scene(40, 30, 9);
    const auto image = chosen(scene.view(), kP);
    const auto out = filtered(image, {}, some());
    for (size_t i = 0; i < out.size(); ++i)
        if (!(image.value[i] >= 0 && std::isfinite(image.value[i])))
            ASSERT_TRUE(same(out[i], image.value[i])) << i;
        else
            ASSERT_TRUE(std::isfinite(out[i])) << i;
}

// Any window, wherever it begins, gives the pixels of the whole; nothing beside it is written.
TEST(GuidedRows, DoNotDependOnTheWindow) {
    const GuidedScene scene = hard_scene(210, 61, 10);
    const auto image = chosen(scene.view(), kP | kN | kA | kL);
    on_every_target([&] {
        const auto all = filtered(image, {}, some());
        for (const Window& w : {Window{0, 0, 64, 61},
                                {64, 3, 64, 9},
                                {63, 60, 66, 1},
                                {1, 1, 1, 1},
                                {127, 20, 83, 41},
                                {209, 0, 1, 61}}) {
            const auto part = filtered(image, {}, some(), w);
            for (int y = 0; y < w.height; ++y)
                for (int x = 0; x < w.width; ++x)
                    ASSERT_TRUE(same(part[size_t(y * w.width + x)],
                                     all[size_t((y + w.y0) * 210 + x + w.x0)]))
                        << x + w.x0 << " " << y + w.y0;
        }
    });
}

TEST(GuidedRows, DoNotDependOnTheBandOfRows) {
    const GuidedScene scene(70, 100, 11);
    const auto image = chosen(scene.view(), kP | kN | kA);
    const auto all = filtered(image, {}, some(), {0, 50, 70, 10});
    GuidePlanes band = image;
    band.first_row = 30;
    const auto skip = [](const float* p) { return p ? p + 30 * 70 : nullptr; };
    band.value = skip(band.value);
    band.footprint = skip(band.footprint);
    band.background += 30 * 70;
    for (int c = 0; c < 3; ++c) {
        band.position[c] = skip(band.position[c]);
        band.normal[c] = skip(band.normal[c]);
        band.albedo[c] = skip(band.albedo[c]);
    }
    EXPECT_EQ(filtered(band, {}, some(), {0, 50, 70, 10}), all);
}

// Positions and footprints in another unit; one that is a power of 2 changes no bit.
TEST(GuidedRows, DoNotDependOnTheUnitOfPositions) {
    GuidedScene scene(80, 50, 12);
    const auto image = chosen(scene.view(), kP | kN | kA);
    const auto before = filtered(image, {}, some());
    for (float unit : {1024.0f, 1.0f / 4096}) {
        GuidedScene other = scene;
        for (int p : {1, 2, 3, int(GuidedScene::kFootprint)})
            for (float& v : other.plane[p])
                v *= unit;
        EXPECT_EQ(filtered(chosen(other.view(), kP | kN | kA), {}, some()), before) << unit;
    }
}

// Camera space or world space: positions and normals turned.
TEST(GuidedRows, DoNotDependOnTheFrame) {
    const GuidedScene scene(80, 50, 13);
    GuidedScene turned = scene;
    const double c = std::cos(0.7), s = std::sin(0.7);
    for (int first : {int(GuidedScene::kPosition), int(GuidedScene::kNormal)})
        for (size_t i = 0; i < scene.background.size(); ++i) {
            const double x = double(scene.plane[first][i]), z = double(scene.plane[first + 2][i]);
            turned.plane[first][i] = float(c * x - s * z);
            turned.plane[first + 2][i] = float(s * x + c * z);
        }
    for (int choice : {kP | kN | kA, kP | kN | kA | kAngles}) {
        const auto a = filtered(chosen(scene.view(), choice), terms_of(choice), some());
        const auto b = filtered(chosen(turned.view(), choice), terms_of(choice), some());
        for (size_t i = 0; i < a.size(); ++i)
            ASSERT_NEAR(double(b[i] / a[i]), 1, 2e-5) << i; // 1 ulp of position is 1e-5 footprints
    }
}

TEST(GuidedRows, OneFootprintForAllIsAPlaneOfIt) {
    GuidedScene scene(50, 30, 14);
    auto& plane = scene.plane[GuidedScene::kFootprint];
    std::fill(plane.begin(), plane.end(), 0.03f);
    auto image = chosen(scene.view(), kP | kN);
    const auto with = filtered(image, {}, some());
    image.footprint = nullptr;
    GuidedTerms terms;
    terms.footprint = double(0.03f);
    EXPECT_EQ(filtered(image, terms, some()), with);
}

// Each is within kCloseIfHard of the reference implementation.
TEST(GuidedRows, AreCloseAmongTargets) {
    const GuidedScene scene = hard_scene(130, 40, 15);
    const auto image = chosen(scene.view(), kP | kN | kA | kL);
    const auto best = filtered(image, {}, some());
    on_every_target([&] {
        const auto here = filtered(image, {}, some());
        for (size_t i = 0; i < best.size(); ++i)
            ASSERT_LE(off(here[i], double(best[i])), 2 * kCloseIfHard) << i;
    });
}

TEST(GuidedRows, OfHashedOriginsAreCloseToTheReferenceImplementation) {
    const GuidedScene scene(190, 27, 16);
    worst_of(chosen(scene.view(), kP | kN | kA | kL), terms_of(0), hashed(), kClose);
}

TEST(GuidedRows, OfHashedOriginsDoNotDependOnTheWindow) {
    const GuidedScene scene(210, 31, 17);
    const auto image = chosen(scene.view(), kP | kN | kA | kL);
    const auto all = filtered(image, {}, hashed());
    for (const Window& window :
         {Window{0, 0, 1, 31}, {63, 5, 2, 20}, {64, 0, 64, 9}, {101, 3, 109, 28}}) {
        const auto part = filtered(image, {}, hashed(), window);
        for (int y = 0; y < window.height; ++y)
            for (int x = 0; x < window.width; ++x)
                ASSERT_TRUE(same(part[size_t(y * window.width + x)],
                                 all[size_t((y + window.y0) * 210 + x + window.x0)]))
                    << x << " " << y;
    }
}

TEST(TapSets, OfHashedOriginsHaveOtherBordersInEachRow) {
    std::vector<int> borders(kGuidedRun);
    int alike = 0;
    for (int y = 0; y < 4096; ++y) {
        const int first = hashed().run_of(200, y);
        EXPECT_EQ(&hashed().at(first, y), &hashed().at(first + kGuidedRun - 1, y));
        EXPECT_EQ(hashed().run_of(first, y), first);
        EXPECT_LE(first, 200);
        EXPECT_GT(first + kGuidedRun, 200);
        ++borders[size_t(first % kGuidedRun)];
        alike += y > 0 && first == hashed().run_of(200, y - 1);
    }
    for (int count : borders)
        EXPECT_NEAR(count, 64, 40);
    EXPECT_NEAR(alike, 64, 40);
}

TEST(TapSets, AreChosenByPlaceAlone) {
    std::vector<int> used(64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 4096; x += kGuidedRun) {
            const auto* taps = &some().at(x, y);
            EXPECT_EQ(taps, &some().at(x + kGuidedRun - 1, y));
            ++used[size_t(taps - &some().at(0, 0) + 64) % 64];
        }
    // 4096 runs among 64 sets: 64 +- 8 each.
    for (int count : used)
        EXPECT_NEAR(count, 64, 40);
}

} // namespace
} // namespace tonetool::kernels
