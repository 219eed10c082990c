// SPDX-License-Identifier: BSD-3-Clause
// Two layers of data that should be the same: depths, positions, normals, motion, ids, alpha.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "metrics/detail_scan.h"

namespace tonetool::metrics {

/// What is compared, of pixels of interleaved channels.
enum class PairKind {
    Depth,    ///< the first channel says where it is; beyond kSky, or not finite, nothing is there
    Position, ///< each pixel's differences are held against its depth
    Normal,   ///< the first three channels
    Motion,   ///< pairs of channels, in pixels
    Ids,      ///< pairs of an id, by its bits, and its coverage; or one id
    Alpha,
    Data ///< any values, by their bits
};

/// Sums over rows; in rows of their order, so that threads do not matter.
struct DataPair {
    static constexpr float kSky = 1e9f;

    int64_t pixels = 0;
    int64_t off = 0;  ///< pixels that differ, by the measure of the kind
    int64_t both = 0; ///< of normals: pixels where both have a length
    int64_t one = 0;  ///< and where only one has
    double sum = 0;   ///< of differences: of ids by half their coverage, of alpha absolute
    int64_t lost = 0; ///< of normals and motion: pixels that are finite in the approved alone
    double covered[2] = {0, 0};               ///< of ids: the coverage of each side
    StepHistogram steps;                      ///< of angles in degrees, of distances in pixels
    std::vector<StepHistogram::Code> codes{}; ///< of one row, before it is added
    double most = 0;                          ///< the largest difference, and where it is
    int64_t x = 0, y = 0;

    void add(const DataPair& row);
    /// Of ids: the part of what the layer covers that are others.
    double others() const {
        const double whole = std::max(covered[0], covered[1]);
        return whole > 0 ? std::min(sum / whole, 1.0) : 0;
    }
    double share(int64_t count) const { return pixels > 0 ? double(count) / double(pixels) : 0; }
};

/// Of two vectors, in degrees.
double angle_between(const float* a, const float* b);

/// One row. `depth`: of a position the depth of the approved pixels, or null.
DataPair scan_pair(PairKind kind, const std::vector<float>& a, const std::vector<float>& b,
                   size_t channels, const float* depth, int64_t y);

} // namespace tonetool::metrics
