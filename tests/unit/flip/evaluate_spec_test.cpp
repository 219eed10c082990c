// SPDX-License-Identifier: BSD-3-Clause
// What flip::evaluate promises, whatever its kernels do to be quick.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "flip/evaluate.h"
#include "flip/filters.h"
#include "hdr_image.h"
#include "kernels/flip_reference.h"
#include "oracle.h"
#include "schedules.h"
#include "target.h"

namespace tonetool::flip {
namespace {

using kernels::Case;
using kernels::ConstRgb;
using kernels::Content;
using kernels::FlipTaps;
using kernels::HdrImage;
using kernels::name_of;
using kernels::on_every_target;
using kernels::Uniform;
using kernels::Window;

using Stops = std::vector<double>;

constexpr Content kContents[] = {Content::Noise, Content::Gradient, Content::Patches};

Evaluation evaluation(const std::string& curve, double ppd, Stops stops) {
    return {lane_taps(make_taps(ppd)), kernels::curve_of(curve), std::move(stops)};
}

// Results of one test within a window; stale at first, so that pixels left out show.
struct Maps {
    std::vector<float> error, index;
    std::vector<std::vector<float>> each;

    Maps(const Window& window, size_t exposures)
        : error(size_t(window.width) * size_t(window.height), -1.0f),
          index(error),
          each(exposures, error),
          m_stride(window.width) {}

    Output output() {
        Output out;
        out.error = error.data();
        out.index = index.data();
        for (auto& plane : each)
            out.per_exposure.push_back(plane.data());
        out.stride = m_stride;
        return out;
    }

private:
    ptrdiff_t m_stride;
};

bool operator==(const Maps& a, const Maps& b) {
    return a.error == b.error && a.index == b.index && a.each == b.each;
}

// Work that single exposures ask for may be left out where only the maximum is kept.
enum class Keep { Maximum, EachExposure };

std::vector<Maps> run(const Evaluation& what, const ConstRgb& reference,
                      const std::vector<ConstRgb>& tests, const Window& window, Keep keep) {
    const size_t planes = keep == Keep::EachExposure ? what.stops.size() : 0;
    std::vector<Maps> maps(tests.size(), Maps(window, planes));
    std::vector<Output> outputs;
    for (Maps& m : maps)
        outputs.push_back(m.output());
    evaluate(what, reference, tests, window, outputs, kernels::in_order());
    return maps;
}

Window all_of(const HdrImage& image) {
    return {0, 0, image.width, image.height};
}

Maps run(const Evaluation& what, const HdrImage& reference, const HdrImage& test, Keep keep) {
    return run(what, reference.view(), {test.view()}, all_of(reference), keep)[0];
}

void expect_zero(const Maps& maps) {
    const std::vector<float> zero(maps.error.size(), 0.0f);
    EXPECT_EQ(maps.error, zero);
    EXPECT_EQ(maps.index, zero);
    for (const auto& plane : maps.each)
        EXPECT_EQ(plane, zero);
}

// The pixels of a window cut out of maps of the whole image.
Maps cut(const Maps& whole, int width, const Window& w) {
    Maps out(w, whole.each.size());
    const auto copy = [&](const std::vector<float>& from, std::vector<float>& to) {
        for (int y = 0; y < w.height; ++y)
            std::copy_n(from.begin() + (w.y0 + y) * width + w.x0, w.width,
                        to.begin() + y * w.width);
    };
    copy(whole.error, out.error);
    copy(whole.index, out.index);
    for (size_t n = 0; n < whole.each.size(); ++n)
        copy(whole.each[n], out.each[n]);
    return out;
}

// ------------------------------------------------------------------ the formulas

class EvaluateSpec : public testing::TestWithParam<Case> {
protected:
    const FlipTaps<double> m_exact = make_taps(GetParam().ppd);
    const Evaluation m_what =
        evaluation(GetParam().curve, GetParam().ppd,
                   GetParam().curve == std::string("ldr") ? Stops{0.0} : Stops{-2.5, 1.3});

