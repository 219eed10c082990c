// SPDX-License-Identifier: BSD-3-Clause
// Tone curves as plain numbers: exposed scene light in, display light out.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

namespace tonetool::kernels {

class CurveTable;

/// Weights of luminance (ITU-R BT.709).
inline constexpr std::array<double, 3> kLuminance = {0.2126, 0.7152, 0.0722};

/// The formulas. tonemap/curves_*.cpp makes the numbers of each curve and says what they are;
/// curve_reference.cpp is the plainest use of them.
enum class CurveKind {
    Rational,    ///< (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5)
    Logarithmic, ///< log(1 + x) / log(1 + white)
    Exponential, ///< 1 - exp(-x / white)
    Drago,       ///< adaptive logarithm (Drago et al. 2003)
    FilmicAlu,   ///< Hejl and Burgess-Dawson, decoded from its gamma of 2.2
    AcesHill,    ///< matrix, rational, matrix
    Lottes,      ///< x^a / (b x^(a d) + c)
    Uchimura,    ///< toe, straight line, shoulder
    Agx,         ///< matrix, polynomial on log2, matrix, decoded from 2.2
    Neutral,     ///< Khronos PBR neutral
    Film,        ///< 10^-(D - dmin), D a logistic function of log x, by channel
    Table,       ///< straight lines between the rows of a table, by channel
};

/// These curves mix the channels of a pixel, so they cannot be run on luminance alone.
constexpr bool mixes_channels(CurveKind kind) {
    return kind == CurveKind::AcesHill || kind == CurveKind::Agx || kind == CurveKind::Neutral;
}

/// These curves may be other ones for R, G and B.
constexpr bool has_channels(CurveKind kind) {
    return kind == CurveKind::Film || kind == CurveKind::Table;
}

/// One curve with its parameters folded in.
struct CurveNumbers {
    CurveKind kind = CurveKind::Rational;
    std::array<double, 12> p{0, 1, 0, 0, 0, 1};
    std::shared_ptr<const CurveTable> table = nullptr; ///< of CurveKind::Table
};

/// How a curve is applied to a pixel.
struct CurveUse {
    bool on_luminance = false; ///< T(L) (C/L)^saturation instead of T(C); not where channels mix
    std::array<double, 3> weights = kLuminance; ///< of luminance
    double saturation = 1;
    bool clamp = true; ///< the result to [0,1]
};

} // namespace tonetool::kernels
