// SPDX-License-Identifier: BSD-3-Clause
// tonetool_bench [--target=NAME] [options of Google Benchmark]: the evaluation of HDR-FLIP alone,
// without files or conversions, on a synthetic pair (a smooth HDR picture, 25 % noise on it). Every
// figure is that of the fastest repeat; cycles are those of the core, measured between the repeats.
#include <benchmark/benchmark.h>
#include <hwy/targets.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <exception>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "flip/evaluate.h"
#include "flip/filters.h"
#include "imagebuf/color/view.h"
#include "imagebuf/pixels/parallel.h"
#include "kernels/flip_reference.h"
#include "kernels/flip_rows.h"
#include "kernels/lut_rows.h"
#include "metrics/luminance.h"
#include "stages.h"
#include "tonemap/rational.h"

namespace {

using namespace tonetool;

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

// The test equals the reference but for a corner of 64 x 64 pixels.
PicturePair make_corner_pair(int width, int height) {
    PicturePair out = make_pair(width, height);
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                if (x >= 64 || y >= 64) {
                    const size_t i = size_t(y) * size_t(width) + size_t(x);
                    out.test.plane[c][i] = out.reference.plane[c][i];
                }
    return out;
}

// As many as asked for, over the range that HDR-FLIP takes for the pair: its maximum is 16, its
// median 1, and ACES brings 2.119 to the brightness of the paper.
std::vector<double> exposures(int count) {
    const double start = std::log2(2.119 / 16), stop = std::log2(2.119);
    std::vector<double> out;
    for (int i = 0; i < count; ++i)
        out.push_back(start + (stop - start) * i / (count - 1));
    return out;
}

// Nanoseconds of one core cycle: each step of the loop is an exclusive or and an addition that wait
// for one another, one cycle each. Clock speed drops out of what is divided by it.
double cycle_ns() {
    using Clock = std::chrono::steady_clock;
    constexpr int steps = 200000;
    double fastest = std::numeric_limits<double>::infinity();
    for (int repeat = 0; repeat < 20; ++repeat) {
        uint64_t x = uint64_t(repeat) + 1;
        const auto start = Clock::now();
        for (int i = 0; i < steps; i += 8)
            for (int j = 0; j < 8; ++j)
                x = (x ^ 0x9e3779b97f4a7c15u) + 0x632be59bd9b4e019u;
        benchmark::DoNotOptimize(x);
        const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
        fastest = std::min(fastest, spent.count() / (2.0 * steps));
    }
    return fastest;
}

// CPU time of all threads of the program.
double cpu_ns() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) * 1e9 + double(now.tv_nsec);
}

// The fastest repeat of a task, and the cycle of the core at that time.
struct Fastest {
    double wall = std::numeric_limits<double>::infinity(), cpu = wall, cycle = wall;
    double all_wall = 0; ///< of all repeats

    template <class Task>
    void run(benchmark::State& state, const Task& task) {
        using Clock = std::chrono::steady_clock;
        for (auto _ : state) {
            const double cpu_start = cpu_ns();
            const auto start = Clock::now();
            task();
            const std::chrono::duration<double, std::nano> spent = Clock::now() - start;
            cpu = std::min(cpu, cpu_ns() - cpu_start);
            wall = std::min(wall, spent.count());
            all_wall += spent.count();
            state.PauseTiming();
            cycle = std::min(cycle, cycle_ns());
            state.ResumeTiming();
        }
    }

    void report(benchmark::State& state, double work) const {
        state.counters["wall_ms"] = wall * 1e-6;
        state.counters["cpu_ns/px/exp"] = cpu / work;
        state.counters["cycles/px/exp"] = cpu / work / cycle;
    }
};

// Arguments: width, height, exposures, threads (0: all), tests. Returns the seconds of all repeats.
double evaluate_pair(benchmark::State& state, const PicturePair& pair,
                     const kernels::FlipRows* functions) {
    const int width = pair.reference.width, height = pair.reference.height;
    const auto count = int(state.range(2)), threads = int(state.range(3));
    const auto tests = size_t(state.range(4));
    const flip::Evaluation what{flip::lane_taps(flip::make_taps(kPixelsPerDegree)),
                                *tonemap::rational_curve("aces"), exposures(count), functions};
    const size_t pixels = pair.reference.plane[0].size();
    std::vector<std::vector<float>> maps(2 * tests, std::vector<float>(pixels));
    std::vector<flip::Output> outputs;
    for (size_t t = 0; t < tests; ++t)
        outputs.push_back({maps[2 * t].data(), maps[2 * t + 1].data(), {}, width});
    Fastest fastest;
    fastest.run(state, [&] {
        flip::evaluate(what, pair.reference.view(), std::vector(tests, pair.test.view()),
                       {0, 0, width, height}, outputs, make_parallel(threads));
        benchmark::DoNotOptimize(maps[0].data());
    });
    fastest.report(state, double(pixels) * count);
    state.SetLabel(kernels::flip_rows().name);
    return fastest.all_wall * 1e-9;
}

