// The base of CG-TMO at 1080p on a synthetic G-buffer, next to a copy of the planes it reads.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "imagebuf/parallel.h"
#include "kernels/guided_rows.h"
#include "tonemap/base.h"
#include "tonemap/footprint.h"
#include "tonemap/poisson.h"

namespace {

using namespace tonetool;
using Clock = std::chrono::steady_clock;

constexpr int kWidth = 1920, kHeight = 1080, kHalf = 20;
constexpr double kSigma = 8;

// Tilted walls with noise in everything: value, position, normal, albedo, log10, footprint.
struct Scene {
    enum { kValue, kPosition, kNormal = 4, kAlbedo = 7, kRange = 10, kFootprint, kPlanes };
    std::vector<float> plane[kPlanes];

    Scene() {
        for (auto& p : plane)
            p.resize(size_t(kWidth) * size_t(kHeight));
        std::mt19937 random(1);
        const auto noise = [&] { return double(random()) / 4294967296.0 - 0.5; };
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const size_t i = size_t(y) * kWidth + size_t(x);
                const int cell = (x / 120 + y / 90 * 3) % 5;
                const double depth = 5 + 0.7 * cell + 0.002 * x;
                const double p[3] = {(x - 960) * depth / 1500, (y - 540) * depth / 1500, depth};
                const double n[3] = {0.3 * cell - 0.6, 0.2, 0.7};
                for (int c = 0; c < 3; ++c) {
                    plane[kPosition + c][i] = float(p[c]);
                    plane[kNormal + c][i] = float(n[c] + 0.02 * noise());
                    plane[kAlbedo + c][i] =
                        float(0.2 + 0.1 * ((cell * 7 + c * 3) % 5) + 0.05 * noise());
                }
                const double stops =
                    1.5 * std::sin(0.01 * x + 0.02 * y) + 0.6 * cell + 0.4 * noise();
                plane[kValue][i] = float(std::exp(stops));
                plane[kRange][i] = float(std::log10(std::exp(stops)));
                plane[kFootprint][i] = float(depth / 1500);
            }
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
        out.stride = out.width = kWidth;
        out.height = kHeight;
        return out;
    }
};

const Scene& scene() {
    static const Scene one;
    return one;
}

template <class Task>
double milliseconds(const Task& task) {
    const auto start = Clock::now();
    task();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// A copy of the planes that the filter reads, row by row on as many threads.
double copy_ms(std::vector<std::vector<float>>& to, const kernels::ParallelFor& parallel,
               bool with_range) {
    return milliseconds([&] {
        parallel(kHeight, [&](int64_t y) {
            for (size_t p = 0; p < Scene::kPlanes; ++p)
                if (with_range || p != Scene::kRange)
                    std::memcpy(to[p].data() + y * kWidth, scene().plane[p].data() + y * kWidth,
                                kWidth * sizeof(float));
        });
    });
}

// Arguments: samples (0: the whole window), the luminance term, threads (0: all).
void guided(benchmark::State& state) {
    const auto samples = int(state.range(0)), threads = int(state.range(2));
    const bool with_range = state.range(1) != 0;
    const kernels::TapSets taps(
        samples > 0 ? tonemap::poisson_sets(kHalf, samples)
                    : std::vector<std::vector<kernels::Offset>>{kernels::whole_window(kHalf)},
        kSigma);
    kernels::GuidedTerms terms;
    terms.in_steps = samples > 0;
    const auto parallel = make_parallel(threads);
    std::vector<float> out(size_t(kWidth) * size_t(kHeight));
    std::vector<std::vector<float>> copies(Scene::kPlanes, out);
    double filter = std::numeric_limits<double>::infinity(), copy = filter;
    for ([[maybe_unused]] auto _ : state) {
        filter = std::min(filter, milliseconds([&] {
                              tonemap::filter_base(scene().view(with_range), terms, taps,
                                                   {0, 0, kWidth, kHeight}, out.data(), kWidth,
                                                   parallel);
                          }));
        copy = std::min(copy, copy_ms(copies, parallel, with_range));
        benchmark::DoNotOptimize(out.data());
    }
    state.counters["filter_ms"] = filter;
    state.counters["copy_ms"] = copy;
    state.counters["copies"] = filter / copy;
    state.SetLabel(kernels::guided_rows().name);
}

void guided_footprints(benchmark::State& state) {
    const auto parallel = make_parallel(int(state.range(0)));
    std::vector<float> out(size_t(kWidth) * size_t(kHeight));
    double fastest = std::numeric_limits<double>::infinity();
    for ([[maybe_unused]] auto _ : state)
        fastest = std::min(fastest, milliseconds([&] {
                               tonemap::footprints(scene().view(false), tonemap::kFloatStep,
                                                   out.data(), parallel);
                           }));
    state.counters["wall_ms"] = fastest;
}

void guided_sets(benchmark::State& state) {
    double fastest = std::numeric_limits<double>::infinity();
    for ([[maybe_unused]] auto _ : state)
        fastest = std::min(fastest, milliseconds([&] {
                               benchmark::DoNotOptimize(
                                   tonemap::poisson_sets(kHalf, int(state.range(0))));
                           }));
    state.counters["wall_ms"] = fastest;
}

constexpr int kAll = 0;

BENCHMARK(guided)
    ->ArgNames({"samples", "luminance", "threads"})
    ->ArgsProduct({{64, 80}, {0, 1}, {1, kAll}})
    ->Args({0, 0, kAll})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(guided_footprints)
    ->ArgNames({"threads"})
    ->Arg(1)
    ->Arg(kAll)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(guided_sets)
    ->ArgNames({"samples"})
    ->Arg(80)
    ->Arg(400)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

} // namespace
