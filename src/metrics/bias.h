// SPDX-License-Identifier: BSD-3-Clause
// Noise or change? Whether two renders differ in their expected values ("bias"), or only by the
// noise of their samples ("variance"). HDR-FLIP sees noise as an eye does and cannot see behind it;
// this tests the signed differences of blocks of pixels, and the claim that there is none.
//
// Y, R, G and B are tested, Y = 0.2126 R + 0.7152 G + 0.0722 B of linear Rec.709, each as the mean
// over the seeds of a side. d is test - reference. Negative values stay: to clamp them is a bias.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernels/views.h"

namespace tonetool::metrics {

inline constexpr int kBiasChannels = 4;
inline constexpr const char* kBiasChannelNames[kBiasChannels] = {"Y", "R", "G", "B"};
inline constexpr int kBiasScales = 3;
inline constexpr int kBiasBlocks[kBiasScales] = {16, 32, 64}; ///< about the edge of a block

/// Never two: that nothing was found does not show that nothing is there.
enum class BiasVerdict {
    Different,       ///< beyond chance: the expected values differ
    Equal,           ///< shown by the data to be equal within the margin
    NotEnoughSamples ///< neither
};

/// Why the verdict is what it is.
enum class BiasReason {
    Evidence,          ///< Different: evidence() says what was found
    Identical,         ///< Equal: every pixel
    Rounding,          ///< Equal: no pixel differs by more than the rounding of half
    MeansWithin,       ///< Equal: with confidence, the means of the image and of each 64-block
    DifferencesWithin, ///< Equal: the mean absolute differences of each 64-block; not statistical
    TooSmall,          ///< NotEnoughSamples: fewer than 4096 pixels
    NonFinite,         ///< NotEnoughSamples: would be Equal if all pixels were finite
    Correlated,        ///< NotEnoughSamples: neighbours are correlated, more samples may not help
    Undecided          ///< NotEnoughSamples: `more` says how many times more are needed
};

/// What is known of the reference's noise. A path tracer's noise is skewed: of two sides with the
/// same noise it cancels, against a converged reference it looks like missing light.
enum class BiasNoise {
    Auto,     ///< judged from the images
    Alike,    ///< the same as the test's: same sampler, same samples per pixel
    Converged ///< much less than the test's
};

struct BiasOptions {
    double within = 0.05; ///< margin of the claim of equality, relative
    double alpha = 0.01;  ///< false alarms per image of Different; level of each claim in Equal
    double power = 0.9;   ///< the chance to show equality that `more` aims at
    BiasNoise reference = BiasNoise::Auto;
};

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

/// The overall difference of a channel, as a factor of the reference: T = (1 + gain) R.
struct BiasGain {
    double gain = 0, se = 0;          ///< weighted by what each place knows, and its standard error
    double z = 0, p = 1;              ///< its test
    double energy = 0, energy_se = 0; ///< not weighted: difference of the sums over that of R
    bool rejected = false;
};

/// Tests of the blocks of one scale, row by row.
struct BiasScale {
    struct Channel {
        std::vector<double> mean;      ///< of d
        std::vector<double> se;        ///< its standard error
        std::vector<double> t, p;      ///< Student's t; two-sided, 1 where not tested
        std::vector<double> level;     ///< absolute mean of the reference
        std::vector<uint8_t> tested;   ///< 0: too few effective pixels for unlike noise
        std::vector<uint8_t> rejected; ///< 1: differs
    };
    int block = 0;         ///< 16, 32 or 64
    std::vector<int> x, y; ///< edges: one more than columns and rows of blocks
    double t_alpha = 0;    ///< Student's quantile of a one-sided claim
    Channel channel[kBiasChannels];
    std::vector<double> structure_p; ///< of products of independent differences; empty: not run
    std::vector<uint8_t> structure_rejected;
    int64_t rejected = 0, structures = 0; ///< blocks with any channel rejected; with structure

    int columns() const { return int(x.size()) - 1; }
    int rows() const { return int(y.size()) - 1; }
    int64_t blocks() const { return int64_t(columns()) * rows(); }
};

struct BiasResult {
    BiasVerdict verdict = BiasVerdict::NotEnoughSamples;
    BiasReason reason = BiasReason::Undecided;
    BiasOptions options;
    int width = 0, height = 0, references = 0, tests = 0; ///< references, tests: seeds
    int64_t nonfinite = 0;                                ///< pixels that count as 0 on both sides

    /// False after a short cut (identical, rounding, too small): what follows, down to `scales`, is
    /// empty then.
    bool judged = false;
    double asymmetry = 0; ///< 0: noise alike; near 1: the reference has none; -1: the test has none
    int unlike = 0;       ///< 0, or the sign of the side with more noise: 1 is the test
    std::array<double, kBiasChannels>
        rare{};              ///< share of the light that unseen fireflies may carry
    double correlation = 0;  ///< of neighbours
    bool correlated = false; ///< denoised or filtered?
    double dark = 0;         ///< darker blocks are judged against this level
    std::array<BiasGain, kBiasChannels> gain;
    std::array<BiasScale, kBiasScales> scales;
    int64_t untested = 0, tested = 0; ///< block tests, over all scales and channels

    double bound = 0;          ///< the relative difference that the data exclude
    double absolute = 0;       ///< the largest mean absolute relative difference of a 64-block
    double shown = 0;          ///< part of the 64-blocks that are shown to be within the margin
    bool contradicted = false; ///< a block that differs is not shown to differ less than the margin
    std::optional<double>
        more; ///< how many times more samples would show equality; may be infinite
};

/// The images must have the same size and at least one seed each (else Refusal). Options out of
/// range are refused. The bits do not depend on how `parallel` schedules.
BiasResult bias_check(const BiasSide& reference, const BiasSide& test, const BiasOptions& options,
                      const kernels::ParallelFor& parallel);

/// What was found, as "overall R", "mean 16: 3 of 144", "structure 32: 1 of 40"; for Equal: what is
/// real and still within the margin.
std::vector<std::string> bias_evidence(const BiasResult& result);

enum class BiasMap {
    Signed, ///< relative difference, its half-width, confidence 1 - p; of the finest rejected block
            ///< and its channel of the smallest p, else of the 32-block in Y
    P,      ///< log10 of the smallest p over the channels of the 16-, 32- and 64-block, >= -300
    Rejected ///< how many scales rejected a mean (-1: none could be tested in Y); how many a
             ///< structure (-1: not run); 0
};

/// Three planes of a map, without padding.
std::array<std::vector<float>, 3> bias_map(const BiasResult& result, BiasMap map,
                                           const kernels::ParallelFor& parallel);

} // namespace tonetool::metrics
