// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/bias_equal.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "metrics/distributions.h"

namespace tonetool::metrics::bias {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Where so many pixels do not count that the others tell nothing by themselves, it is not.
bool is_judged(const Sums& sums, int scale, int column, int row) {
    const ChannelSums block = block_sums(sums, 0, scale, column, row);
    return block.judged(sums.cells.scale[scale].grid.pixels(column, row));
}

// Two one-sided tests (Schuirmann, 1987): |x| < within is shown if |x| + z_alpha se is. To claim it
// of all blocks and channels needs no correction for their number, since every one must show it
// (intersection-union, Berger, 1982).
class Claim {
public:
    Claim(const Sums& sums, BiasResult& result)
        : m_sums(sums),
          m_result(result),
          m_z_alpha(normal_quantile(1 - result.options.alpha)),
          m_z_both(m_z_alpha + normal_quantile(result.options.power)) {}

    void overall() {
        for (const BiasGain& gain : m_result.gain) {
            const double bound = std::abs(gain.energy) + m_z_alpha * gain.energy_se;
            m_result.bound = std::max(m_result.bound, bound);
            if (bound > within())
                need(gain.energy_se);
        }
    }

    // A block that is both rejected and not within the margin contradicts equality, at any scale.
    void contradictions() {
        for (const BiasScale& scale : m_result.scales)
            for (const auto& channel : scale.channel)
                for (size_t at = 0; at < channel.mean.size(); ++at)
                    if (channel.rejected[at] && bound_of(channel, at, scale.t_alpha) > within())
                        m_result.contradicted = true;
    }

    void blocks() {
        const BiasScale& scale = m_result.scales.back();
        int64_t shown = 0, judged = 0;
        for (int row = 0; row < scale.rows(); ++row)
            for (int column = 0; column < scale.columns(); ++column) {
                if (!is_judged(m_sums, kBiasScales - 1, column, row))
                    continue;
                ++judged;
                shown += block(scale, column, row);
            }
        m_result.shown = double(shown) / double(judged);
    }

private:
    double within() const { return m_result.options.within; }
    double base_of(const BiasScale::Channel& channel, size_t at) const {
        return std::max(channel.level[at], m_result.dark);
    }
    double bound_of(const BiasScale::Channel& channel, size_t at, double t_alpha) const {
        const double base = base_of(channel, at), mean = channel.mean[at], se = channel.se[at];
        if (base > 0)
            return (std::abs(mean) + t_alpha * se) / base;
        return mean == 0 && se == 0 ? 0 : kInfinity;
    }

    // The samples that bring a relative error so far below the margin that equality would be shown
    // with the power asked for, if there is no difference: variances go with their inverse.
    void need(double relative_se) {
        const double part = m_z_both * relative_se / within();
        m_result.more = std::max(m_result.more.value_or(1), part * part);
    }

    bool block(const BiasScale& scale, int column, int row) {
        bool shown = true;
        for (int c = 0; c < kBiasChannels; ++c) {
            const BiasScale::Channel& channel = scale.channel[c];
            const size_t at = m_sums.cells.scale[kBiasScales - 1].grid.at(column, row);
            const double bound = bound_of(channel, at, scale.t_alpha), base = base_of(channel, at);
            m_result.bound = std::max(m_result.bound, bound);
            if (bound > within()) {
                shown = false;
                need(base > 0 ? channel.se[at] / base : kInfinity);
            }
            const ChannelSums sums = block_sums(m_sums, c, kBiasScales - 1, column, row);
            m_result.absolute = std::max(
                m_result.absolute, base > 0 ? sums.absolute / sums.pixels() / base : kInfinity);
        }
        return shown;
    }

    const Sums& m_sums;
    BiasResult& m_result;
    const double m_z_alpha, m_z_both;
};

// That count, of a block that is judged; of a scale without any, two.
double fewest_pixels(const Sums& sums, int scale) {
    const Grid& grid = sums.cells.scale[scale].grid;
    double fewest = kInfinity;
    for (int row = 0; row < grid.rows(); ++row)
        for (int column = 0; column < grid.columns(); ++column)
            if (is_judged(sums, scale, column, row))
                fewest = std::min(fewest, block_sums(sums, 0, scale, column, row).pixels());
    return std::isfinite(fewest) ? fewest : 2;
}

} // namespace

bool any_judged(const Sums& sums) {
    constexpr int last = kBiasScales - 1;
    const Grid& grid = sums.cells.scale[last].grid;
    for (int row = 0; row < grid.rows(); ++row)
        for (int column = 0; column < grid.columns(); ++column)
            if (is_judged(sums, last, column, row))
                return true;
    return false;
}

void bound_differences(const Sums& sums, BiasResult& result) {
    for (int s = 0; s < kBiasScales; ++s)
        result.scales[size_t(s)].t_alpha =
            student_quantile(1 - result.options.alpha, fewest_pixels(sums, s) - 1);
    Claim claim(sums, result);
    claim.overall();
    claim.contradictions();
    claim.blocks();
    if (!result.more)
        result.more = 1;
}

} // namespace tonetool::metrics::bias
