// SPDX-License-Identifier: BSD-3-Clause
// The exposure of a photographer's camera: ISO 12232 (saturation-based speed), as S. Lagarde and C.
// de Rousiers, "Moving Frostbite to Physically Based Rendering" (2014), write it.
#pragma once

namespace tonetool::tonemap {

/// f-number N, time T in seconds, ISO speed S.
struct CameraSettings {
    double fnumber = 0, shutter = 0, iso = 0;
};

/// EV100 = log2(100 N^2 / (S T)).
double ev100(const CameraSettings& camera);

/// The luminance in cd/m2 that just saturates: H_sat = 78 / S lx s, and H = q L T / N^2.
double saturation_luminance(const CameraSettings& camera);

/// What a reflected-light meter (K = 12.5 cd s/m2) takes for the mean of the scene, as a share of
/// the luminance that saturates: 12.5 / 120.
inline constexpr double kMeanOfSaturation = 0.104;

} // namespace tonetool::tonemap
