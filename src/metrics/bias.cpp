// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/bias.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "metrics/bias_blocks.h"
#include "metrics/bias_equal.h"
#include "metrics/bias_gain.h"
#include "metrics/bias_noise.h"
#include "metrics/refusal.h"

namespace tonetool::metrics {
namespace {

using namespace bias;
using kernels::ParallelFor;

constexpr int64_t kFewestPixels = 4096; // of an image that is judged
constexpr double kUnlike = 0.25;        // |asymmetry| above this: unlike noise
constexpr double kCorrelated = 0.15;    // correlation of neighbours above this: not independent
constexpr double kDark = 0.02;          // of the reference's mean luminance: the least level
// Parts of alpha: the overall gain, the means and the structures of the blocks.
constexpr double kOverallPart = 1.0 / 5, kMeansPart = 3.0 / 5, kStructurePart = 1.0 / 5;

void require(bool valid, const char* name, double value, const char* what) {
    if (!valid)
        throw Refusal(std::string(name) + " is " + std::to_string(value) + ", must be " + what);
}

void check(const BiasSide& reference, const BiasSide& test, const BiasTest& options) {
    if (reference.seeds() < 1 || test.seeds() < 1)
        throw Refusal("a side has no image");
    if (reference.width() != test.width() || reference.height() != test.height())
        throw Refusal("the sides have different sizes: " + std::to_string(reference.width()) + "x" +
                      std::to_string(reference.height()) + ", " + std::to_string(test.width()) +
                      "x" + std::to_string(test.height()));
    require(options.within > 0 && std::isfinite(options.within), "within", options.within,
            "above 0");
    require(options.alpha > 0 && options.alpha < 0.5, "alpha", options.alpha,
            "above 0 and below 0.5");
    require(options.power >= 0.5 && options.power < 1, "power", options.power,
            "at least 0.5 and below 1");
    if (std::find(std::begin(kBiasNoises), std::end(kBiasNoises), options.reference) ==
        std::end(kBiasNoises))
        throw Refusal("reference is \"" + options.reference +
                      "\", must be auto, alike or converged");
}

bool all_identical(const Sums& sums) {
    const auto same = [](const ChannelSums& cell) { return cell.absolute == 0; };
    return std::all_of(std::begin(sums.channel), std::end(sums.channel), [&](const auto& cells) {
        return std::all_of(cells.begin(), cells.end(), same);
    });
}

// No pixel differs by more than a unit in the last place of half; in the dark, of the level there.
class RoundingRows {
public:
    RoundingRows(const Pixels& pixels, double dark)
        : m_pixels(pixels),
          m_dark(dark),
          m_values(6 * size_t(pixels.width())),
          m_luminance(2 * size_t(pixels.width())) {}

    bool holds(int y) {
        const int width = m_pixels.width();
        const auto rows = [&](int first) { return m_values.data() + ptrdiff_t(first) * width; };
        double* const r[3] = {rows(0), rows(1), rows(2)};
        double* const t[3] = {rows(3), rows(4), rows(5)};
        m_pixels.row(y, 0, width, r, t);
        luminance_row(r, width, m_luminance.data());
        luminance_row(t, width, m_luminance.data() + width);
        return within(m_luminance.data(), m_luminance.data() + width) && within(r[0], t[0]) &&
               within(r[1], t[1]) && within(r[2], t[2]);
    }

private:
    bool within(const double* r, const double* t) const {
        for (int x = 0; x < m_pixels.width(); ++x)
            if (!(std::abs(t[x] - r[x]) <= 2 * kRounding * std::max(std::abs(r[x]), m_dark)))
                return false;
        return true;
    }

