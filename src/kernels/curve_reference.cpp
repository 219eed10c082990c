// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/curve_reference.h"

#include <algorithm>
#include <cmath>

#include "kernels/curve_constants.h"
#include "kernels/curve_table.h"
#include "kernels/tone_curve.h"

namespace tonetool::kernels {
namespace {

using Color = std::array<double, 3>;
using P = std::array<double, 12>;

// HDR-FLIP paper, Eq. 1.
double rational(const P& k, double x) {
    return (k[0] * x * x + k[1] * x + k[2]) / (k[3] * x * x + k[4] * x + k[5]);
}

// p: white.
double logarithmic(const P& p, double x) {
    return std::log1p(x) / std::log1p(p[0]);
}

// p: white.
double exponential(const P& p, double x) {
    return -std::expm1(-x / p[0]);
}

// Drago et al. 2003, Eq. 4, for a display whose white is 1. p: white, bias. Above white the formula
// can fall, towards log 10 / (log(1 + white) bias exponent): for bias 0.7 where white exceeds 268.
// It was meant for values up to white; those above count as white.
double drago(const P& p, double x) {
    x = std::min(x, p[0]);
    const double bias = std::pow(x / p[0], std::log(p[1]) / std::log(0.5));
    return std::log1p(x) / (std::log10(1 + p[0]) * std::log(2 + 8 * bias));
}

// p: black, then y (p1 y + p2) / (y (p1 y + p3) + p4).
double filmic_alu(const P& p, double x) {
    const double y = std::max(0.0, x - p[0]);
    return std::pow(y * (p[1] * y + p[2]) / (y * (p[1] * y + p[3]) + p[4]), kDisplayGamma);
}

// p: contrast a, shoulder d, b, c.
double lottes(const P& p, double x) {
    return std::pow(x, p[0]) / (p[2] * std::pow(x, p[0] * p[1]) + p[3]);
}

// p: P, a, m, l, c, b.
double uchimura(const P& p, double x) {
    const double peak = p[0], a = p[1], m = p[2], c = p[4], b = p[5];
    const double l0 = (peak - m) * p[3] / a, s0 = m + l0, s1 = m + a * l0;
    if (x >= s0)
        return peak - (peak - s1) * std::exp(-(a * peak / (peak - s1)) * (x - s0) / peak);
    const double u = std::clamp(x / m, 0.0, 1.0), toe = 1 - u * u * (3 - 2 * u);
    return (m * std::pow(x / m, c) + b) * toe + (m + a * (x - m)) * (1 - toe);
}

// p: middle, gamma, dmin, dmax of R, of G, of B. Slope -gamma of D over log10 x at the middle.
double film(const P& p, size_t channel, double x) {
    const double middle = p[4 * channel], gamma = p[4 * channel + 1];
    const double range = p[4 * channel + 3] - p[4 * channel + 2];
    const double density = range / (1 + std::pow(x / middle, 4 * gamma / (range * std::log(10.0))));
    return std::pow(10.0, -density);
}

double of_channel(const CurveNumbers& curve, size_t channel, double x) {
    return curve.kind == CurveKind::Table ? curve.table->at(channel, x) : film(curve.p, channel, x);
}

Color multiply(const Matrix3& m, const Color& v) {
    Color out{};
    for (size_t i = 0; i < 3; ++i)
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

Color aces_hill(const P& k, Color v) {
    v = multiply(kAcesHillIn, v);
    for (double& x : v)
        x = rational(k, x);
    return multiply(kAcesHillOut, v);
}

Color agx(Color v) {
    v = multiply(kAgxIn, v);
    for (double& x : v) {
        const double stops = std::clamp(std::log2(x), kAgxLowest, kAgxHighest);
        const double share = (stops - kAgxLowest) / (kAgxHighest - kAgxLowest);
        x = 0;
        for (size_t i = kAgxSigmoid.size(); i-- > 0;)
            x = x * share + kAgxSigmoid[i];
    }
    v = multiply(kAgxOut, v);
    for (double& x : v)
        x = std::pow(std::max(x, 0.0), kDisplayGamma);
    return v;
}

Color neutral(Color v) {
    const double low = std::min({v[0], v[1], v[2]});
    const double offset = low < kNeutralToe ? low - kNeutralSquare * low * low : kNeutralFresnel;
    for (double& x : v)
        x -= offset;
    const double peak = std::max({v[0], v[1], v[2]});
    if (peak < kNeutralStart)
        return v;
    const double room = 1 - kNeutralStart;
    const double pressed = 1 - room * room / (peak + room - kNeutralStart);
    const double grey = 1 - 1 / (kNeutralDesaturation * (peak - pressed) + 1);
    for (double& x : v)
        x = x * (pressed / peak) * (1 - grey) + pressed * grey;
    return v;
}

Color mixed(const CurveNumbers& curve, const Color& v) {
    switch (curve.kind) {
    case CurveKind::AcesHill:
        return aces_hill(curve.p, v);
    case CurveKind::Agx:
        return agx(v);
    case CurveKind::Neutral:
        return neutral(v);
    default: // of one channel
        return v;
    }
}

double luminance(const std::array<double, 3>& weights, const Color& v) {
    return weights[0] * v[0] + weights[1] * v[1] + weights[2] * v[2];
}

Color on_luminance(const CurveNumbers& curve, const CurveUse& use, Color v) {
    const double lum = luminance(use.weights, v);
    if (lum < double(kSmallestLuminance))
        return {};
    const double y = curve_reference(curve, 0, lum);
    for (double& x : v)
        x = y * std::pow(x / lum, use.saturation);
    return v;
}

} // namespace

double curve_reference(const CurveNumbers& curve, double x) {
    switch (curve.kind) {
    case CurveKind::Rational:
        return rational(curve.p, x);
    case CurveKind::Logarithmic:
        return logarithmic(curve.p, x);
    case CurveKind::Exponential:
        return exponential(curve.p, x);
    case CurveKind::Drago:
        return drago(curve.p, x);
    case CurveKind::FilmicAlu:
        return filmic_alu(curve.p, x);
    case CurveKind::Lottes:
        return lottes(curve.p, x);
    case CurveKind::Uchimura:
        return uchimura(curve.p, x);
    case CurveKind::Film:
    case CurveKind::Table:
        return (of_channel(curve, 0, x) + of_channel(curve, 1, x) + of_channel(curve, 2, x)) / 3;
    default:
        return luminance(kLuminance, mixed(curve, {x, x, x}));
    }
}

double curve_reference(const CurveNumbers& curve, size_t channel, double x) {
    return has_channels(curve.kind) ? of_channel(curve, channel, x) : curve_reference(curve, x);
}

std::array<double, 3> curve_reference(const CurveNumbers& curve, const CurveUse& use,
                                      const std::array<double, 3>& rgb) {
    Color v = rgb;
    for (double& x : v)
        x = std::min(x, double(kLargestExposed));
    if (mixes_channels(curve.kind))
        v = mixed(curve, v);
    else if (use.on_luminance)
        v = on_luminance(curve, use, v);
    else
        for (size_t c = 0; c < 3; ++c)
            v[c] = curve_reference(curve, c, v[c]);
    if (use.clamp)
        for (double& x : v)
            x = std::clamp(x, 0.0, 1.0);
    return v;
}

} // namespace tonetool::kernels
