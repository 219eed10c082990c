// SPDX-License-Identifier: BSD-3-Clause
// What bias_check() and noise_floor() find: plain numbers, no images.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tonetool {

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

/// What may be known of the reference's noise: nothing, it is judged from the images; the same as
/// the test's (same sampler, same samples per pixel); much less than the test's. A path tracer's
/// noise is skewed: of two sides with the same noise it cancels, against a converged reference it
/// looks like missing light.
inline constexpr const char* kBiasNoises[] = {"auto", "alike", "converged"};

/// What is tested, and how strictly.
struct BiasTest {
    double within = 0.05; ///< margin of the claim of equality, relative
    double alpha = 0.01;  ///< false alarms per image of Different; level of each claim in Equal
    double power = 0.9;   ///< the chance to show equality that `more` aims at
    std::string reference = kBiasNoises[0];
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
    BiasTest options;
    int x = 0, y = 0;                                     ///< of the first pixel
    int width = 0, height = 0, references = 0, tests = 0; ///< references, tests: seeds
    int64_t nonfinite = 0;                                ///< pixels that count as 0 on both sides
    int64_t ignored = 0;                                  ///< pixels that do not count at all

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

enum class NoiseFloorMethod {
    OrderStatistic, ///< one of the values; nothing is assumed of their distribution
    Lognormal,      ///< exp(mean + k sd) of the logarithms
    Normal          ///< mean + k sd, where a value is 0 or less
};

struct NoiseFloorOptions {
    double content = 0.99;    ///< the part of future unbiased renders that must lie below
    double confidence = 0.95; ///< that it is at least this part
    bool below_one = false;   ///< the quantity is never above 1: a limit of 1 could not be exceeded
};

struct NoiseFloor {
    double limit = 0;
    NoiseFloorMethod method = NoiseFloorMethod::Lognormal;
    int64_t values = 0, needed = 0; ///< from `needed` values on the method is OrderStatistic
    int64_t rank = 0;               ///< OrderStatistic: which of the ascending values, from 1
    double k = 0;                   ///< the others: the tolerance factor
    std::optional<size_t> outlier;  ///< the largest value, where the others make it implausible
};

} // namespace tonetool
