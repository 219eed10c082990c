// SPDX-License-Identifier: BSD-3-Clause
// Weighted means and variances of the guided window, and the rows that noise is measured in,
// against their reference implementations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "guided_scene.h"
#include "kernels/guided_reference.h"
#include "kernels/guided_tile.h"
#include "kernels/noise_rows.h"
#include "target.h"
#include "tonemap/poisson.h"

namespace tonetool::kernels {
namespace {

// A weight is within 2.8e-6 for its polynomial, and exponents within a few roundings.
constexpr double kCloseMoments = 1e-5;
// A variance is what is left of the mean square about the pixel when the square of the mean is
// taken from it: a few roundings of the former.
constexpr double kOfSquare = 5e-7;

// Its value is the natural logarithm of luminance; normals are of unit length and albedo is finite,
// as in a G-buffer.
struct LogScene {
    GuidedScene scene;

    explicit LogScene(const GuidedScene& from) : scene(from) {
        for (float& v : scene.plane[GuidedScene::kValue])
            v = std::isfinite(v) && v >= 0 ? std::log(std::max(v, 1e-6f))
                                           : std::numeric_limits<float>::quiet_NaN();
        for (size_t i = 0; i < scene.background.size(); ++i)
            settle(i);
    }

    GuidePlanes view(bool position, bool normal, bool albedo) const {
        GuidePlanes out = scene.view();
        out.range = nullptr;
        for (int c = 0; c < 3; ++c) {
            out.position[c] = position ? out.position[c] : nullptr;
            out.normal[c] = normal ? out.normal[c] : nullptr;
            out.albedo[c] = albedo ? out.albedo[c] : nullptr;
        }
        return out;
    }

private:
    void settle(size_t i) {
        double square = 0;
        for (int c = 0; c < 3; ++c)
            square += std::pow(double(scene.plane[GuidedScene::kNormal + c][i]), 2);
        for (int c = 0; c < 3; ++c) {
            float& n = scene.plane[GuidedScene::kNormal + c][i];
            n = square > 0 && square < 1e30 ? float(double(n) / std::sqrt(square)) : 0;
            float& a = scene.plane[GuidedScene::kAlbedo + c][i];
            a = std::isfinite(a) ? std::clamp(a, 0.0f, 1.0f) : 0;
        }
    }
};

GuidedTerms of_logarithms() {
    GuidedTerms terms;
    terms.least = std::numeric_limits<float>::lowest();
    return terms;
}

const TapSets& whole_taps() {
    static const TapSets taps({whole_window(20)}, 8);
    return taps;
}

const TapSets& some_taps() {
    static const TapSets taps(tonemap::poisson_sets(20, 61), 8);
    return taps;
}

struct Planes {
    std::vector<float> mean, variance;
};

Planes moments_of(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                  Window window = {}) {
    if (window.width == 0)
        window = {0, 0, image.width, image.height};
    const size_t size = size_t(window.width) * size_t(window.height);
    Planes out{std::vector<float>(size), std::vector<float>(size)};
    GuidedTile(image, terms, taps, window.width)
        .moments(window, [&](int x0, int y, int count, const float* mean, const float* variance) {
            const size_t at = size_t(y - window.y0) * size_t(window.width) + size_t(x0 - window.x0);
            std::copy_n(mean, count, out.mean.begin() + ptrdiff_t(at));
            std::copy_n(variance, count, out.variance.begin() + ptrdiff_t(at));
        });
    return out;
}

void expect_moments(const GuidePlanes& image, const GuidedTerms& terms, const TapSets& taps,
                    double close) {
    const Planes ours = moments_of(image, terms, taps);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto i = size_t(y * image.width + x);
            const GuidedMoments exact = moments_reference(image, terms, taps, x, y);
            if (std::isnan(exact.mean)) {
                ASSERT_TRUE(std::isnan(ours.mean[i])) << x << " " << y;
                ASSERT_EQ(ours.variance[i], 0) << x << " " << y;
                continue;
            }
            const double away = exact.mean - double(image.value[i]);
            const double square = exact.variance + away * away;
            const double spread = std::sqrt(square);
            ASSERT_NEAR(double(ours.mean[i]), exact.mean,
                        close * spread + 2e-7 * std::abs(exact.mean))
                << x << " " << y;
            ASSERT_NEAR(double(ours.variance[i]), exact.variance,
                        close * exact.variance + kOfSquare * square + double(kLeastVariance))
                << x << " " << y;
        }
}

TEST(Moments, AreCloseToTheReferenceImplementationForEveryChoiceOfTerms) {
    const LogScene plain(GuidedScene(37, 23, 1)), hard(hard_scene(37, 23, 2));
    for (int choice = 0; choice < 16; ++choice)
        for (const LogScene* scene : {&plain, &hard}) {
            SCOPED_TRACE(choice);
            GuidedTerms terms = of_logarithms();
            terms.normal_term = choice & 8 ? NormalTerm::Angle : NormalTerm::Distance;
            expect_moments(scene->view(choice & 1, choice & 2, choice & 4), terms, some_taps(),
                           kCloseMoments);
        }
}

TEST(Moments, AreCloseToTheReferenceImplementationOnEveryTarget) {
    const LogScene plain(GuidedScene(90, 47, 3)), hard(hard_scene(90, 47, 4));
    on_every_target([&] {
        for (const LogScene* scene : {&plain, &hard})
            expect_moments(scene->view(true, true, true), of_logarithms(), whole_taps(),
                           kCloseMoments);
        // As with the means: half a step of 1 / 8191 moves weights by less than 1e-3.
        GuidedTerms in_steps = of_logarithms();
        in_steps.in_steps = true;
        expect_moments(plain.view(true, true, true), in_steps, some_taps(), 2e-3);
        expect_moments(plain.view(false, true, false), in_steps, some_taps(), 2e-3);
    });
}

TEST(Moments, HaveTheMeansOfTheFilter) {
    const LogScene scene(hard_scene(130, 40, 5));
    const auto image = scene.view(true, true, true);
    std::vector<float> means;
    GuidedTile(image, of_logarithms(), some_taps(), image.width)
        .filter({0, 0, image.width, image.height}, [&](int, int, int count, const float* mean) {
            means.insert(means.end(), mean, mean + count);
        });
    const Planes ours = moments_of(image, of_logarithms(), some_taps());
    for (size_t i = 0; i < means.size(); ++i)
        if (!std::isnan(means[i]))
            ASSERT_NEAR(double(ours.mean[i]), double(means[i]), 2e-5) << i;
}

// However dark it is.
TEST(Moments, OfAConstantHaveNoVariance) {
    GuidedScene scene(70, 45, 6);
    for (float value : {1e-5f, 0.3f, 4e4f}) {
        auto& plane = scene.plane[GuidedScene::kValue];
        std::fill(plane.begin(), plane.end(), value);
        const LogScene logs(scene);
        on_every_target([&] {
            const Planes out =
                moments_of(logs.view(true, true, true), of_logarithms(), whole_taps());
            EXPECT_EQ(out.mean, logs.scene.plane[GuidedScene::kValue]);
            for (float v : out.variance)
                ASSERT_EQ(v, 0);
        });
    }
}

TEST(Moments, DoNotDependOnTheWindow) {
    const LogScene scene(hard_scene(210, 61, 7));
    const auto image = scene.view(true, true, true);
    on_every_target([&] {
        const Planes all = moments_of(image, of_logarithms(), some_taps());
        for (const Window& w : {Window{63, 60, 66, 1}, {1, 1, 1, 1}, {127, 20, 83, 41}}) {
            const Planes part = moments_of(image, of_logarithms(), some_taps(), w);
            for (int y = 0; y < w.height; ++y)
                for (int x = 0; x < w.width; ++x) {
                    const auto here = size_t(y * w.width + x);
                    const auto there = size_t((y + w.y0) * 210 + x + w.x0);
                    ASSERT_EQ(part.variance[here], all.variance[there]) << x << " " << y;
                    if (!std::isnan(all.mean[there]))
                        ASSERT_EQ(part.mean[here], all.mean[there]) << x << " " << y;
                }
        }
    });
}

TEST(NoiseRows, AreCloseToTheReferenceImplementationOnEveryTarget) {
    for (const auto& [w, h] :
         {std::pair{90, 21}, {1, 1}, {2, 1}, {1, 5}, {16, 3}, {17, 2}, {33, 4}})
        for (const LogScene& scene :
             {LogScene(GuidedScene(w, h, 8)), LogScene(hard_scene(w, h, 9))})
            for (int choice = 0; choice < 4; ++choice)
                on_every_target([&, w = w, h = h] {
                    const auto image = scene.view(true, choice & 1, choice & 2);
                    std::vector<float> flat(size_t(w) + 1, 7), square(size_t(w) + 1, 7);
                    for (int y = 0; y < h; ++y) {
                        noise_row(image, y, flat.data(), square.data());
                        for (int x = 0; x < w; ++x) {
                            const NoiseShare exact = noise_reference(image, x, y);
                            // Exponents and h are known to a few roundings of the logarithms;
                            // weights below 1e-9 are nothing beside those of a box.
                            ASSERT_NEAR(double(flat[size_t(x)]), exact.flat,
                                        2e-5 * exact.flat + 1e-9)
                                << x << " " << y;
                            const double value = std::abs(double(image.value[y * w + x]));
                            const double of_h = std::isfinite(value) ? 5e-7 * (1 + value) : 0;
                            ASSERT_NEAR(double(square[size_t(x)]), exact.square,
                                        2e-5 * exact.square + of_h * std::sqrt(exact.square) + 1e-9)
                                << x << " " << y;
                        }
                        EXPECT_EQ(flat[size_t(w)], 7);
                        EXPECT_EQ(square[size_t(w)], 7);
                    }
                });
}

} // namespace
} // namespace tonetool::kernels