    void compare(const HdrImage& reference, const HdrImage& test) const {
        const auto expected = hdr_flip_reference(reference.view(), test.view(), m_exact,
                                                 m_what.curve, m_what.stops, nullptr);
        std::vector<float> first;
        on_every_target([&] {
            const auto ours = run(m_what, reference, test, Keep::Maximum).error;
            kernels::expect_close(ours, expected, kernels::kClose, kernels::kCloseBelow,
                                  "reference implementation");
            if (first.empty())
                first = ours;
            kernels::expect_close(ours, first, kernels::kAmongTargets, kernels::kCloseBelow,
                                  "first target");
        });
    }
};

// Thinner than any filter, beside the lengths of vectors, longer than any tile.
constexpr int kSizes[][2] = {{1, 1},    {1, 19},   {23, 1},   {7, 5},
                             {4097, 3}, {3, 4097}, {641, 97}, {97, 129}};

TEST_P(EvaluateSpec, MatchesTheReferenceImplementation) {
    for (size_t i = 0; i < std::size(kSizes); ++i)
        for (size_t j = 0; j < std::size(kContents); ++j) {
            const int width = kSizes[i][0], height = kSizes[i][1];
            // The reference implementation is slow: large images take one content each, by turns.
            if (width * height > 1000 &&
                (i + size_t(GetParam().ppd) + size_t(GetParam().curve[0])) % 3 != j)
                continue;
            SCOPED_TRACE(testing::Message() << kContents[j] << " " << width << "x" << height);
            const HdrImage reference = make_image(kContents[j], width, height, 11);
            compare(reference, disturbed(reference, 0.5, 12));
        }
}

std::vector<Case> all_cases() {
    std::vector<Case> out;
    for (const char* curve : {"ldr", "aces", "hable", "reinhard"})
        for (double ppd : {20.0, 45.0, 67.02, 134.0, 200.0})
            out.push_back({curve, ppd});
    return out;
}

INSTANTIATE_TEST_SUITE_P(Curves, EvaluateSpec, testing::ValuesIn(all_cases()), name_of);

// ------------------------------------------------------------------ windows

TEST(EvaluateWindows, AnyOffsetGivesTheBitsOfTheWhole) {
    constexpr int width = 211, height = 163;
    const HdrImage reference = make_image(Content::Noise, width, height, 21);
    const HdrImage test = disturbed(reference, 0.3, 22);
    const Evaluation what = evaluation("aces", 45, {-2.0, 1.5});
    on_every_target([&] {
        const Maps whole = run(what, reference, test, Keep::EachExposure);
        Uniform random(23);
        const auto below = [&random](int n) { return int(random() * n); };
        for (int i = 0; i < 36; ++i) {
            const Window w = [&] {
                const int x = below(width), y = below(height);
                return Window{x, y, 1 + below(std::min(width - x, 70)),
                              1 + below(std::min(height - y, 70))};
            }();
            SCOPED_TRACE(testing::Message()
                         << w.width << "x" << w.height << " at " << w.x0 << "," << w.y0);
            EXPECT_TRUE(run(what, reference.view(), {test.view()}, w, Keep::EachExposure)[0] ==
                        cut(whole, width, w));
        }
    });
}

// ------------------------------------------------------------------ identity

// An image somewhere in memory: `offset` floats behind where a vector would like it.
struct Placed {
    std::vector<float> data[3];
    ConstRgb view;

