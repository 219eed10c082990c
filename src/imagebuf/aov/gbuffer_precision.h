// SPDX-License-Identifier: BSD-3-Clause
// How exactly positions are stored, against how far apart they are.
#pragma once

#include <string>

#include "imagebuf/aov/gbuffer.h"

namespace tonetool {

/// Largest rounding of a position relative to its value: of half where all of them could be halves
/// (whatever type they are in now), else of float.
double rounding_of_positions(const GBuffer& g);

/// Sets `half_ulp` and `footprint`; warns where rounding blurs the steps between pixels.
void measure_precision(GBuffer& g, const std::string& layer);

} // namespace tonetool
