// SPDX-License-Identifier: BSD-3-Clause
// Constants of LDR-FLIP (HPG 2020), with the equations they belong to.
#pragma once

namespace tonetool::kernels {

/// Linear Rec.709 to CIE XYZ (D65), the published integer ratios.
inline constexpr double kRgbToXyz[3][3] = {
    {10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}};

/// Its inverse.
inline constexpr double kXyzToRgb[3][3] = {
    {3.241003232976358, -1.537398969488785, -0.498615881996363},
    {-0.969224252202516, 1.875929983695176, 0.041554226340085},
    {0.055639419851975, -0.204011206123910, 1.057148977187533}};

/// XYZ of white, R = G = B = 1: the row sums of kRgbToXyz.
inline constexpr double kWhite[3] = {kRgbToXyz[0][0] + kRgbToXyz[0][1] + kRgbToXyz[0][2],
                                     kRgbToXyz[1][0] + kRgbToXyz[1][1] + kRgbToXyz[1][2],
                                     kRgbToXyz[2][0] + kRgbToXyz[2][1] + kRgbToXyz[2][2]};

/// CIELAB: the linear part ends at (6/29)^3, its slope is 1 / (3 (6/29)^2), its offset 4/29.
inline constexpr double kLabKnee = (6.0 / 29.0) * (6.0 / 29.0) * (6.0 / 29.0);
inline constexpr double kLabSlope = 841.0 / 108.0;
inline constexpr double kLabOffset = 4.0 / 29.0;

/// Colour metric: q = HyAB^0.7, remapped so that kKneeShare of the largest q lands on kKneeError.
inline constexpr double kColorExponent = 0.7;
inline constexpr double kKneeShare = 0.4;
inline constexpr double kKneeError = 0.95;
/// HyAB of Hunt-adjusted pure green against pure blue; largest q is this to the power 0.7.
inline constexpr double kLargestHyab = 203.30165461087745;
inline constexpr double kLargestQ = 41.276098414595438;

} // namespace tonetool::kernels