    Placed(const HdrImage& image, size_t offset, int spare) {
        const size_t stride = size_t(image.width + spare);
        for (int c = 0; c < 3; ++c) {
            data[c].assign(offset * size_t(c + 1) + stride * size_t(image.height), 1e6f);
            float* const at = data[c].data() + offset * size_t(c + 1);
            for (size_t y = 0; y < size_t(image.height); ++y)
                std::copy_n(image.plane[c].begin() + ptrdiff_t(y) * image.width, image.width,
                            at + y * stride);
            view.plane[c] = at;
        }
        view.stride = ptrdiff_t(stride);
        view.width = image.width;
        view.height = image.height;
    }
    Placed(const Placed&) = delete;
    Placed& operator=(const Placed&) = delete;
};

TEST(EvaluateIdentity, IsExactlyZeroWhereverTheImagesLie) {
    for (Content content : kContents) {
        const HdrImage image = make_image(content, 143, 101, 31);
        const Placed first(image, 0, 0), second(image, 1, 3), third(image, 5, 16);
        for (const char* curve : {"ldr", "aces", "hable", "reinhard"}) {
            SCOPED_TRACE(testing::Message() << content << " " << curve);
            const Evaluation what = evaluation(curve, 67.02, {-1.0, 2.0});
            on_every_target([&] {
                for (Keep keep : {Keep::Maximum, Keep::EachExposure})
                    for (const Maps& maps :
                         run(what, first.view, {second.view, third.view, first.view}, all_of(image),
                             keep))
                        expect_zero(maps);
            });
        }
    }
}

TEST(EvaluateIdentity, MinusZeroIsZero) {
    HdrImage zeros = make_image(Content::Patches, 40, 30, 32);
    for (auto& plane : zeros.plane)
        for (size_t i = 0; i < plane.size(); i += 3)
            plane[i] = 0.0f;
    HdrImage minus = zeros;
    for (auto& plane : minus.plane)
        for (size_t i = 0; i < plane.size(); i += 3)
            plane[i] = -0.0f;
    for (const char* curve : {"ldr", "aces"})
        on_every_target([&] {
            for (Keep keep : {Keep::Maximum, Keep::EachExposure})
                expect_zero(run(evaluation(curve, 67.02, {-1.0, 2.0}), zeros, minus, keep));
        });
}

// What differs elsewhere, in this tile or in its neighbours, does not reach further than filters
// do.
TEST(EvaluateIdentity, IsExactlyZeroBeyondTheReach) {
    constexpr int width = 330, height = 310;
    const Evaluation what = evaluation("aces", 30, {-1.0, 2.0});
    const int far = filter_radius(what.taps);
    const HdrImage reference = make_image(Content::Noise, width, height, 33);
    for (const Window& changed :
         {Window{96, 96, 96, 96}, Window{0, 0, 1, 1}, Window{95, 0, 1, height},
          Window{0, 200, width, 2}, Window{width - 1, height - 1, 1, 1}}) {
        SCOPED_TRACE(testing::Message() << changed.x0 << "," << changed.y0);
        HdrImage test = reference;
        for (auto& plane : test.plane)
            for (int y = changed.y0; y < changed.y0 + changed.height; ++y)
                for (int x = changed.x0; x < changed.x0 + changed.width; ++x)
                    plane[size_t(y * width + x)] *= 1.5f;
        on_every_target([&] {
            const Maps maps = run(what, reference, test, Keep::Maximum);
            int64_t felt = 0, beyond = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const int dx = std::max(changed.x0 - x, x - (changed.x0 + changed.width - 1));
                    const int dy = std::max(changed.y0 - y, y - (changed.y0 + changed.height - 1));
                    const float error = maps.error[size_t(y * width + x)];
                    (std::max(dx, dy) > far ? beyond : felt) += error != 0;
                }
            EXPECT_EQ(beyond, 0);
            EXPECT_GE(felt, changed.width * changed.height);
        });
    }
}

// ------------------------------------------------------------------ shortcuts

constexpr int kWidth = 223, kHeight = 131;

// Each exposure by itself, and the maximum over them.
Maps one_by_one(const Evaluation& what, const HdrImage& reference, const HdrImage& test) {
    Maps out(all_of(reference), what.stops.size());
    std::fill(out.error.begin(), out.error.end(), 0.0f);
    std::fill(out.index.begin(), out.index.end(), 0.0f);
    for (size_t n = 0; n < what.stops.size(); ++n) {
        const Evaluation alone{what.taps, what.curve, {what.stops[n]}};
        out.each[n] = run(alone, reference, test, Keep::EachExposure).error;
        for (size_t i = 0; i < out.error.size(); ++i)
            if (out.each[n][i] > out.error[i]) {
                out.error[i] = out.each[n][i];
                out.index[i] = float(n);
            }
    }
    return out;
}

constexpr int kWindowWidth = 71, kWindowHeight = 59;

std::vector<Window> windows_of(const HdrImage& image) {
    std::vector<Window> out;
    for (int y = 0; y < image.height; y += kWindowHeight)
        for (int x = 0; x < image.width; x += kWindowWidth)
            out.push_back({x, y, std::min(kWindowWidth, image.width - x),
                           std::min(kWindowHeight, image.height - y)});
    return out;
}

// Whatever work is left out for one exposure, tile or test, results are those of exposures alone
// and of windows that begin elsewhere than tiles do.
void expect_no_trace_of_shortcuts(const Evaluation& what, const HdrImage& reference,
                                  const std::vector<HdrImage>& tests) {
    std::vector<ConstRgb> views;
    for (const HdrImage& test : tests)
        views.push_back(test.view());
    on_every_target([&] {
        const auto together =
            run(what, reference.view(), views, all_of(reference), Keep::EachExposure);
        std::vector<Maps> maxima;
        for (size_t t = 0; t < tests.size(); ++t) {
            SCOPED_TRACE(testing::Message() << "test " << t);
            EXPECT_TRUE(together[t] == one_by_one(what, reference, tests[t]));
            EXPECT_TRUE(together[t] == run(what, reference, tests[t], Keep::EachExposure));
            maxima.push_back(together[t]);
            maxima.back().each.clear();
            EXPECT_TRUE(maxima[t] == run(what, reference, tests[t], Keep::Maximum));
        }
        EXPECT_TRUE(run(what, reference.view(), views, all_of(reference), Keep::Maximum) == maxima);
        for (const Window& window : windows_of(reference))
            for (Keep keep : {Keep::Maximum, Keep::EachExposure}) {
                const auto part = run(what, reference.view(), views, window, keep);
                const auto& expected = keep == Keep::Maximum ? maxima : together;
                for (size_t t = 0; t < tests.size(); ++t)
                    EXPECT_TRUE(part[t] == cut(expected[t], reference.width, window))
                        << "test " << t << " window at " << window.x0 << "," << window.y0;
            }
    });
}

TEST(EvaluateShortcuts, PairsThatDifferInOneCorner) {
    const HdrImage reference = make_image(Content::Noise, kWidth, kHeight, 41);
    std::vector<HdrImage> tests(4, reference);
    const size_t corners[] = {0, kWidth - 1, size_t(kWidth) * (kHeight - 1),
                              size_t(kWidth) * kHeight - 1};
    for (size_t t = 0; t < 4; ++t)
        tests[t].plane[t % 3][corners[t]] += 3.0f;
    expect_no_trace_of_shortcuts(evaluation("aces", 30, {-2.0, 1.0}), reference, tests);
}

// A pixel that is the last one of its window lies in the neighbourhood of three others.
TEST(EvaluateShortcuts, PairsThatDifferInTheNeighbourhoodOnly) {
    const HdrImage reference = make_image(Content::Noise, kWidth, kHeight, 49);
    std::vector<HdrImage> tests(2, reference);
    tests[0].plane[0][(kWindowHeight - 1) * kWidth + kWindowWidth - 1] += 3.0f;
    tests[1].plane[2][kWindowHeight * kWidth + 2 * kWindowWidth] += 3.0f;
    expect_no_trace_of_shortcuts(evaluation("aces", 30, {-2.0, 1.0}), reference, tests);
}

TEST(EvaluateShortcuts, DifferencesThatTheCurveClampsAway) {
    HdrImage reference = make_image(Content::Noise, kWidth, kHeight, 42);
    for (auto& plane : reference.plane)
        for (float& v : plane)
            v = 64 + v;
    const HdrImage bright = disturbed(reference, 0.3, 43);
    // A dark corner, which no exposure here turns white; it ends beside windows.
    HdrImage partly = bright;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kWindowHeight - 3; ++y)
            for (int x = 0; x < kWindowWidth - 2; ++x) {
                const auto i = size_t(y * kWidth + x);
                reference.plane[c][i] = 0.01f;
                partly.plane[c][i] = float(0.01 * (1 + 0.1 * c));
            }
    const Evaluation what = evaluation("aces", 30, {-8.0, -6.0, 3.0, 4.0});
    expect_no_trace_of_shortcuts(what, reference, {bright, partly});
    const Maps maps = run(what, reference, partly, Keep::EachExposure);
    const size_t lower_right = size_t(kWidth) * kHeight - 1;
    EXPECT_GT(maps.each[0][lower_right], 0.0f);
    EXPECT_EQ(maps.each[2][lower_right], 0.0f) << "both are white";
    EXPECT_EQ(maps.each[3][lower_right], 0.0f) << "both are white";
    EXPECT_GT(maps.each[3][0], 0.0f) << "the dark corner still differs";
}

