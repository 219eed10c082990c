// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/bias_gain.h"

#include <algorithm>
#include <cmath>

#include "metrics/distributions.h"

namespace tonetool::metrics::bias {
namespace {

// The weight of the pixels of one colour from those of the other in their block: the level over the
// variance, with a floor of 10 % of the level. Weights must not see the pixels they weigh: mean and
// variance of noise go together, and weights of the same pixels would favour what is too dark.
double weight_from(const ColourSums& other) {
    const double level = std::max(other.r / other.pixels, 0.0);
    const double floor = other.dd / other.pixels + (0.1 * level) * (0.1 * level);
    return floor > 0 ? level / floor : 0;
}

// Sums of (d - gain r)^2. Where d is nearly gain r they cancel, down to rounding.
double residuals(const ColourSums& sums, double gain) {
    return std::max(0.0, sums.dd - 2 * gain * sums.dr + gain * gain * sums.rr);
}

struct Weighted {
    ColourSums sums;
    double weight;
};

std::vector<Weighted> weighted_colours(const Sums& sums, int channel) {
    const Grid& grid = sums.cells.scale[0].grid;
    std::vector<Weighted> out;
    out.reserve(2 * grid.count());
    for (int row = 0; row < grid.rows(); ++row)
        for (int column = 0; column < grid.columns(); ++column) {
            const ChannelSums block = block_sums(sums, channel, 0, column, row);
            for (int colour = 0; colour < 2; ++colour)
                if (block.colour[0].pixels && block.colour[1].pixels)
                    out.push_back({block.colour[colour], weight_from(block.colour[1 - colour])});
        }
    return out;
}

// Ratio of the sums; its error from the residuals, whose sum is 0.
void energy_ratio(const Sums& sums, int channel, BiasGain& out) {
    ColourSums all;
    for (const ChannelSums& cell : sums.channel[channel])
        for (const ColourSums& colour : cell.colour)
            all.add(colour);
    if (all.r <= 0)
        return;
    const double n = all.pixels;
    out.energy = all.d / all.r;
    out.energy_se = std::sqrt(residuals(all, out.energy) * n / (n - 1)) / all.r;
}

} // namespace

BiasGain overall_gain(const Sums& sums, int channel, double inflate) {
    const std::vector<Weighted> colours = weighted_colours(sums, channel);
    double ud = 0, ur = 0, uudd = 0, left = 0;
    for (const Weighted& one : colours) {
        ud += one.weight * one.sums.d;
        ur += one.weight * one.sums.r;
        uudd += one.weight * one.weight * one.sums.dd;
    }
    BiasGain out;
    out.gain = ur > 0 ? ud / ur : 0;
    for (const Weighted& one : colours)
        left += one.weight * one.weight * residuals(one.sums, out.gain);
    const double widen = std::sqrt(inflate);
    out.se = ur > 0 ? std::sqrt(left) / ur * widen : 0;
    // Self-normalised by the differences themselves: safe whatever their tails (Efron, "Student's t
    // under symmetry conditions", 1969).
    const double beyond = std::max(0.0, std::abs(ud) - kRounding * std::max(ur, 0.0));
    out.z = uudd > 0 ? std::copysign(beyond / std::sqrt(uudd), ud) / widen : 0;
    out.p = 2 * normal_upper_tail(std::abs(out.z));
    energy_ratio(sums, channel, out);
    out.energy_se *= widen;
    return out;
}

} // namespace tonetool::metrics::bias