    const Pixels& m_pixels;
    const double m_dark;
    std::vector<double> m_values, m_luminance;
};

bool only_rounding(const Pixels& pixels, double dark, const ParallelFor& parallel) {
    std::atomic<bool> holds{true};
    constexpr int64_t together = 16;
    parallel((pixels.height() + together - 1) / together, [&](int64_t block) {
        if (!holds)
            return;
        RoundingRows rows(pixels, dark);
        const auto end = std::min<int64_t>(pixels.height(), (block + 1) * together);
        for (int64_t y = block * together; y < end && holds; ++y)
            if (!rows.holds(int(y)))
                holds = false;
    });
    return holds;
}

// Equal by every pixel, unless some could not be compared.
void shown_by_pixels(BiasReason reason, double bound, BiasResult& out) {
    const bool all = out.nonfinite == 0;
    out.verdict = all ? BiasVerdict::Equal : BiasVerdict::NotEnoughSamples;
    out.reason = all ? reason : BiasReason::NonFinite;
    out.bound = bound;
    out.shown = 1;
}

int unlike_of(const BiasTest& options, double asymmetry) {
    if (options.reference != kBiasNoises[0])
        return options.reference == kBiasNoises[2] ? 1 : 0;
    if (std::abs(asymmetry) <= kUnlike)
        return 0;
    return asymmetry > 0 ? 1 : -1;
}

Noise find_noise(Pixels& pixels, Sums& sums, const ParallelFor& parallel, BiasResult& out) {
    out.asymmetry = asymmetry(sums);
    out.unlike = unlike_of(out.options, out.asymmetry);
    out.correlation = neighbour_correlation(pixels, sums, parallel);
    out.correlated = out.correlation > kCorrelated;
    Noise noise;
    noise.unlike = out.unlike;
    if (out.unlike) {
        sum_tails(pixels, out.unlike, sums, parallel);
        out.rare = noise.rare = firefly_shares(sums, out.unlike);
    }
    if (out.correlated) { // of a first-order autoregression along both axes
        const double ratio = (1 + out.correlation) / std::max(1 - out.correlation, 0.02);
        noise.inflate = ratio * ratio;
    }
    return noise;
}

void test_all(const Sums& sums, const Noise& noise, const ParallelFor& parallel, BiasResult& out) {
    const double alpha = out.options.alpha;
    for (int c = 0; c < kBiasChannels; ++c) {
        BiasGain& gain = out.gain[size_t(c)];
        gain = overall_gain(sums, c, noise.inflate);
        gain.rejected = gain.p <= kOverallPart * alpha / kBiasChannels;
    }
    for (int s = 0; s < kBiasScales; ++s) {
        BiasScale& scale = out.scales[size_t(s)];
        scale = mean_tests(sums, s, noise, kMeansPart * alpha / kBiasScales, parallel);
        for (const auto& channel : scale.channel) {
            out.tested += int64_t(channel.tested.size());
            out.untested += std::count(channel.tested.begin(), channel.tested.end(), 0);
        }
        if (!out.correlated)
            structure_tests(sums, s, noise, kStructurePart * alpha / kBiasScales, scale);
    }
}

bool any_structure(const BiasResult& result) {
    return std::any_of(result.scales.begin(), result.scales.end(),
                       [](const BiasScale& scale) { return scale.structures > 0; });
}

void decide(BiasResult& out) {
    const double within = out.options.within;
    const bool means = out.bound <= within && !out.correlated && !any_structure(out);
    const bool equal = (means || out.absolute <= within) && !out.contradicted;
    const bool more_would_help = out.bound > within && !out.correlated;
    if (equal && out.nonfinite == 0) {
        out.verdict = BiasVerdict::Equal;
        out.reason = means ? BiasReason::MeansWithin : BiasReason::DifferencesWithin;
        out.more.reset();
    } else if (!equal && !bias_evidence(out).empty()) {
        out.verdict = BiasVerdict::Different;
        out.reason = BiasReason::Evidence;
        out.more.reset();
    } else {
        out.verdict = BiasVerdict::NotEnoughSamples;
        out.reason = equal            ? BiasReason::NonFinite
                     : out.correlated ? BiasReason::Correlated
                                      : BiasReason::Undecided;
        if (!more_would_help)
            out.more.reset();
    }
}

} // namespace

BiasResult bias_check(const BiasSide& reference, const BiasSide& test, const BiasTest& options,
                      const ParallelFor& parallel, const uint8_t* ignored) {
    check(reference, test, options);
    BiasResult out;
    out.options = options;
    out.width = reference.width();
    out.height = reference.height();
    out.references = reference.seeds();
    out.tests = test.seeds();
    Pixels pixels(reference, test, ignored);
    const int64_t count = pixels.counted();
    out.ignored = int64_t(out.width) * out.height - count;
    Sums sums = sum_pixels(pixels, parallel);
    out.nonfinite = pixels.nonfinite();
    if (count < kFewestPixels || !any_judged(sums)) {
        out.reason = BiasReason::TooSmall;
        return out;
    }
    if (all_identical(sums)) {
        shown_by_pixels(BiasReason::Identical, 0, out);
        return out;
    }
    double luminance = 0;
    for (const ChannelSums& cell : sums.channel[0])
        luminance += cell.sum_r();
    out.dark = kDark * std::max(luminance / double(count), 0.0);
    if (only_rounding(pixels, out.dark, parallel)) {
        shown_by_pixels(BiasReason::Rounding, 2 * kRounding, out);
        return out;
    }
    out.judged = true;
    const Noise noise = find_noise(pixels, sums, parallel, out);
    test_all(sums, noise, parallel, out);
    bound_differences(sums, out);
    decide(out);
    return out;
}

std::vector<std::string> bias_evidence(const BiasResult& result) {
    std::vector<std::string> out;
    for (size_t c = 0; c < kBiasChannels; ++c)
        if (result.gain[c].rejected)
            out.push_back(std::string("overall ") + kBiasChannelNames[c]);
    const auto blocks = [&](const char* what, const BiasScale& scale, int64_t rejected) {
        if (rejected)
            out.push_back(what + std::to_string(scale.block) + ": " + std::to_string(rejected) +
                          " of " + std::to_string(scale.blocks()));
    };
    for (const BiasScale& scale : result.scales)
        blocks("mean ", scale, scale.rejected);
    for (const BiasScale& scale : result.scales)
        blocks("structure ", scale, scale.structures);
    return out;
}

} // namespace tonetool::metrics
