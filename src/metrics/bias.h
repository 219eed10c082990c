// SPDX-License-Identifier: BSD-3-Clause
// Noise or change? Whether two renders differ in their expected values ("bias"), or only by the
// noise of their samples ("variance"). HDR-FLIP sees noise as an eye does and cannot see behind it;
// this tests the signed differences of blocks of pixels, and the claim that there is none.
//
// Y, R, G and B are tested, Y = 0.2126 R + 0.7152 G + 0.0722 B of linear Rec.709, each as the mean
// over the seeds of a side. d is test - reference. Negative values stay: to clamp them is a bias.
#pragma once

#include <string>
#include <vector>

#include "kernels/views.h"
#include "tonetool/bias_numbers.h"

namespace tonetool::metrics {

/// One side of a comparison: one image, or seeds of one render, of which only sums are kept. A
/// file's half buffers are two seeds.
class BiasSide {
public:
    /// One image of linear Rec.709, which must outlive this.
    explicit BiasSide(const kernels::ConstRgb& only);

    /// Several images, which need not outlive add(). The memory does not grow with their number.
    BiasSide(int width, int height);
    void add(const kernels::ConstRgb& seed, const kernels::ParallelFor& parallel);

    int width() const { return m_width; }
    int height() const { return m_height; }
    int seeds() const { return m_seeds; }

    /// Mean over the seeds of pixels x ... x + count - 1 of channel 0 to 2 of a row. Not finite
    /// where a seed is not.
    void row(int channel, int y, int x, int count, double* out) const;

    /// Luminance of row y, as the mean over seeds 1, 3, 5, ... (half 0) or 2, 4, ... (half 1) of
    /// two or more.
    void half_row(int half, int y, double* out) const;
    bool has_halves() const { return m_seeds > 1; }

private:
    kernels::ConstRgb m_only;
    int m_width = 0, m_height = 0, m_seeds = 0;
    std::vector<double> m_sum[3], m_half[2]; // of all seeds; luminance of every second one
};

/// Of a block in which a mean is rejected, the channel of the smallest p (Y, if it is as small as
/// any); null of others.
const BiasScale::Channel* rejected_channel(const BiasScale& scale, size_t at);

enum class BiasMap {
    Signed, ///< relative difference, its half-width, confidence 1 - p; of the finest rejected block
            ///< and its rejected_channel(), else of the 32-block in Y
    P,      ///< log10 of the smallest p over the channels of the 16-, 32- and 64-block, >= -300
    Rejected ///< how many scales rejected a mean (-1: none could be tested in Y); how many a
             ///< structure (-1: not run)
};

/// The images must have the same size and at least one seed each (else Refusal). Options out of
/// range are refused. The bits do not depend on how `parallel` schedules. `ignored`: 1 for each
/// pixel, row by row, that does not count, which must be 0 on both sides; null: all count. A block
/// with too few pixels that count is not judged by itself.
BiasResult bias_check(const BiasSide& reference, const BiasSide& test, const BiasTest& options,
                      const kernels::ParallelFor& parallel, const uint8_t* ignored = nullptr);

/// What was found, as "overall R", "mean 16: 3 of 144", "structure 32: 1 of 40"; for Equal: what is
/// real and still within the margin.
std::vector<std::string> bias_evidence(const BiasResult& result);

/// Values for each pixel: Rejected has two, the others three.
constexpr int bias_map_channels(BiasMap map) {
    return map == BiasMap::Rejected ? 2 : 3;
}

/// Writes those of the pixels in scanline order, from `out` on; pixels are `step` floats apart.
void bias_map(const BiasResult& result, BiasMap map, float* out, int step,
              const kernels::ParallelFor& parallel);

} // namespace tonetool::metrics
