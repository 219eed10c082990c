// SPDX-License-Identifier: BSD-3-Clause
// How close float lanes must come to the double-precision reference implementation, and what they
// are compared on.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "kernels/flip_taps.h"
#include "kernels/tone_curve.h"
#include "tonemap/rational.h"

namespace tonetool::kernels {

// E ~ h^0.7 has infinite slope at 0: float noise in Lab becomes up to 1e-4 there.
inline constexpr double kSmallError = 0.01, kClose = 1e-5, kCloseBelow = 1e-4;
// Two instruction sets, each within kClose of the reference implementation.
inline constexpr double kAmongTargets = 2e-5;

/// What tests are repeated for.
struct Case {
    const char* curve;
    double ppd;
};

inline std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.curve << " at " << c.ppd;
}

inline std::string name_of(const testing::TestParamInfo<Case>& info) {
    return std::string(info.param.curve) + "_" + std::to_string(std::lround(info.param.ppd));
}

inline ToneCurve curve_of(const std::string& name) {
    return name == "ldr" ? ToneCurve{} : *tonemap::rational_curve(name);
}

/// The exact taps, each rounded to float: what a plain float program works with.
inline FlipTaps<float> rounded(const FlipTaps<double>& taps) {
    const auto round = [](const std::vector<double>& list) {
        std::vector<float> out;
        for (double tap : list)
            out.push_back(float(tap));
        return out;
    };
    return {round(taps.y), round(taps.cx), round(taps.cz1), round(taps.cz2),
            round(taps.g), round(taps.d1), round(taps.d2)};
}

/// One failure for a map, at its worst pixel.
template <typename T>
void expect_close(const std::vector<float>& ours, const std::vector<T>& expected, double close,
                  double close_below, const char* what) {
    ASSERT_EQ(ours.size(), expected.size());
    const auto share_of_bound = [&](size_t i) {
        return std::abs(double(ours[i]) - double(expected[i])) /
               (double(expected[i]) >= kSmallError ? close : close_below);
    };
    size_t worst = 0;
    for (size_t i = 1; i < ours.size(); ++i)
        if (!(share_of_bound(i) <= share_of_bound(worst)))
            worst = i;
    EXPECT_LE(share_of_bound(worst), 1.0) << what << ": pixel " << worst << " is " << ours[worst]
                                          << " instead of " << expected[worst];
}

} // namespace tonetool::kernels
