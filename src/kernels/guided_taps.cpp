// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "kernels/guided.h"

namespace tonetool::kernels {

TapSets::TapSets(const std::vector<std::vector<Offset>>& sets, double sigma, RunOrigin origin)
    : m_sigma(sigma),
      m_origin(origin) {
    const double log2_of_step = -1 / (2 * sigma * sigma * std::log(2.0));
    for (const auto& set : sets) {
        std::vector<Tap>& taps = m_sets.emplace_back();
        for (const Offset& o : set) {
            const double gaussian = log2_of_step * (o.dx * o.dx + o.dy * o.dy);
            taps.push_back({o.dx, o.dy, float(gaussian - std::log2(o.density))});
            m_half = std::max({m_half, std::abs(o.dx), std::abs(o.dy)});
        }
        // Row by row: neighbours share lines of memory.
        std::stable_sort(taps.begin(), taps.end(), [](const Tap& a, const Tap& b) {
            return a.dy != b.dy ? a.dy < b.dy : a.dx < b.dx;
        });
    }
}

namespace {

// Rounds of a multiplicative hash, of which the upper bits are the good ones.
size_t hashed(uint32_t h, size_t below) {
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return size_t(h >> 16) % below;
}

} // namespace

int TapSets::origin(int y) const {
    return m_origin == RunOrigin::Hashed ? int(hashed(uint32_t(y) * 0xc2b2ae35u + 1, kGuidedRun))
                                         : 0;
}

size_t TapSets::choice(int x, int y) const {
    if (m_sets.size() == 1)
        return 0;
    const auto run = uint32_t((x + origin(y)) / kGuidedRun);
    return hashed(run * 0x9e3779b1u + uint32_t(y) * 0x85ebca6bu, m_sets.size());
}

std::vector<Offset> whole_window(int half) {
    std::vector<Offset> out;
    for (int dy = -half; dy <= half; ++dy)
        for (int dx = -half; dx <= half; ++dx)
            out.push_back({dx, dy});
    return out;
}

} // namespace tonetool::kernels
