// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/bias_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "metrics/bias_gain.h"
#include "metrics/distributions.h"

namespace tonetool::metrics::bias {
namespace {

// Fewer pixels that matter than this cannot say that a long tail is missing.
constexpr double kEffective = 80;
// Of products, for the normal distribution to hold.
constexpr int kProducts = 32;

double sign(double value) {
    return double(value > 0) - double(value < 0);
}

// Hall's transformation of a t whose variable is skewed ("On the removal of skewness by
// transformation", 1992), only ever towards 0.
double without_skewness(double t, const ChannelSums& sums) {
    const double n = sums.pixels(), root = std::sqrt(n);
    const double g = sums.m2 > 0 ? (sums.m3 / n) / std::pow(sums.m2 / n, 1.5) : 0;
    const double w = t / root;
    const double hall = root * (w + g * w * w / 3 + g * g * w * w * w / 27 + g / (6 * n));
    return sign(t) * std::max(0.0, std::min(std::abs(t), sign(t) * hall));
}

// Of powers of d: how many pixels make the sum of squares.
double effective_pixels(const ChannelSums& sums) {
    return sums.m4 > 0 ? sums.m2 * sums.m2 / sums.m4 : sums.pixels();
}

struct MeanTest {
    double mean, se, t, p, level;
    bool tested;
};

// Student's t of the part of the mean that neither rounding nor fireflies which this block has not
// seen explain. A block that is not judged by itself has none.
MeanTest mean_test(const ChannelSums& sums, const Noise& noise, int channel, bool judged) {
    const double n = sums.pixels();
    MeanTest out{};
    if (!judged) {
        out.p = 1;
        return out;
    }
    out.mean = sums.mean;
    out.level = std::abs(sums.sum_r() / n);
    out.se = std::sqrt(noise.inflate * sums.m2 / (n - 1) / n);
    const double rare = out.mean * noise.unlike < 0 ? noise.rare[size_t(channel)] : 0;
    const double beyond =
        sign(out.mean) * std::max(0.0, std::abs(out.mean) - (kRounding + rare) * out.level);
    if (out.se > 0)
        out.t = beyond / out.se;
    else
        out.t = beyond == 0 ? 0 : std::copysign(std::numeric_limits<double>::infinity(), beyond);
    out.tested = true;
    if (noise.unlike) {
        if (std::isfinite(out.t))
            out.t = without_skewness(out.t, sums);
        out.tested = out.t * noise.unlike >= 0 || effective_pixels(sums) >= kEffective;
    }
    out.p = out.tested ? 2 * student_upper_tail(std::abs(out.t), n - 1) : 1;
    return out;
}

MeanTest mean_of_block(const Sums& sums, const Noise& noise, int channel, int scale, int column,
                       int row) {
    const ChannelSums block = block_sums(sums, channel, scale, column, row);
    const bool judged = block.judged(sums.cells.scale[scale].grid.pixels(column, row));
    return mean_test(block, noise, channel, judged);
}

void resize(BiasScale::Channel& channel, size_t count) {
    for (auto* values : {&channel.mean, &channel.se, &channel.t, &channel.p, &channel.level})
        values->resize(count);
    channel.tested.resize(count);
    channel.rejected.resize(count);
}

void store(const MeanTest& test, BiasScale::Channel& out, size_t at) {
    out.mean[at] = test.mean;
    out.se[at] = test.se;
    out.t[at] = test.t;
    out.p[at] = test.p;
    out.level[at] = test.level;
    out.tested[at] = test.tested;
}

void reject_means(BiasScale& out, double q) {
    std::vector<const std::vector<double>*> all;
    for (const auto& channel : out.channel)
        all.push_back(&channel.p);
    const double limit = largest_rejected(all, q);
    for (size_t at = 0; at < size_t(out.blocks()); ++at) {
        bool any = false;
        for (auto& channel : out.channel) {
            channel.rejected[at] = channel.p[at] <= limit;
            any = any || channel.rejected[at];
        }
        out.rejected += any;
    }
}

// A darker block that unseen fireflies explain is not tested for structure.
bool excused(const Noise& noise, const BiasScale::Channel& luminance, size_t at) {
    const double mean = luminance.mean[at];
    return mean * noise.unlike < 0 && std::abs(mean) <= noise.rare[0] * luminance.level[at];
}

} // namespace

// No p above q is rejected: only the others are sorted.
double largest_rejected(const std::vector<const std::vector<double>*>& p, double q) {
    std::vector<double> small;
    double count = 0;
    for (const auto* values : p) {
        count += double(values->size());
        std::copy_if(values->begin(), values->end(), std::back_inserter(small),
                     [q](double one) { return one <= q; });
    }
    std::sort(small.begin(), small.end());
    for (size_t k = small.size(); k-- > 0;)
        if (small[k] <= q * double(k + 1) / count)
            return small[k];
    return -1;
}

BiasScale mean_tests(const Sums& sums, int scale, const Noise& noise, double q,
                     const kernels::ParallelFor& parallel) {
    const Grid& grid = sums.cells.scale[scale].grid;
    BiasScale out;
    out.block = kBiasBlocks[scale];
    out.x = grid.x;
    out.y = grid.y;
    for (auto& channel : out.channel)
        resize(channel, grid.count());
    parallel(grid.rows(), [&](int64_t row) {
        for (int c = 0; c < kBiasChannels; ++c)
            for (int column = 0; column < grid.columns(); ++column)
                store(mean_of_block(sums, noise, c, scale, column, int(row)), out.channel[c],
                      grid.at(column, int(row)));
    });
    reject_means(out, q);
    return out;
}

// A mean cannot see an edge that moved. The product of two independent noisy differences has the
// mean (change)^2, which is at least 0.
void structure_tests(const Sums& sums, int scale, const Noise& noise, double q, BiasScale& out) {
    const Grid& grid = sums.cells.scale[scale].grid;
    out.structure_p.resize(grid.count());
    out.structure_rejected.resize(grid.count());
    for (int row = 0; row < grid.rows(); ++row)
        for (int column = 0; column < grid.columns(); ++column) {
            const ProductSums x = block_products(sums, scale, column, row);
            const double z = x.squares > 0 ? x.sum / std::sqrt(x.squares) : 0;
            const size_t at = grid.at(column, row);
            const bool tested = x.used >= kProducts && !excused(noise, out.channel[0], at);
            out.structure_p[at] = tested ? normal_upper_tail(z) : 1;
        }
    const double limit = largest_rejected({&out.structure_p}, q);
    for (size_t at = 0; at < out.structure_p.size(); ++at) {
        out.structure_rejected[at] = out.structure_p[at] <= limit;
        out.structures += out.structure_rejected[at];
    }
}

} // namespace tonetool::metrics::bias
