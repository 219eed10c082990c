// SPDX-License-Identifier: BSD-3-Clause
// Looking at all pixels of the guides.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "imagebuf/aov/gbuffer.h"
#include "kernels/views.h"

namespace tonetool::gbuffer {

using kernels::ParallelFor;

// Blender writes 1e10 where a ray hits nothing, Unreal and others more.
inline constexpr float kFar = 1e9f;

// What was counted in a row or in all rows; counts and extremes do not depend on the order.
struct Tally {
    int64_t count[6] = {};
    float low[3] = {FLT_MAX, FLT_MAX, FLT_MAX}, high[3] = {-FLT_MAX, -FLT_MAX, -FLT_MAX};

    void see(int c, float v) {
        low[c] = std::min(low[c], v);
        high[c] = std::max(high[c], v);
    }
    float lowest() const { return std::min({low[0], low[1], low[2]}); }
    float highest() const { return std::max({high[0], high[1], high[2]}); }
    void add(const Tally& o) {
        for (int i = 0; i < 6; ++i)
            count[i] += o.count[i];
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(low[c], o.low[c]);
            high[c] = std::max(high[c], o.high[c]);
        }
    }
};

// Runs look(i, tally) for every pixel.
template <class Look>
Tally over_pixels(const GBuffer& g, const ParallelFor& parallel, const Look& look) {
    std::vector<Tally> rows(size_t(g.height));
    parallel(g.height, [&](int64_t y) {
        const size_t begin = size_t(y) * size_t(g.width);
        for (size_t i = begin; i < begin + size_t(g.width); ++i)
            look(i, rows[size_t(y)]);
    });
    Tally all;
    for (const Tally& row : rows)
        all.add(row);
    return all;
}

using Vectors = std::vector<float>[3];

inline bool is_finite(const Vectors& v, size_t i) {
    return std::isfinite(v[0][i]) && std::isfinite(v[1][i]) && std::isfinite(v[2][i]);
}
inline bool is_zero(const Vectors& v, size_t i) {
    return v[0][i] == 0 && v[1][i] == 0 && v[2][i] == 0;
}
inline double length(const Vectors& v, size_t i, double scale = 1, double offset = 0) {
    double sum = 0;
    for (const auto& p : v)
        sum += (scale * double(p[i]) + offset) * (scale * double(p[i]) + offset);
    return std::sqrt(sum);
}

/// Whether the depth says that a ray hit nothing.
inline bool is_far(const GBuffer& g, size_t i) {
    return g.has_depth() && std::abs(g.depth[i]) >= kFar;
}

} // namespace tonetool::gbuffer
