// SPDX-License-Identifier: BSD-3-Clause
// Whether guides hold what their names say, and which pixels show no surface.
#pragma once

#include "imagebuf/aov/gbuffer.h"
#include "kernels/views.h"

namespace tonetool {

/// On return the guides are as GBuffer promises. Before, they are as stored, `background` is 1
/// outside the data window.
void check_gbuffer(GBuffer& g, const GBufferNames& names, const kernels::ParallelFor& parallel);

/// Its second half: marks the background, cleans the guides that are left. `position` is the name
/// of the layer, for a warning.
void settle_pixels(GBuffer& g, const std::string& position, const kernels::ParallelFor& parallel);

} // namespace tonetool
