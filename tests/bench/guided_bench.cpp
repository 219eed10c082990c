// SPDX-License-Identifier: BSD-3-Clause
// CG-TMO on a synthetic G-buffer, its base alone and the whole operator, next to a copy of the
// planes that it reads.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "imagebuf/pixels/parallel.h"
#include "kernels/guided_rows.h"
#include "tonemap/base.h"
#include "tonemap/footprint.h"
#include "tonemap/local.h"
#include "tonemap/luminance_means.h"
#include "tonemap/poisson.h"

namespace {

using namespace tonetool;
using Clock = std::chrono::steady_clock;

constexpr int kHalf = 20;
constexpr double kSigma = 8;

// Tilted walls with noise in everything: value, position, normal, albedo, log10, footprint, colour.
struct Scene {
    enum {
        kValue,
        kPosition,
        kNormal = 4,
        kAlbedo = 7,
        kRange = 10,
        kFootprint,
        kColor,
        kPlanes = 15
    };
    int width, height;
    std::vector<float> plane[kPlanes];

    Scene(int w, int h) : width(w), height(h) {
        for (auto& p : plane)
            p.resize(size_t(w) * size_t(h));
        std::mt19937 random(1);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                set(size_t(y) * size_t(w) + size_t(x), x * 1920 / w, y * 1080 / h, random);
    }

    void set(size_t i, int x, int y, std::mt19937& random) {
        const auto noise = [&] { return double(random()) / 4294967296.0 - 0.5; };
        const int cell = (x / 120 + y / 90 * 3) % 5;
        const double depth = 5 + 0.7 * cell + 0.002 * x;
        const double p[3] = {(x - 960) * depth / 1500, (y - 540) * depth / 1500, depth};
        const double n[3] = {0.3 * cell - 0.6, 0.2, 0.7};
        const double stops = 1.5 * std::sin(0.01 * x + 0.02 * y) + 0.6 * cell + 0.4 * noise();
        for (int c = 0; c < 3; ++c) {
            plane[kPosition + c][i] = float(p[c]);
            plane[kNormal + c][i] = float(n[c] + 0.02 * noise());
            plane[kAlbedo + c][i] = float(0.2 + 0.1 * ((cell * 7 + c * 3) % 5) + 0.05 * noise());
            plane[kColor + c][i] = float(std::exp(stops) * (1 + 0.2 * noise()));
        }
        plane[kValue][i] = float(std::exp(stops));
        plane[kRange][i] = float(std::log10(std::exp(stops)));
        plane[kFootprint][i] = float(depth / 1500);
    }

