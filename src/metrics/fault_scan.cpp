// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/fault_scan.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

namespace tonetool::metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace

void Hits::add(const Hit& hit) {
    ++pixels;
    if (first.size() < kMost)
        first.push_back(hit);
}

void Hits::add(const Hits& later) {
    pixels += later.pixels;
    for (const Hit& hit : later.first)
        if (first.size() < kMost)
            first.push_back(hit);
}

void LayerScan::add(const LayerScan& later) {
    nan.add(later.nan);
    inf.add(later.inf);
    negative.add(later.negative);
    finite += later.finite;
    lit += later.lit;
    sum += later.sum;
    if (low.empty()) {
        low = later.low;
        high = later.high;
    }
    for (size_t c = 0; c < later.low.size(); ++c) {
        low[c] = std::min(low[c], later.low[c]);
        high[c] = std::max(high[c], later.high[c]);
    }
}

double LayerScan::min() const {
    return finite > 0 ? *std::min_element(low.begin(), low.end()) : 0;
}

double LayerScan::max() const {
    return finite > 0 ? *std::max_element(high.begin(), high.end()) : 0;
}

bool LayerScan::constant() const {
    return finite > 0 && low == high && nan.pixels == 0 && inf.pixels == 0;
}

LayerScan scan_layer(const ChannelRow& row, const std::vector<int>& channels,
                     const std::vector<double>& weights, int alpha) {
    LayerScan out;
    const size_t count = channels.size();
    out.low.assign(count, kInfinity);
    out.high.assign(count, -kInfinity);
    for (int64_t x = 0; x < row.width; ++x) {
        const float* pixel = row.pixels + x * row.stride;
        const float a = alpha < 0 ? 1.0f : pixel[alpha];
        bool nan = std::isnan(a), inf = std::isinf(a), lit = false;
        double lowest = 0, light = 0;
        for (size_t c = 0; c < count; ++c) {
            const double v = pixel[channels[c]];
            nan = nan || std::isnan(v);
            inf = inf || std::isinf(v);
            lit = lit || v != 0;
            lowest = std::min(lowest, v);
            light += weights[c] * v;
        }
        const Hit here{row.x + x, row.y, 0};
        if (nan)
            out.nan.add(here);
        if (inf)
            out.inf.add(here);
        if (nan || inf)
            continue;
        if (lowest < 0)
            out.negative.add({here.x, here.y, lowest});
        ++out.finite;
        out.lit += lit;
        out.sum += light;
        for (size_t c = 0; c < count; ++c) {
            const double v = pixel[channels[c]];
            out.low[c] = std::min(out.low[c], v);
            out.high[c] = std::max(out.high[c], v);
        }
    }
    return out;
}

void RangeScan::add(const RangeScan& later) {
    below.add(later.below);
    above.add(later.above);
}

RangeScan scan_range(const ChannelRow& row, int channel, double low, double high) {
    RangeScan out;
    for (int64_t x = 0; x < row.width; ++x) {
        const double v = row.pixels[x * row.stride + channel];
        if (v < low && std::isfinite(v))
            out.below.add({row.x + x, row.y, v});
        if (v > high && std::isfinite(v))
            out.above.add({row.x + x, row.y, v});
    }
    return out;
}

void keep_largest(std::vector<Spike>& spikes, size_t most) {
    std::sort(spikes.begin(), spikes.end(), [](const Spike& a, const Spike& b) {
        return a.value != b.value ? a.value > b.value : a.y != b.y ? a.y < b.y : a.x < b.x;
    });
    spikes.resize(std::min(spikes.size(), most));
}

void GroupScan::Sums::add(const Sums& later) {
    picture += later.picture;
    groups += later.groups;
    off += later.off;
    if (later.worst.value > worst.value)
        worst = later.worst;
}

void GroupScan::add_row(const RowChannel (&picture)[3], const std::vector<RowChannel>& groups) {
    const ChannelRow& row = picture[0].row;
    for (int64_t x = row.x; x < row.x + row.width; ++x) {
        double light[3] = {0, 0, 0};
        for (size_t i = 0; i < groups.size(); ++i)
            light[i % 3] += double(groups[i].at(x));
        add({picture[0].at(x), picture[1].at(x), picture[2].at(x)}, light, x, row.y);
    }
}

void GroupScan::add(const float (&picture)[3], const double (&groups)[3], int64_t x, int64_t y) {
    Sums pixel;
    for (int c = 0; c < 3; ++c) {
        const double light = picture[c];
        if (!std::isfinite(light) || !std::isfinite(groups[c]))
            return; // counted elsewhere
        pixel.picture += std::abs(light);
        pixel.groups += groups[c];
        pixel.off += std::abs(light - groups[c]);
    }
    pixel.worst = {x, y, pixel.off};
    GroupScan one;
    one.m_ceiling = std::max({picture[0], picture[1], picture[2]});
    one.m_at = pixel;
    add(one);
}

void GroupScan::add(const GroupScan& later) {
    m_below.add(later.m_below);
    if (later.m_ceiling > m_ceiling) {
        m_below.add(m_at);
        m_at = later.m_at;
        m_ceiling = later.m_ceiling;
    } else if (later.m_ceiling == m_ceiling) {
        m_at.add(later.m_at);
    } else {
        m_below.add(later.m_at);
    }
}

double GroupScan::sum() const {
    return chosen().picture > 0 ? chosen().groups / chosen().picture : 0;
}

// Light groups of a black beauty are as far off as they can be.
double GroupScan::difference() const {
    const Sums& sums = chosen();
    return sums.picture > 0 ? sums.off / sums.picture : sums.off > 0 ? 1 : 0;
}

PictureRow scan_picture(const float* rgb, int64_t width, const double (&weights)[3],
                        const CellColumns& columns) {
    PictureRow out;
    out.largest.resize(size_t(width));
    out.light.resize(size_t(width));
    out.cells.light.resize(columns.cells);
    out.cells.color.resize(3 * columns.cells);
    out.cells.peaks.resize(columns.peaks);
    out.cells.missing.resize(columns.cells);
    for (size_t x = 0; x < size_t(width); ++x) {
        const float* v = rgb + 3 * x;
        const double light = weights[0] * v[0] + weights[1] * v[1] + weights[2] * v[2];
        const bool finite = std::isfinite(light);
        if (finite) {
            out.largest[x] = std::max({v[0], v[1], v[2], 0.0f});
            out.light[x] = float(std::max(light, 0.0));
        }
        if (columns.cell[x] < 0)
            continue;
        const auto cell = size_t(columns.cell[x]);
        out.cells.light[cell] += finite ? std::max(light, 0.0) : 0;
        for (size_t c = 0; finite && c < 3; ++c)
            out.cells.color[3 * cell + c] += double(v[c]);
        float& peak = out.cells.peaks[size_t(columns.peak[x])];
        peak = std::max(peak, out.largest[x]);
        out.cells.missing[cell] += !finite;
    }
    return out;
}

} // namespace tonetool::metrics
