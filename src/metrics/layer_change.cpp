// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/layer_change.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace tonetool::metrics {
namespace {

class Change {
public:
    Change(PairKind kind, const LayerPixels& pixels, const Surfaces& surfaces)
        : m_kind(kind),
          m_pixels(pixels),
          m_surfaces(surfaces) {}

    LayerChange run() {
        const size_t count = m_pixels.values[0]->size() / m_pixels.channels;
        m_diagonal = m_kind == PairKind::Position ? diagonal(count) : 1;
        LayerChange change;
        change.changed.resize(count);
        double sum = 0;
        int64_t both = 0;
        for (size_t p = 0; p < count; ++p) {
            const bool a = m_surfaces.shown(0, p), b = m_surfaces.shown(1, p);
            const double difference = a && b ? difference_of(p) : 0;
            change.changed[p] = a != b || !(difference <= limit());
            change.background_changed += a != b;
            if (std::isfinite(difference)) {
                sum += difference;
                change.max = std::max(change.max, difference);
            }
            both += a && b;
        }
        change.mean = both > 0 ? sum / double(both) : 0;
        return change;
    }

private:
    const float* pixel(size_t side, size_t p) const {
        return m_pixels.values[side]->data() + p * m_pixels.channels;
    }

    double limit() const {
        switch (m_kind) {
        case PairKind::Depth:
            return 1e-2;
        case PairKind::Position:
            return 1e-3;
        case PairKind::Normal:
            return 10;
        default:
            return 0;
        }
    }

    double difference_of(size_t p) const {
        const float *a = pixel(0, p), *b = pixel(1, p);
        if (std::memcmp(a, b, m_pixels.channels * sizeof(float)) == 0)
            return 0;
        if (m_kind == PairKind::Ids)
            return 1;
        if (m_kind == PairKind::Normal)
            return length(a) > kUnit && length(b) > kUnit ? angle_between(a, b) : 0;
        constexpr double least = 1e-6;
        const double scale =
            m_kind == PairKind::Depth ? std::max(std::abs(double(*a)), least) : m_diagonal;
        double square = 0;
        for (size_t c = 0; c < m_pixels.channels; ++c) {
            const double d = double(b[c]) - double(a[c]);
            square += d * d;
        }
        return std::sqrt(square) / scale;
    }

    static double length(const float* v) {
        return std::sqrt(double(v[0]) * v[0] + double(v[1]) * v[1] + double(v[2]) * v[2]);
    }

    // Of the box around the reference's positions where both show a surface.
    double diagonal(size_t count) const {
        double square = 0;
        for (size_t c = 0; c < m_pixels.channels; ++c) {
            double low = std::numeric_limits<double>::infinity(), high = -low;
            for (size_t p = 0; p < count; ++p) {
                const double v = pixel(0, p)[c];
                if (!std::isfinite(v) || !m_surfaces.shown(0, p) || !m_surfaces.shown(1, p))
                    continue;
                low = std::min(low, v);
                high = std::max(high, v);
            }
            square += high > low ? (high - low) * (high - low) : 0;
        }
        return square > 0 ? std::sqrt(square) : 1;
    }

    static constexpr double kUnit = 0.9; ///< shorter ones are means over edges, or no normals

    PairKind m_kind;
    const LayerPixels& m_pixels;
    const Surfaces& m_surfaces;
    double m_diagonal = 1;
};

} // namespace

Surfaces surfaces_of(const LayerPixels& depth) {
    Surfaces surfaces;
    for (size_t side = 0; side < 2; ++side)
        for (const float z : *depth.values[side])
            surfaces.in[side].push_back(z < DataPair::kSky); // NaN is none
    return surfaces;
}

LayerChange layer_change(PairKind kind, const LayerPixels& pixels, const Surfaces& surfaces) {
    return Change(kind, pixels, surfaces).run();
}

} // namespace tonetool::metrics
