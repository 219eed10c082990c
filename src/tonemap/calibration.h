// SPDX-License-Identifier: BSD-3-Clause
// The exposure at which an image is shown: M. Pettineo, "A Closer Look at Tone Mapping" (2010), and
// G. Krawczyk, K. Myszkowski, H.-P. Seidel, "Perceptual Effects in Real-Time Tone Mapping" (2005).
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/views.h"

namespace tonetool::tonemap {

/// The lower limit of the mean and of key / mean, as in the article.
inline constexpr double kLeastMean = 1e-3, kLeastGain = 1e-4;

/// The key of an image of this geometric mean in cd/m2: 1.03 - 2 / (2 + log10(1 + mean)).
double auto_key(double mean);

/// key / mean with the limits above.
double gain(double key, double mean);

/// Geometric means exp(mean of ln(L + epsilon)) over 2^level x 2^level cells of a luminance plane,
/// which covers the cells exactly: a pixel on a border counts in both for its share. NaN is not
/// counted; a cell of nothing else has the mean of the whole. Sums are of rows, in their order.
class LocalMeans {
public:
    LocalMeans(const float* plane, int width, int height, int level, double epsilon,
               const kernels::ParallelFor& parallel);

    int64_t pixels() const { return m_pixels; } ///< that were counted
    double mean() const { return m_mean; }      ///< of the whole; 0 if nothing was counted

    /// The means at the pixels of a row, the logarithms of the cells interpolated bilinearly
    /// between their middles and held beyond the outer ones.
    void row(int y, double* out) const;

    /// The largest level whose cells are at least a pixel wide.
    static int most_levels(int width, int height);

private:
    struct Sum {
        double logs = 0, weight = 0;
    };
    void add_row(const float* row, double epsilon, Sum* cells) const;
    void add_up(const std::vector<Sum>& rows);

    int m_width, m_height, m_cells;
    int64_t m_pixels = 0;
    double m_mean = 0;
    std::vector<double> m_logs; ///< of the cells, row by row
};

} // namespace tonetool::tonemap
