// tonetool_bench: the evaluation of HDR-FLIP alone, without files or conversions, on a synthetic
// pair (a smooth HDR picture, 25 % noise on it): 9 exposures, one and all threads.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "flip/evaluate.h"
#include "flip/filters.h"
#include "imagebuf/parallel.h"
#include "kernels/flip_tile.h"
#include "kernels/flip_twin.h"
#include "tonemap/rational.h"

namespace {

using namespace tonetool;

constexpr int kExposures = 9;
constexpr double kPixelsPerDegree = 67.0206451;

struct Picture {
    int width, height;
    std::vector<float> plane[3];

    kernels::ConstRgb view() const {
        return {{plane[0].data(), plane[1].data(), plane[2].data()}, width, width, height};
    }
};

struct PicturePair {
    Picture reference, test;
};

PicturePair make_pair(int width, int height) {
    PicturePair out{{width, height, {}}, {width, height, {}}};
    std::mt19937 random(1);
    std::normal_distribution<float> noise(1.0f, 0.25f);
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float v = std::exp2(4.0f * std::sin(0.013f * float(x + 40 * c)) *
                                          std::cos(0.017f * float(y)));
                out.reference.plane[c].push_back(v);
                out.test.plane[c].push_back(v * std::max(noise(random), 0.0f));
            }
    return out;
}

std::vector<double> exposures() {
    std::vector<double> out;
    for (int i = 0; i < kExposures; ++i)
        out.push_back(-4.0 + i);
    return out;
}

// Runs `task` and reports wall time per pixel and exposure, the fastest repeat.
template <class Task>
void measure(benchmark::State& state, double pixels, const Task& task) {
    using Clock = std::chrono::steady_clock;
    double fastest = std::numeric_limits<double>::infinity();
    for (auto _ : state) {
        const auto start = Clock::now();
        task();
        const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
        fastest = std::min(fastest, spent.count());
    }
    state.counters["ns_per_px_exposure"] = fastest / (pixels * kExposures);
}

void evaluate(benchmark::State& state) {
    const int width = int(state.range(0)), height = int(state.range(1));
    const int threads = int(state.range(2));
    const PicturePair pair = make_pair(width, height);
    const flip::Evaluation what{flip::float_taps(flip::make_taps(kPixelsPerDegree)),
                                *tonemap::rational_curve("aces"), exposures()};
    std::vector<float> error(pair.reference.plane[0].size()), index(error.size());
    const flip::Output output{error.data(), index.data(), {}, width};
    measure(state, double(error.size()), [&] {
        flip::evaluate(what, pair.reference.view(), {pair.test.view()}, {0, 0, width, height},
                       {output}, make_parallel(threads));
        benchmark::DoNotOptimize(error.data());
    });
    state.SetLabel(kernels::flip_tile_target());
}

void evaluate_twin(benchmark::State& state) {
    const int width = int(state.range(0)), height = int(state.range(1));
    const PicturePair pair = make_pair(width, height);
    const auto taps = flip::make_taps(kPixelsPerDegree);
    measure(state, double(width) * height, [&] {
        benchmark::DoNotOptimize(kernels::hdr_flip_twin(pair.reference.view(), pair.test.view(),
                                                        taps, *tonemap::rational_curve("aces"),
                                                        exposures(), nullptr));
    });
}

constexpr int kAll = 0;

BENCHMARK(evaluate)
    ->ArgNames({"width", "height", "threads"})
    ->Args({512, 512, 1})
    ->Args({512, 512, kAll})
    ->Args({1920, 1080, 1})
    ->Args({1920, 1080, kAll})
    ->Args({3840, 2160, 1})
    ->Args({3840, 2160, kAll})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(evaluate_twin)
    ->ArgNames({"width", "height"})
    ->Args({512, 512})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

} // namespace