    kernels::GuidePlanes view(bool with_range) const {
        kernels::GuidePlanes out;
        out.value = plane[kValue].data();
        for (int c = 0; c < 3; ++c) {
            out.position[c] = plane[kPosition + c].data();
            out.normal[c] = plane[kNormal + c].data();
            out.albedo[c] = plane[kAlbedo + c].data();
        }
        out.range = with_range ? plane[kRange].data() : nullptr;
        out.footprint = plane[kFootprint].data();
        out.stride = out.width = width;
        out.height = height;
        return out;
    }
};

// The one that was asked for last.
const Scene& scene(int width = 1920, int height = 1080) {
    static std::unique_ptr<Scene> one;
    if (!one || one->width != width || one->height != height)
        one = std::make_unique<Scene>(width, height);
    return *one;
}

template <class Task>
double milliseconds(const Task& task) {
    const auto start = Clock::now();
    task();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// A copy of some planes, row by row on as many threads.
double copy_ms(const Scene& from, const std::vector<int>& planes, Scene& to,
               const kernels::ParallelFor& parallel) {
    const auto width = size_t(from.width);
    return milliseconds([&] {
        parallel(from.height, [&](int64_t y) {
            for (int p : planes)
                std::memcpy(to.plane[p].data() + size_t(y) * width,
                            from.plane[p].data() + size_t(y) * width, width * sizeof(float));
        });
    });
}

std::vector<int> numbers(int first, int end) {
    std::vector<int> out;
    for (int i = first; i < end; ++i)
        out.push_back(i);
    return out;
}

kernels::TapSets taps_of(int samples) {
    if (samples == 0)
        return {{kernels::whole_window(kHalf)}, kSigma};
    return {tonemap::poisson_sets(kHalf, samples), kSigma};
}

// Runs `what` and the copy in turn; the smallest times.
template <class What>
void beside_a_copy(benchmark::State& state, const Scene& from, const std::vector<int>& planes,
                   const kernels::ParallelFor& parallel, const What& what) {
    Scene to = from;
    double ours = std::numeric_limits<double>::infinity(), copy = ours;
    for ([[maybe_unused]] auto _ : state) {
        ours = std::min(ours, milliseconds(what));
        copy = std::min(copy, copy_ms(from, planes, to, parallel));
    }
    state.counters["ours_ms"] = ours;
    state.counters["copy_ms"] = copy;
    state.counters["copies"] = ours / copy;
    state.SetLabel(kernels::guided_rows().name);
}

// Arguments: samples (0: the whole window), the luminance term, threads (0: all).
void guided(benchmark::State& state) {
    const Scene& from = scene(1920, 1080);
    const kernels::TapSets taps = taps_of(int(state.range(0)));
    const bool with_range = state.range(1) != 0;
    const auto parallel = make_parallel(int(state.range(2)));
    kernels::GuidedTerms terms;
    terms.in_steps = state.range(0) > 0;
    std::vector<float> out(size_t(from.width) * size_t(from.height));
    auto planes = numbers(Scene::kValue, Scene::kColor);
    if (!with_range)
        planes.erase(planes.begin() + Scene::kRange);
    beside_a_copy(state, from, planes, parallel, [&] {
        tonemap::filter_base(from.view(with_range), terms, taps, {0, 0, from.width, from.height},
                             out.data(), from.width, parallel);
    });
}

// What ToneAlgo::cg_tmo does between reading and writing.
void whole_operator(const Scene& from, bool paper, const kernels::TapSets& taps, Scene& to,
                    const kernels::ParallelFor& parallel) {
    const kernels::ConstRgb color{{from.plane[Scene::kColor].data(),
                                   from.plane[Scene::kColor + 1].data(),
                                   from.plane[Scene::kColor + 2].data()},
                                  from.width,
                                  from.width,
                                  from.height};
    float* const luminance = to.plane[Scene::kValue].data();
    tonemap::LocalOperator what;
    parallel(from.height, [&](int64_t y) {
        const float* row[3];
        for (size_t c = 0; c < 3; ++c)
            row[c] = color.plane[c] + y * from.width;
        kernels::luminance_rows(what.curve.weights, row, luminance + y * from.width, from.width);
    });
    const auto means = tonemap::luminance_means(luminance, from.width, from.height, 1e-6, parallel);
    what.curve.adaptation = means.geometric;
    what.curve.maximum = means.max;
    what.logarithmic = !paper;
    what.luminance_sigma = paper ? 0 : 0.4;
    what.terms.in_steps = true;
    tonemap::take_logarithms(what, luminance, from.width, from.height, parallel);
    kernels::GuidePlanes guides = from.view(false);
    guides.value = luminance;
    float* const footprint = to.plane[Scene::kFootprint].data();
    tonemap::footprints(guides, tonemap::kFloatStep, footprint, parallel);
    guides.footprint = footprint;
    tonemap::LocalOutput out;
    for (int c = 0; c < 3; ++c)
        out.rgb[c] = to.plane[Scene::kColor + c].data();
    out.stride = from.width;
    tonemap::tone_map_guided(what, color, guides, taps, {0, 0, from.width, from.height}, out,
                             parallel);
}

// Arguments: columns (16 by 9), the paper's preset, threads (0: all).
void whole_cgtmo(benchmark::State& state) {
    const auto width = int(state.range(0));
    const Scene& from = scene(width, width * 9 / 16);
    const kernels::TapSets taps = taps_of(64);
    const auto parallel = make_parallel(int(state.range(2)));
    Scene to = from;
    std::vector<int> planes = numbers(Scene::kPosition, Scene::kRange);
    for (int c = 0; c < 3; ++c)
        planes.push_back(Scene::kColor + c);
    beside_a_copy(state, from, planes, parallel,
                  [&] { whole_operator(from, state.range(1) != 0, taps, to, parallel); });
    state.counters["ns_per_pixel"] =
        state.counters["ours_ms"] * 1e6 / (double(from.width) * double(from.height));
}

void guided_footprints(benchmark::State& state) {
    const Scene& from = scene(1920, 1080);
    const auto parallel = make_parallel(int(state.range(0)));
    std::vector<float> out(size_t(from.width) * size_t(from.height));
    beside_a_copy(state, from, numbers(Scene::kPosition, Scene::kNormal), parallel, [&] {
        tonemap::footprints(from.view(false), tonemap::kFloatStep, out.data(), parallel);
    });
}

constexpr int kAll = 0;

BENCHMARK(guided)
    ->ArgNames({"samples", "luminance", "threads"})
    ->ArgsProduct({{64, 80}, {0, 1}, {1, kAll}})
    ->Args({0, 0, kAll})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(whole_cgtmo)
    ->ArgNames({"columns", "paper", "threads"})
    ->ArgsProduct({{960, 1920, 3840}, {0, 1}, {1, kAll}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(guided_footprints)
    ->ArgNames({"threads"})
    ->Arg(1)
    ->Arg(kAll)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
} // namespace
