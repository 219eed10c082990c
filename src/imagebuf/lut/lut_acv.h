// SPDX-License-Identifier: BSD-3-Clause
// Curves of Photoshop, .acv. Only lut*.cpp include this.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "imagebuf/lut/lut_source.h"

namespace tonetool {

/// Input and output of a curve's points, 0 to 255, the inputs rising.
using AcvPoints = std::vector<std::pair<int, int>>;
/// A curve at each code value.
using AcvCodes = std::array<double, 256>;

/// The composite curve and those of R, G and B, as a file.
std::string acv_bytes(const AcvPoints& composite, const std::array<AcvPoints, 3>& channels);
/// What Photoshop draws: the natural cubic spline through the points, from 0 to 255.
AcvCodes acv_spline(const AcvPoints& points);
/// At most 16 points whose spline is close to the codes.
AcvPoints acv_points(const AcvCodes& codes);

/// The file's bytes; the summary is filled. Refuses what is no curve.
std::string make_acv(const LutOptions& options, const LutSource& source, LutSummary& summary);

} // namespace tonetool
