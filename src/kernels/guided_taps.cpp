// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "kernels/guided.h"

namespace tonetool::kernels {

TapSets::TapSets(const std::vector<std::vector<Offset>>& sets, double sigma) : m_sigma(sigma) {
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

// Rounds of a multiplicative hash, of which the upper bits are the good ones.
size_t TapSets::choice(int x, int y) const {
    if (m_sets.size() == 1)
        return 0;
    uint32_t h = uint32_t(x / kGuidedRun) * 0x9e3779b1u + uint32_t(y) * 0x85ebca6bu;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return size_t(h >> 16) % m_sets.size();
}

std::vector<Offset> whole_window(int half) {
    std::vector<Offset> out;
    for (int dy = -half; dy <= half; ++dy)
        for (int dx = -half; dx <= half; ++dx)
            out.push_back({dx, dy});
    return out;
}

} // namespace tonetool::kernels