void evaluate(benchmark::State& state) {
    evaluate_pair(state, make_pair(int(state.range(0)), int(state.range(1))), nullptr);
}

void evaluate_corner(benchmark::State& state) {
    evaluate_pair(state, make_corner_pair(int(state.range(0)), int(state.range(1))), nullptr);
}

void evaluate_stages(benchmark::State& state) {
    bench::StageClock clock(kernels::flip_rows());
    const double total = evaluate_pair(state, make_pair(int(state.range(0)), int(state.range(1))),
                                       &clock.functions());
    for (const auto& [name, share] : clock.shares(total))
        state.counters[name] = benchmark::Counter(share);
}

void evaluate_reference(benchmark::State& state) {
    const int width = int(state.range(0)), height = int(state.range(1));
    const auto count = int(state.range(2));
    const PicturePair pair = make_pair(width, height);
    const auto taps = flip::make_taps(kPixelsPerDegree);
    Fastest fastest;
    fastest.run(state, [&] {
        benchmark::DoNotOptimize(kernels::hdr_flip_reference(
            pair.reference.view(), pair.test.view(), taps, *tonemap::rational_curve("aces"),
            exposures(count), nullptr));
    });
    fastest.report(state, double(width) * height * count);
}

// Luminance of the reference, its maximum and median, from which the exposures follow.
void measure_exposures(benchmark::State& state) {
    const int width = int(state.range(0)), height = int(state.range(1));
    const auto threads = int(state.range(2));
    const PicturePair pair = make_pair(width, height);
    const auto parallel = make_parallel(threads);
    const float* rgb[3];
    for (size_t c = 0; c < 3; ++c)
        rgb[c] = pair.reference.plane[c].data();
    std::vector<float> luminance(pair.reference.plane[0].size());
    Fastest fastest;
    fastest.run(state, [&] {
        parallel(height, [&](int64_t y) {
            const int64_t at = y * width;
            metrics::luminance_row(rgb[0] + at, rgb[1] + at, rgb[2] + at, luminance.data() + at,
                                   width);
        });
        benchmark::DoNotOptimize(
            metrics::exposure_statistics(luminance.data(), width, height, parallel));
    });
    state.counters["wall_ms"] = fastest.wall * 1e-6;
}

enum ToneBy { kCurve, kTable };

kernels::LightCube make_table() {
    kernels::CubeShape shape;
    shape.size = 81;
    kernels::LightCube cube(shape);
    std::vector<float> row(3 * size_t(shape.size));
    for (int r = 0; r < shape.size; ++r)
        for (int g = 0; g < shape.size; ++g) {
            for (int b = 0; b < shape.size; ++b) {
                const double x[3] = {cube.level(r), cube.level(g), cube.level(b)};
                for (size_t c = 0; c < 3; ++c)
                    row[3 * size_t(b) + c] = float(x[c] / (x[c] + 0.9 * x[1] + 0.1));
            }
            cube.set_row(r, g, row.data());
        }
    return cube;
}

// The rows of one picture, smooth or with noise, by the ACES curve or by a view's table. Figures
// per pixel of one picture: HDR-FLIP shows two.
void tone_rows(benchmark::State& state) {
    const auto by = ToneBy(state.range(0));
    const int width = 1920, height = 1080;
    const PicturePair pair = make_pair(width, height);
    const Picture& picture = state.range(1) ? pair.test : pair.reference;
    const kernels::LightCube table = make_table();
    const kernels::ToneCurve curve = *tonemap::rational_curve("aces");
    std::vector<float> out[3];
    for (auto& plane : out)
        plane.resize(size_t(width));
    float* const to[3] = {out[0].data(), out[1].data(), out[2].data()};
    Fastest fastest;
    fastest.run(state, [&] {
        for (int y = 0; y < height; ++y) {
            const float* in[3];
            for (size_t c = 0; c < 3; ++c)
                in[c] = picture.plane[c].data() + size_t(y) * size_t(width);
            if (by == kTable)
                kernels::light_cube_rows(table, in, to, width, 0.5f);
            else
                kernels::tone_map_pixels(in, to, width, curve, 0.5f);
            benchmark::DoNotOptimize(out[0].data());
        }
    });
    fastest.report(state, double(width) * height);
    state.SetLabel(std::string(kernels::flip_rows().name) + (by == kTable ? " table" : " curve"));
}

