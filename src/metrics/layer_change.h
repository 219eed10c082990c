// SPDX-License-Identifier: BSD-3-Clause
// What has moved, by two layers of depths, positions, normals or numbers of objects.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "metrics/data_pair.h"

namespace tonetool::metrics {

/// Pixels of a whole picture, interleaved.
struct LayerPixels {
    const std::vector<float>* values[2] = {nullptr, nullptr}; ///< of reference and test
    size_t channels = 1;
};

/// Which pixels show a surface, by the depths of both images.
struct Surfaces {
    std::vector<uint8_t> in[2]; ///< empty: all do
    bool shown(size_t side, size_t pixel) const { return in[side].empty() || in[side][pixel] != 0; }
};
Surfaces surfaces_of(const LayerPixels& depth);

struct LayerChange {
    double mean = 0, max = 0;       ///< of the differences of pixels with a surface in both
    int64_t background_changed = 0; ///< pixels with one in only one image
    std::vector<uint8_t> changed;   ///< pixels that differ by more than the limit of the kind
};

/// Depth: relative to the reference's, limit 1e-2. Position: distance in parts of the diagonal of
/// the box around what both show, limit 1e-3. Normal: degrees where both are longer than 0.9,
/// limit 10. Ids: 1 where bits differ. Pixels with a surface in only one image have changed, too.
LayerChange layer_change(PairKind kind, const LayerPixels& pixels, const Surfaces& surfaces);

} // namespace tonetool::metrics