TEST(EvaluateShortcuts, SomeOfManyTestsAreIdentical) {
    const HdrImage reference = make_image(Content::Patches, kWidth, kHeight, 44);
    HdrImage half = reference;
    for (int y = 0; y < kHeight; ++y)
        for (int x = kWidth / 2; x < kWidth; ++x)
            half.plane[1][size_t(y * kWidth + x)] *= 1.25f;
    expect_no_trace_of_shortcuts(evaluation("hable", 30, {-2.0, 1.0}), reference,
                                 {reference, disturbed(reference, 0.2, 45), half, reference, half,
                                  make_image(Content::Gradient, kWidth, kHeight, 46), reference});
}

TEST(EvaluateShortcuts, RepeatedAndUselessExposures) {
    const HdrImage reference = make_image(Content::Noise, kWidth, kHeight, 47);
    expect_no_trace_of_shortcuts(evaluation("aces", 30, {-120.0, 1.0, 1.0, -3.0, 100.0}), reference,
                                 {disturbed(reference, 0.2, 48), reference});
}

// ------------------------------------------------------------------ rounding

// What float lanes find hard: the error is steep where it is small, and flat areas leave nothing
// but rounding to the detectors.
enum class Hard { Flat, Steps, Zeros, Ramps, Noise };

std::string name_of_hard(const testing::TestParamInfo<Hard>& info) {
    const char* names[] = {"Flat", "Steps", "Zeros", "Ramps", "Noise"};
    return names[int(info.param)];
}