// HDR-FLIP through the table of a view and by the ACES curve, one after the other: what the view
// costs on the same machine at the same time.
void evaluate_view(benchmark::State& state) {
    using Clock = std::chrono::steady_clock;
    const int width = int(state.range(0)), height = int(state.range(1));
    const auto count = int(state.range(2)), threads = int(state.range(3));
    DisplayLightOptions options;
    options.view.config = TONETOOL_BENCH_CONFIG;
    options.view.display = "sRGB";
    options.view.view = "ACES SDR";
    DisplayLight light;
    try {
        light.open(options);
    } catch (const std::exception& why) {
        state.SkipWithError(why.what());
        return;
    }
    const PicturePair pair = make_pair(width, height);
    flip::Evaluation curve{flip::lane_taps(flip::make_taps(kPixelsPerDegree)),
                           *tonemap::rational_curve("aces"), exposures(count)};
    flip::Evaluation view = curve;
    view.rows = light.baked();
    std::vector<float> map(pair.reference.plane[0].size());
    const std::vector<flip::Output> outputs = {{map.data(), nullptr, {}, width}};
    const auto run = [&](const flip::Evaluation& what) {
        const auto start = Clock::now();
        flip::evaluate(what, pair.reference.view(), {pair.test.view()}, {0, 0, width, height},
                       outputs, make_parallel(threads));
        return std::chrono::duration<double>(Clock::now() - start).count();
    };
    double of_curve = 1e9, of_view = 1e9;
    for ([[maybe_unused]] auto _ : state) {
        of_curve = std::min(of_curve, run(curve));
        of_view = std::min(of_view, run(view));
    }
    state.counters["curve_ms"] = of_curve * 1e3;
    state.counters["view_ms"] = of_view * 1e3;
    state.counters["times"] = of_view / of_curve;
    state.SetLabel(kernels::flip_rows().name);
}

constexpr int kAll = 0;

BENCHMARK(evaluate)
    ->ArgNames({"width", "height", "exposures", "threads", "tests"})
    ->Args({512, 512, 9, 1, 1})
    ->Args({1920, 1080, 9, 1, 1})
    ->Args({1920, 1080, 9, kAll, 1})
    ->Args({1920, 1080, 2, 1, 1})
    ->Args({1920, 1080, 18, 1, 1})
    ->Args({1920, 1080, 9, 1, 2})
    ->Args({1920, 1080, 9, 1, 4})
    ->Args({3840, 2160, 9, 1, 1})
    ->Args({3840, 2160, 9, kAll, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(evaluate_corner)
    ->ArgNames({"width", "height", "exposures", "threads", "tests"})
    ->Args({3840, 2160, 9, 1, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(evaluate_stages)
    ->ArgNames({"width", "height", "exposures", "threads", "tests"})
    ->Args({1920, 1080, 9, 1, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(evaluate_view)
    ->ArgNames({"width", "height", "exposures", "threads"})
    ->Args({1920, 1080, 9, 1})
    ->Args({1920, 1080, 9, kAll})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(tone_rows)
    ->ArgNames({"table", "noise"})
    ->Args({kCurve, 1})
    ->Args({kTable, 0})
    ->Args({kTable, 1})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(measure_exposures)
    ->ArgNames({"width", "height", "threads"})
    ->Args({1920, 1080, 1})
    ->Args({1920, 1080, kAll})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(evaluate_reference)
    ->ArgNames({"width", "height", "exposures"})
    ->Args({512, 512, 2})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

// The name of an instruction set as the option takes it: Highway's, in lower case.
std::string option_name(int64_t target) {
    std::string name = hwy::TargetName(target);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return name == "avx3" ? "avx512" : name;
}

bool choose_target(const std::string& name) {
    for (int64_t target : hwy::SupportedAndGeneratedTargets())
        if (name == option_name(target)) {
            hwy::SetSupportedTargetsForTest(target);
            hwy::GetChosenTarget().Update(target);
            return true;
        }
    std::fprintf(stderr, "tonetool_bench: --target=%s: not on this machine; valid:", name.c_str());
    for (int64_t target : hwy::SupportedAndGeneratedTargets())
        std::fprintf(stderr, " %s", option_name(target).c_str());
    std::fprintf(stderr, "\n");
    return false;
}

} // namespace

int main(int argc, char** argv) {
    const std::string option = "--target=";
    for (int i = 1; i < argc; ++i)
        if (std::string(argv[i]) == "--help")
            std::printf(
                "tonetool_bench [--target=NAME]: the instruction set, the best by default\n");
    benchmark::Initialize(&argc, argv);
    int rest = 1;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.compare(0, option.size(), option) != 0)
            argv[rest++] = argv[i];
        else if (!choose_target(word.substr(option.size())))
            return 1;
    }
    if (benchmark::ReportUnrecognizedArguments(rest, argv))
        return 1;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
