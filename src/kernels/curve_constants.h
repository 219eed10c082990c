// SPDX-License-Identifier: BSD-3-Clause
// Constants of the tone curves that mix channels: there are too many for CurveNumbers, and no
// option changes them.
#pragma once

#include <array>

namespace tonetool::kernels {

using Matrix3 = double[3][3];

/// S. Hill's fit of the ACES output transform for sRGB: to its rendering primaries, and back.
inline constexpr Matrix3 kAcesHillIn = {
    {0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777}};
inline constexpr Matrix3 kAcesHillOut = {
    {1.60475, -0.53108, -0.07367}, {-0.10208, 1.10813, -0.00605}, {-0.00327, -0.07276, 1.07602}};

/// AgX as B. Wrensch approximated it for Rec.709: inset and outset, rows here (published by
/// columns), the range of log2, a polynomial from x^0 up, and the display's exponent.
inline constexpr Matrix3 kAgxIn = {{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                                   {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                                   {0.0423756549057051, 0.0784336, 0.879142973793104}};
inline constexpr Matrix3 kAgxOut = {{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                                    {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                                    {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}};
inline constexpr double kAgxLowest = -12.47393, kAgxHighest = 4.026069;
inline constexpr std::array<double, 7> kAgxSigmoid = {-0.00232, 0.1191, 0.4298, -6.868,
                                                      31.96,    -40.14, 15.5};

/// Exponent of the display that published formulas encode for.
inline constexpr double kDisplayGamma = 2.2;

/// Khronos PBR neutral: where compression starts, how fast it desaturates; below kNeutralToe the
/// smallest channel loses x - 6.25 x^2, above it 0.04 (the Fresnel reflection of a dielectric).
inline constexpr double kNeutralFresnel = 0.04, kNeutralStart = 0.8 - kNeutralFresnel;
inline constexpr double kNeutralDesaturation = 0.15, kNeutralToe = 0.08, kNeutralSquare = 6.25;

/// Luminance below the smallest normal float counts as 0: a ratio to it would be noise.
inline constexpr float kSmallestLuminance = 1.17549435e-38f;

} // namespace tonetool::kernels
