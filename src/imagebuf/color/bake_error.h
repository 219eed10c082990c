// SPDX-License-Identifier: BSD-3-Clause
// How far a baked view is from OpenColorIO on the pixels that are looked at through it.
#pragma once

#include <cstdint>
#include <vector>

#include "imagebuf/color/view.h"
#include "imagebuf/pixels/planes.h"

namespace tonetool {

/// |table - OpenColorIO| in linear display light, per channel.
struct BakeError {
    double max = 0, sum = 0;
    int64_t samples = 0;
    double mean() const { return samples > 0 ? sum / double(samples) : 0; }
    void add(const BakeError& other);
};

/// Over the rows [begin, end) of an image at these exposures: evenly spaced pixels, at most 2^16 of
/// the whole image and all exposures, so that bands add up to the same figures as the whole.
BakeError measure_bake(const DisplayLight& light, const ColorPlanes& planes, int begin, int end,
                       const std::vector<double>& stops);

} // namespace tonetool
