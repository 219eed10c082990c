// SPDX-License-Identifier: BSD-3-Clause
#include "flip/filters.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace tonetool::flip {
namespace {

// Contrast sensitivity in the frequency domain as sums of Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b)
// (HPG 2020, Table 1); x in degrees.
constexpr double kYb = 0.0047, kCxB = 0.0053;
constexpr double kCzA1 = 34.1, kCzB1 = 0.04, kCzA2 = 13.5, kCzB2 = 0.025;

// Width of the detectors: 0.082 degrees, two standard deviations (HPG 2020, section 4.2).
constexpr double kFeatureWidth = 0.082;

constexpr double kTail = 2e-9;

using Taps = std::vector<double>;

Taps gaussian(double amplitude, double b, double ppd, int radius) {
    Taps taps;
    for (int i = 0; i <= radius; ++i)
        taps.push_back(amplitude * std::exp(-M_PI * M_PI * (i / ppd) * (i / ppd) / b));
    return taps;
}

double two_sided_sum(const Taps& taps) {
    return 2.0 * std::accumulate(taps.begin(), taps.end(), 0.0) - taps[0];
}

void scale(Taps& taps, double factor) {
    for (double& t : taps)
        t *= factor;
}

// Positive taps to sum to 1 and negative ones to -1, both sides of the filter counted.
void normalize_signs(Taps& taps, bool odd) {
    double positive = 0, negative = 0;
    for (size_t i = 0; i < taps.size(); ++i) {
        const double at_plus = taps[i], at_minus = i == 0 ? 0.0 : (odd ? -taps[i] : taps[i]);
        for (double t : {at_plus, at_minus})
            (t > 0 ? positive : negative) += std::abs(t);
    }
    for (double& t : taps)
        t /= t > 0 ? positive : negative;
}

void make_detectors(kernels::FlipTaps<double>& taps, double ppd) {
    const double sigma = 0.5 * kFeatureWidth * ppd;
    const int radius = int(std::ceil(3.0 * sigma));
    for (int i = 0; i <= radius; ++i) {
        const double g = std::exp(-(i * i) / (2.0 * sigma * sigma));
        taps.g.push_back(g);
        taps.d1.push_back(-i * g);
        taps.d2.push_back((i * i / (sigma * sigma) - 1.0) * g);
    }
    scale(taps.g, 1.0 / two_sided_sum(taps.g));
    normalize_signs(taps.d1, true);
    normalize_signs(taps.d2, false);
}

// Shortest list whose dropped tail is below 2e-9 of the sum, a thirtieth of what float resolves;
// the sums stay those of the full one.
std::vector<float> to_float(const Taps& taps, bool trim) {
    size_t n = taps.size();
    double tail = 0;
    while (trim && n > 1 && tail + 2.0 * taps[n - 1] < kTail)
        tail += 2.0 * taps[--n];
    return {taps.begin(), taps.begin() + std::ptrdiff_t(n)};
}

// Summation by parts: a step counts in every tap beyond it.
std::vector<float> on_steps(const Taps& taps) {
    std::vector<float> out(taps.size() - 1);
    double beyond = 0;
    for (size_t i = taps.size() - 1; i > 0; --i) {
        beyond += taps[i];
        out[i - 1] = float(beyond);
    }
    return out;
}

} // namespace

double pixels_per_degree(double distance, double width, double pixels) {
    return distance * (pixels / width) * (M_PI / 180.0);
}

kernels::FlipTaps<double> make_taps(double ppd) {
    kernels::FlipTaps<double> taps;
    const double widest = std::max({kYb, kCxB, kCzB1, kCzB2});
    const int radius = int(std::ceil(3.0 * std::sqrt(widest / (2.0 * M_PI * M_PI)) * ppd));
    taps.y = gaussian(1.0, kYb, ppd, radius);
    taps.cx = gaussian(1.0, kCxB, ppd, radius);
    scale(taps.y, 1.0 / two_sided_sum(taps.y));
    scale(taps.cx, 1.0 / two_sided_sum(taps.cx));
    // The amplitude is applied in both passes, hence its square root.
    taps.cz1 = gaussian(std::sqrt(kCzA1 * std::sqrt(M_PI / kCzB1)), kCzB1, ppd, radius);
    taps.cz2 = gaussian(std::sqrt(kCzA2 * std::sqrt(M_PI / kCzB2)), kCzB2, ppd, radius);
    const double norm = 1.0 / std::hypot(two_sided_sum(taps.cz1), two_sided_sum(taps.cz2));
    scale(taps.cz1, norm);
    scale(taps.cz2, norm);
    make_detectors(taps, ppd);
    return taps;
}

kernels::LaneTaps lane_taps(const kernels::FlipTaps<double>& taps) {
    kernels::LaneTaps out;
    out.y = to_float(taps.y, true);
    out.cx = to_float(taps.cx, true);
    out.cz1 = to_float(taps.cz1, false);
    out.cz2 = to_float(taps.cz2, false);
    out.g = to_float(taps.g, false);
    out.d1 = on_steps(taps.d1);
    out.d2 = on_steps(taps.d2);
    const size_t length = std::max({out.y.size(), out.cx.size(), size_t(2)});
    out.y.resize(length, 0.0f);
    out.cx.resize(length, 0.0f);
    // With few pixels per degree the detectors are shorter than the contrast sensitivity.
    out.g.resize(std::max(out.g.size(), length), 0.0f);
    return out;
}

int filter_radius(const kernels::LaneTaps& taps) {
    return int(std::max(
               {taps.y.size(), taps.cx.size(), taps.cz1.size(), taps.cz2.size(), taps.g.size()})) -
           1;
}

} // namespace tonetool::flip
