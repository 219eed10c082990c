// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/local.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "guided_scene.h"
#include "kernels/curve_reference.h"
#include "kernels/guided_reference.h"
#include "schedules.h"
#include "target.h"
#include "tonemap/poisson.h"

namespace tonetool::tonemap {
namespace {

using kernels::GuidedScene;
using kernels::GuidePlanes;
using kernels::HdrImage;
using kernels::TapSets;
using kernels::Window;

const TapSets& taps() {
    static const TapSets sets(poisson_sets(20, 40), 8);
    return sets;
}

struct Result {
    std::vector<float> plane[3];
};

std::vector<float> value_of(const LocalOperator& what, const HdrImage& image,
                            const kernels::ParallelFor& parallel) {
    std::vector<float> value(image.size());
    const float* const rgb[3] = {image.plane[0].data(), image.plane[1].data(),
                                 image.plane[2].data()};
    kernels::luminance_rows(what.curve.weights, rgb, value.data(), ptrdiff_t(value.size()));
    take_logarithms(what, value.data(), image.width, image.height, parallel);
    return value;
}

Result run(const LocalOperator& what, const HdrImage& image, const GuidePlanes& guides,
           Window window = {}, const kernels::ParallelFor& parallel = kernels::in_order()) {
    if (window.width == 0)
        window = {0, 0, image.width, image.height};
    Result out;
    const size_t size = size_t(window.width) * size_t(window.height);
    LocalOutput to;
    to.stride = window.width;
    for (size_t c = 0; c < 3; ++c) {
        out.plane[c].resize(size);
        to.rgb[c] = out.plane[c].data();
    }
    const auto value = value_of(what, image, parallel);
    GuidePlanes planes = guides;
    planes.value = value.data();
    planes.stride = planes.width = image.width;
    planes.height = image.height;
    std::vector<float> base(size);
    guided_base(what, planes, taps(), window, base.data(), window.width, parallel);
    tone_map_local(what, image.view(), {base.data(), window.width}, window, to, parallel);
    const Result with_base = out;
    tone_map_guided(what, image.view(), planes, taps(), window, to, parallel);
    for (size_t c = 0; c < 3; ++c)
        EXPECT_EQ(with_base.plane[c], out.plane[c]);
    return out;
}

GuidePlanes guides_of(const GuidedScene& scene) {
    GuidePlanes out = scene.view();
    out.value = out.range = nullptr;
    return out;
}

std::vector<LocalOperator> operators() {
    std::vector<LocalOperator> all(4);
    for (size_t i = 0; i < all.size(); ++i) {
        all[i].curve.adaptation = 0.4;
        all[i].curve.maximum = 30;
        all[i].logarithmic = i % 2 == 1;
        all[i].luminance_sigma = i >= 2 ? 0.4 : 0;
    }
    return all;
}

TEST(LocalOperator, OfAConstantIsTheGlobalCurve) {
    const GuidedScene scene(70, 45, 1);
    for (float light : {0.02f, 0.7f, 12.0f}) {
        HdrImage image(70, 45);
        for (auto& plane : image.plane)
            std::fill(plane.begin(), plane.end(), light);
        for (const LocalOperator& what : operators()) {
            const double expected = kernels::curve_reference(
                {kernels::CurveKind::Drago, {what.curve.maximum / what.curve.adaptation, 0.85}},
                double(light) / what.curve.adaptation);
            for (float y : run(what, image, guides_of(scene)).plane[1])
                ASSERT_NEAR(double(y), expected, 1e-6);
        }
    }
}

TEST(LocalOperator, BrightestFlatPartIsTheDisplaysMaximum) {
    HdrImage image(50, 50);
    for (auto& plane : image.plane)
        std::fill(plane.begin(), plane.end(), 30.0f);
    for (LocalOperator what : operators())
        for (double bias : {0.7, 0.85, 0.95}) {
            what.curve.bias = bias;
            what.curve.display_maximum = 120;
            EXPECT_NEAR(double(run(what, image, {}).plane[0][700]), 1.2, 2e-6);
        }
}

// Base and curve by the reference implementations.
TEST(LocalOperator, IsCloseToTheReferenceImplementations) {
    const GuidedScene scene(61, 40, 2);
    const HdrImage image = make_image(kernels::Content::Noise, 61, 40, 3);
    for (const LocalOperator& what : operators()) {
        const Result ours = run(what, image, guides_of(scene));
        GuidedScene exact = scene;
        GuidePlanes view = exact.view();
        for (size_t i = 0; i < image.size(); ++i) {
            const double lum = 0.2126 * double(image.plane[0][i]) +
                               0.7152 * double(image.plane[1][i]) +
                               0.0722 * double(image.plane[2][i]);
            exact.plane[GuidedScene::kValue][i] = float(what.logarithmic ? std::log(lum) : lum);
            exact.plane[GuidedScene::kRange][i] = float(std::log10(lum));
        }
        if (what.luminance_sigma == 0)
            view.range = nullptr;
        kernels::GuidedTerms terms;
        terms.least = std::numeric_limits<float>::lowest();
        kernels::LocalCurve curve = what.curve;
        curve.log_base = what.logarithmic;
        for (int y = 0; y < 40; y += 3)
            for (int x = 0; x < 61; x += 2) {
                const size_t i = exact.at(x, y);
                const double base = kernels::guided_reference(view, terms, taps(), x, y);
                const auto pixel =
                    kernels::local_reference(curve, base,
                                             {double(image.plane[0][i]), double(image.plane[1][i]),
                                              double(image.plane[2][i])});
                for (size_t c = 0; c < 3; ++c)
                    ASSERT_NEAR(double(ours.plane[c][i]) / pixel[c], 1, 2e-5);
            }
    }
}

TEST(LocalOperator, DependsOnNeitherWindowNorSchedule) {
    const GuidedScene scene = kernels::hard_scene(150, 90, 4);
    HdrImage image = make_image(kernels::Content::Noise, 150, 90, 5);
    image.plane[1][777] = std::numeric_limits<float>::quiet_NaN();
    for (const LocalOperator& what : operators()) {
        const Result all = run(what, image, guides_of(scene));
        EXPECT_EQ(all.plane[1][777], 0);
        for (const auto& parallel : {kernels::backwards(), kernels::on_threads(3)})
            EXPECT_EQ(run(what, image, guides_of(scene), {}, parallel).plane[2], all.plane[2]);
        const Window w{37, 22, 80, 31};
        const Result part = run(what, image, guides_of(scene), w);
        for (int y = 0; y < w.height; ++y)
            for (int x = 0; x < w.width; ++x)
                ASSERT_EQ(part.plane[0][size_t(y * w.width + x)],
                          all.plane[0][size_t((y + w.y0) * 150 + x + w.x0)]);
    }
}

// What the base keeps apart stays apart: a step of light across a corner of the room is no halo.
TEST(LocalOperator, LeavesNoHaloAcrossNormals) {
    GuidedScene scene(80, 30, 6);
    HdrImage image(80, 30);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 80; ++x) {
            const size_t i = scene.at(x, y);
            for (int c = 0; c < 3; ++c) {
                scene.plane[GuidedScene::kNormal + c][i] = c == (x < 40 ? 0 : 1) ? 1.0f : 0.0f;
                scene.plane[GuidedScene::kPosition + c][i] = float(c == 0 ? x : c == 1 ? y : 0);
                scene.plane[GuidedScene::kAlbedo + c][i] = 0.5f;
                image.plane[c][i] = x < 40 ? 20.0f : 0.1f;
            }
            scene.plane[GuidedScene::kFootprint][i] = 1;
        }
    LocalOperator what = operators()[0];
    const Result out = run(what, image, guides_of(scene));
    for (int x = 41; x < 79; ++x)
        EXPECT_NEAR(double(out.plane[0][scene.at(x, 15)] / out.plane[0][scene.at(79, 15)]), 1, 1e-3)
            << x;
    EXPECT_GT(run(what, image, {}).plane[0][scene.at(79, 15)],
              1.5f * run(what, image, {}).plane[0][scene.at(41, 15)])
        << "without guides there is one";
}

TEST(LocalOperator, PartsAreTheBaseAndWhatIsLeft) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    HdrImage image(5, 1);
    for (auto& plane : image.plane)
        plane = {3, 3, 0, 3, 3};
    for (bool logarithmic : {false, true}) {
        LocalOperator what;
        what.logarithmic = logarithmic;
        const float two = logarithmic ? std::log(2.0f) : 2;
        const std::vector<float> base{two, nan, nan, logarithmic ? -1000 : 0.0f, two};
        const Window window{1, 0, 4, 1};
        std::vector<float> parts[2];
        for (LocalPart part : {LocalPart::Base, LocalPart::Detail}) {
            parts[int(part)].resize(4);
            local_part(what, image.view(), {base.data() + 1, 5}, window, part,
                       parts[int(part)].data(), 4, kernels::in_order());
        }
        const double expected[2][4] = {{3, 0, 3, 2}, {1, 1, 1, 1.5}};
        for (int part = 0; part < 2; ++part)
            for (size_t x = 0; x < 4; ++x)
                EXPECT_NEAR(double(parts[part][x]), expected[part][x], 1e-6) << part << " " << x;
    }
}

TEST(LocalOperator, RunsOnEveryTarget) {
    const GuidedScene scene = kernels::hard_scene(90, 40, 7);
    const HdrImage image = make_image(kernels::Content::Gradient, 90, 40, 8);
    for (const LocalOperator& what : operators()) {
        const Result best = run(what, image, guides_of(scene));
        kernels::on_every_target([&] {
            const Result here = run(what, image, guides_of(scene));
            for (size_t i = 0; i < image.size(); ++i)
                ASSERT_NEAR(double(here.plane[0][i] / best.plane[0][i]), 1, 2e-5);
        });
    }
}

} // namespace
} // namespace tonetool::tonemap
