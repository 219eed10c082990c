// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/gbuffer_precision.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <cstring>

namespace tonetool {
namespace {

constexpr double kHalf = 1.0 / 2048, kFloat = 1.0 / 16777216;
// A step between two rounded positions is off by up to two roundings: a fifth of it here.
constexpr double kMostBlur = 0.1;
// Medians are taken over about so many pixels.
constexpr double kSamples = 65536;

// Halves have 13 bits of a float's fraction unused, also the smallest ones.
bool fits_half(float value) {
    uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return (bits & 0x1fffu) == 0;
}

double largest(const GBuffer& g, size_t i) {
    return std::max({std::abs(double(g.position[0][i])), std::abs(double(g.position[1][i])),
                     std::abs(double(g.position[2][i]))});
}

// The distance to the nearer of the two neighbours that show a surface: a silhouette is on one side
// only. -1 without such a neighbour.
double step(const GBuffer& g, size_t i, size_t apart, bool before, bool after) {
    double nearest = -1;
    const auto look = [&](size_t j) {
        if (g.background[j])
            return;
        double sum = 0;
        for (const auto& p : g.position)
            sum += (double(p[i]) - double(p[j])) * (double(p[i]) - double(p[j]));
        nearest = nearest < 0 ? std::sqrt(sum) : std::min(nearest, std::sqrt(sum));
    };
    if (before)
        look(i - apart);
    if (after)
        look(i + apart);
    return nearest;
}

double footprint(const GBuffer& g, int x, int y) {
    const auto width = size_t(g.width);
    const size_t i = size_t(y) * width + size_t(x);
    const double across = step(g, i, 1, x > 0, x + 1 < g.width);
    const double down = step(g, i, width, y > 0, y + 1 < g.height);
    return across < 0 ? down : down < 0 ? across : std::sqrt(across * down);
}

double median(std::vector<double>& v) {
    const auto middle = v.begin() + ptrdiff_t(v.size() / 2);
    std::nth_element(v.begin(), middle, v.end());
    return *middle;
}

} // namespace

double rounding_of_positions(const GBuffer& g) {
    for (const auto& plane : g.position)
        for (float v : plane)
            if (std::isfinite(v) && !fits_half(v))
                return kFloat;
    return kHalf;
}

void measure_precision(GBuffer& g, const std::string& layer) {
    if (!g.has_position())
        return;
    const double relative = rounding_of_positions(g);
    double most = 0;
    for (size_t i = 0; i < g.background.size(); ++i)
        most = std::max(most, largest(g, i));
    g.half_ulp = relative * most;
    g.half_positions = relative == kHalf;
    const int apart = std::max(1, int(std::sqrt(double(g.width) * double(g.height) / kSamples)));
    std::vector<double> steps, blurs;
    for (int y = 0; y < g.height; y += apart)
        for (int x = 0; x < g.width; x += apart) {
            const size_t i = size_t(y) * size_t(g.width) + size_t(x);
            const double f = g.background[i] ? -1 : footprint(g, x, y);
            if (f < 0)
                continue;
            steps.push_back(f);
            blurs.push_back(f > 0 ? relative * largest(g, i) / f : HUGE_VAL);
        }
    if (steps.empty())
        return;
    g.footprint = median(steps);
    if (median(blurs) > kMostBlur)
        g.warnings.push_back(OIIO::Strutil::fmt::format(
            "position layer \"{}\" is as coarse as {}: rounded by up to {:g}, where pixels are "
            "{:g} "
            "apart",
            layer, relative == kHalf ? "half" : "float", g.half_ulp, g.footprint));
}

} // namespace tonetool
