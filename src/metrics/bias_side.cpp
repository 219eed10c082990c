// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/curve.h"
#include "metrics/bias.h"
#include "metrics/blocks.h"
#include "metrics/refusal.h"

namespace tonetool::metrics {
namespace {

using kernels::kLuminance;

double luminance_of(double r, double g, double b) {
    return kLuminance[0] * r + kLuminance[1] * g + kLuminance[2] * b;
}

} // namespace

BiasSide::BiasSide(const kernels::ConstRgb& only)
    : m_only(only),
      m_width(only.width),
      m_height(only.height),
      m_seeds(1) {}

BiasSide::BiasSide(int width, int height) : m_width(width), m_height(height) {
    for (auto& sum : m_sum)
        sum.resize(size_t(width) * size_t(height));
    for (auto& half : m_half)
        half.resize(size_t(width) * size_t(height));
}

void BiasSide::add(const kernels::ConstRgb& seed, const kernels::ParallelFor& parallel) {
    if (m_only.plane[0])
        throw Refusal("a side of one image takes no further seed");
    if (seed.width != m_width || seed.height != m_height)
        throw Refusal("the seeds of a side have different sizes: " + std::to_string(m_width) + "x" +
                      std::to_string(m_height) + ", " + std::to_string(seed.width) + "x" +
                      std::to_string(seed.height));
    std::vector<double>& half = m_half[m_seeds % 2];
    for_each_block(m_width, m_height, parallel, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            const ptrdiff_t from = y * seed.stride;
            const size_t to = size_t(y) * size_t(m_width);
            for (int c = 0; c < 3; ++c)
                for (int x = 0; x < m_width; ++x)
                    m_sum[c][to + size_t(x)] += double(seed.plane[c][from + x]);
            for (int x = 0; x < m_width; ++x)
                half[to + size_t(x)] +=
                    luminance_of(double(seed.plane[0][from + x]), double(seed.plane[1][from + x]),
                                 double(seed.plane[2][from + x]));
        }
    });
    ++m_seeds;
}

void BiasSide::row(int channel, int y, int x, int count, double* out) const {
    if (m_only.plane[0]) {
        const float* from = m_only.plane[channel] + y * m_only.stride + x;
        for (int i = 0; i < count; ++i)
            out[i] = double(from[i]);
        return;
    }
    const double seeds = m_seeds;
    const double* from = m_sum[channel].data() + size_t(y) * size_t(m_width) + size_t(x);
    for (int i = 0; i < count; ++i)
        out[i] = from[i] / seeds;
}

void BiasSide::half_row(int half, int y, double* out) const {
    const double seeds = (m_seeds + 1 - half) / 2; // NOLINT: whole seeds
    const double* from = m_half[half].data() + size_t(y) * size_t(m_width);
    for (int x = 0; x < m_width; ++x)
        out[x] = from[x] / seeds;
}

} // namespace tonetool::metrics
