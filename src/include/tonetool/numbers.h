// SPDX-License-Identifier: BSD-3-Clause
// The results of measurements: plain numbers, no images.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

namespace tonetool {

/// Pooled values of an error map. Sums are in double and in a fixed order.
struct FlipPool {
    double mean = 0;
    /// Values below which 25, 50, 75 % of the error mass (the sum of the map) lies.
    double weighted_q1 = 0, weighted_median = 0, weighted_q3 = 0;
    /// Nearest-rank percentiles of the pixels.
    double p50 = 0, p95 = 0, p99 = 0, p999 = 0;
    double min = 0, max = 0;
    int min_x = 0, min_y = 0, max_x = 0, max_y = 0; ///< the first one in scanline order
    /// 100 equal buckets over [0, 1]; the last one holds 1 as well.
    std::array<int64_t, 100> histogram{};
    int64_t pixels = 0;
    /// The quantities that PairOptions::quantities asked for, by name: "p99.95", "above0.2".
    std::map<std::string, double> further;
};

/// Luminance 0.2126 R + 0.7152 G + 0.0722 B of linear Rec.709, negative components set to 0,
/// over the finite pixels of the data window.
struct LuminanceStats {
    int64_t pixels = 0;    ///< in the data window (or the ROI)
    int64_t nonfinite = 0; ///< with NaN or Inf in R, G or B: not in any figure below
    int64_t negative = 0;  ///< finite, with a negative R, G or B
    int64_t black = 0;     ///< luminance exactly 0
    double min = 0, max = 0, mean = 0;
    double median = 0;      ///< element of rank n/2 (the upper median), as HDR-FLIP takes it
    double median_lit = 0;  ///< the same over luminance > 0
    double log_average = 0; ///< geometric mean over luminance > 0
    double p1 = 0, p99 = 0, p999 = 0; ///< nearest-rank percentiles
    std::string layer, space;
};

/// Tone-mapped image quality index, each figure 0 to 1 (the structure of a scale can fall below 0),
/// higher is better.
struct TmqiScore {
    double q = 0;                   ///< 0.8012 s^0.3046 + 0.1988 n^0.7088
    double s = 0;                   ///< structural fidelity
    double n = 0;                   ///< statistical naturalness
    std::array<double, 5> scales{}; ///< fidelity at each scale, the finest first
    double mean = 0, deviation = 0; ///< of the tone-mapped image, 0 to 255; n follows from them
};

} // namespace tonetool
