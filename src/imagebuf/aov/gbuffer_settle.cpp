// SPDX-License-Identifier: BSD-3-Clause
// The last word on every pixel of the guides.
#include <algorithm>

#include "imagebuf/aov/gbuffer_check.h"
#include "imagebuf/aov/gbuffer_pixels.h"
#include "imagebuf/aov/gbuffer_precision.h"

namespace tonetool {
namespace {

using namespace gbuffer;

// A vector as short as this points nowhere.
constexpr double kNoNormal = 1e-3;

bool shows_sky(const GBuffer& g, size_t i) {
    if (is_far(g, i) ||
        (g.has_normal() && is_finite(g.normal, i) && length(g.normal, i) < kNoNormal))
        return true;
    // Zero is no distance; the origin of the world is a place, but one that few pixels hit exactly,
    // and sky there would be taken for a neighbour of all that is near.
    if (g.has_depth() && (g.depth[i] < 0 || (g.depth[i] == 0 && !g.has_normal())))
        return true;
    if (!g.has_position())
        return false;
    return (!g.has_depth() && is_zero(g.position, i)) ||
           (is_finite(g.position, i) && length(g.position, i) >= kFar);
}

bool has_nonfinite(const GBuffer& g, size_t i) {
    return (g.has_depth() && !std::isfinite(g.depth[i])) ||
           (g.has_normal() && !is_finite(g.normal, i)) ||
           (g.has_position() && !is_finite(g.position, i)) ||
           (g.has_albedo() && !is_finite(g.albedo, i));
}

// The last word on one pixel.
void settle(GBuffer& g, size_t i, Tally& t) {
    enum { Surface, Nonfinite };
    bool none = g.background[i] || shows_sky(g, i);
    if (!none && has_nonfinite(g, i)) {
        ++t.count[Nonfinite];
        none = true;
    }
    g.background[i] = none;
    t.count[Surface] += !none;
    const double l = none || !g.has_normal() ? 1 : length(g.normal, i);
    for (int c = 0; c < 3; ++c) {
        if (g.has_position() && none)
            g.position[c][i] = 0;
        if (g.has_normal())
            g.normal[c][i] = none ? 0 : float(double(g.normal[c][i]) / l);
        // What exceeds 1 is a filter's overshoot or an emitter. Clamped, both still differ from
        // what is dark beside them, and by no more than a white wall does.
        if (g.has_albedo())
            g.albedo[c][i] = none ? 0 : std::clamp(g.albedo[c][i], 0.0f, 1.0f);
    }
    if (g.has_depth() && none)
        g.depth[i] = 0;
}

} // namespace

void settle_pixels(GBuffer& g, const std::string& position, const ParallelFor& parallel) {
    const bool any = g.has_position() || g.has_normal() || g.has_albedo() || g.has_depth();
    const Tally t = over_pixels(g, parallel, [&](size_t i, Tally& row) { settle(g, i, row); });
    g.nonfinite = t.count[1];
    if (g.nonfinite > 0)
        g.warnings.push_back(std::to_string(g.nonfinite) +
                             " pixel(s) are taken for background: a guide is not finite there");
    if (any && t.count[0] == 0)
        g.warnings.push_back("no pixel shows a surface");
    measure_precision(g, position);
}

} // namespace tonetool