constexpr int kHardWidth = 96, kHardHeight = 80;

struct HardPair {
    HdrImage reference{kHardWidth, kHardHeight}, test{kHardWidth, kHardHeight};
};

// Fills a pair by value(random numbers of the patch, x, y) -> {reference, test}.
template <class Value>
HardPair patchwork(uint32_t seed, int patch, const Value& value) {
    HardPair out;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kHardHeight; ++y)
            for (int x = 0; x < kHardWidth; ++x) {
                const auto across = uint32_t((kHardWidth + patch - 1) / patch);
                Uniform random(seed * 7919 + uint32_t(y / patch) * across + uint32_t(x / patch) +
                               uint32_t(c) * 100003);
                const auto [r, t] = value(random, x, y);
                const auto i = size_t(y * kHardWidth + x);
                out.reference.plane[c][i] = float(r);
                out.test.plane[c][i] = float(t);
            }
    return out;
}

HardPair make_hard(Hard kind, uint32_t seed) {
    using Two = std::pair<double, double>;
    const auto stops = [](Uniform& random) { return std::exp2(20 * random() - 10); };
    switch (kind) {
    case Hard::Flat:
        return patchwork(seed, 24, [&](Uniform& random, int, int) {
            const double v = stops(random);
            return Two{v, v * (1 + 0.2 * (random() - 0.5))};
        });
    case Hard::Steps: // of 1.0001x, each image at its own places
        return patchwork(seed, 40, [&](Uniform& random, int x, int y) {
            const double v = stops(random);
            return Two{v * std::pow(1.0001, x / 5 + y / 7), v * std::pow(1.0001, x / 7 + y / 5)};
        });
    case Hard::Zeros:
        return patchwork(seed, 8, [&](Uniform& random, int, int) {
            const double v = stops(random), kind_of = random();
            return Two{kind_of < 0.5 ? 0 : v, kind_of < 0.3 || kind_of > 0.9 ? 0 : v};
        });
    case Hard::Ramps:
        return patchwork(seed, kHardWidth, [&](Uniform& random, int x, int y) {
            const double v = std::exp2(16 * random() - 8 + 0.02 * x - 0.03 * y);
            return Two{v, v * (1 + 1e-3 * std::sin(0.2 * x) * std::sin(0.1 * y))};
        });
    case Hard::Noise:
        break;
    }
    return patchwork(seed, 1, [&](Uniform& random, int, int) {
        const double v = std::exp2(12 * random() - 6);
        return Two{v, v * (1 + 0.5 * (random() - 0.5))};
    });
}

