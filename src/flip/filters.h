// SPDX-License-Identifier: BSD-3-Clause
// The filters of LDR-FLIP for a number of pixels per degree.
#pragma once

#include "kernels/flip_taps.h"

namespace tonetool::flip {

/// The pixels per degree that the filters are defined for. At the lower end a filter is a few
/// pixels wide and the feature detectors are plain differences; above the upper end pixels are far
/// too small to be seen.
inline constexpr double kMinPixelsPerDegree = 1.0;
inline constexpr double kMaxPixelsPerDegree = 1000.0;

/// Pixels per degree of a screen `width` metres and `pixels` wide, seen from `distance` metres.
double pixels_per_degree(double distance, double width, double pixels);

/// Contrast sensitivity filters and feature detectors, HPG 2020 section 4.1 and 4.2.
kernels::FlipTaps<double> make_taps(double pixels_per_degree);

/// The same in float, without the taps of the achromatic and red-green filters that lie below the
/// precision of float (two-sided tail < 2e-9 of the sum), and with the detectors on steps.
kernels::LaneTaps lane_taps(const kernels::FlipTaps<double>& taps);

/// The radius of the largest filter's support: the error of a pixel depends on this many pixels to
/// each side.
int filter_radius(const kernels::LaneTaps& taps);

} // namespace tonetool::flip
