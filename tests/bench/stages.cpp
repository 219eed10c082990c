// SPDX-License-Identifier: BSD-3-Clause
#include "stages.h"

#include <chrono>
#include <type_traits>

namespace tonetool::bench {
namespace {

using Clock = std::chrono::steady_clock;
using kernels::FlipRows;

enum Stage { kOpponent, kColumns, kHalo, kColors, kFeatures, kLab, kCompare, kStages };

constexpr const char* kNames[kStages] = {"tone+opponent", "columns", "halo",   "rows_colors",
                                         "rows_features", "lab",     "compare"};

// Function pointers carry no data.
const FlipRows* g_functions = nullptr;
double g_seconds[kStages];

// A function of the table with a clock around it.
template <auto Member, Stage S, class Function>
struct Timed;

template <auto Member, Stage S, class... Args>
struct Timed<Member, S, void (*)(Args...)> {
    static void call(Args... args) {
        const auto start = Clock::now();
        (g_functions->*Member)(static_cast<Args>(args)...);
        g_seconds[S] += std::chrono::duration<double>(Clock::now() - start).count();
    }
};

template <auto Member, Stage S>
void time_member(FlipRows& table) {
    using Function = std::remove_reference_t<decltype(table.*Member)>;
    table.*Member = Timed<Member, S, Function>::call;
}

} // namespace

StageClock::StageClock(const FlipRows& functions) : m_timed(functions) {
    g_functions = &functions;
    for (double& seconds : g_seconds)
        seconds = 0;
    time_member<&FlipRows::to_opponent, kOpponent>(m_timed);
    time_member<&FlipRows::filter_columns, kColumns>(m_timed);
    time_member<&FlipRows::fill_halo, kHalo>(m_timed);
    time_member<&FlipRows::filter_colors, kColors>(m_timed);
    time_member<&FlipRows::filter_features, kFeatures>(m_timed);
    time_member<&FlipRows::to_features, kLab>(m_timed);
    time_member<&FlipRows::compare_row, kCompare>(m_timed);
}

std::vector<std::pair<std::string, double>> StageClock::shares(double total) const {
    std::vector<std::pair<std::string, double>> out;
    double other = 1;
    for (int s = 0; s < kStages; ++s) {
        out.emplace_back(kNames[s], g_seconds[s] / total);
        other -= g_seconds[s] / total;
    }
    out.emplace_back("other", other);
    return out;
}

} // namespace tonetool::bench