struct Deviation {
    std::vector<double> all;

    template <typename T>
    void add(const std::vector<T>& ours, const std::vector<double>& truth) {
        for (size_t i = 0; i < truth.size(); ++i)
            all.push_back(std::abs(double(ours[i]) - truth[i]));
    }
    double mean() const {
        return std::accumulate(all.begin(), all.end(), 0.0) / double(all.size());
    }
    double p999() const {
        std::vector<double> sorted = all;
        std::sort(sorted.begin(), sorted.end());
        return sorted[size_t(std::ceil(0.999 * double(sorted.size()))) - 1];
    }
};

class EvaluateRounding : public testing::TestWithParam<Hard> {};

// Lanes may take other roads to the result than the papers do, not less exact ones.
TEST_P(EvaluateRounding, IsHardlyLargerThanThatOfPlainFloat) {
    constexpr double may_be_larger = 1.5;
    Stops stops(21);
    std::iota(stops.begin(), stops.end(), -10.0);
    const Evaluation what = evaluation("aces", 67.02, stops);
    const auto taps = make_taps(67.02);
    Deviation plain;
    std::map<std::string, Deviation> lanes;
    for (uint32_t seed : {1, 2, 3}) {
        const HardPair pair = make_hard(GetParam(), seed);
        const ConstRgb r = pair.reference.view(), t = pair.test.view();
        const auto truth = hdr_flip_reference(r, t, taps, what.curve, stops, nullptr);
        plain.add(hdr_flip_reference(r, t, kernels::rounded(taps), what.curve, stops, nullptr),
                  truth);
        on_every_target([&] {
            lanes[kernels::flip_rows().name].add(
                run(what, pair.reference, pair.test, Keep::Maximum).error, truth);
        });
    }
    const auto text = [](double v) { return (testing::Message() << v).GetString(); };
    RecordProperty("plain_float_mean", text(plain.mean()));
    RecordProperty("plain_float_p999", text(plain.p999()));
    for (const auto& [target, deviation] : lanes) {
        RecordProperty(target + "_mean", text(deviation.mean()));
        RecordProperty(target + "_p999", text(deviation.p999()));
        EXPECT_LE(deviation.mean(), may_be_larger * plain.mean()) << target;
        EXPECT_LE(deviation.p999(), may_be_larger * plain.p999()) << target;
    }
}

INSTANTIATE_TEST_SUITE_P(Hard, EvaluateRounding,
                         testing::Values(Hard::Flat, Hard::Steps, Hard::Zeros, Hard::Ramps,
                                         Hard::Noise),
                         name_of_hard);

} // namespace
} // namespace tonetool::flip
