// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lights/light_scan.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "imagebuf/color/luminance_plane.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/pixels/row_source.h"
#include "metrics/luminance.h"
#include "metrics/order_statistics.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// The share of a pixel's light that makes a group one of those that light it.
constexpr double kContributes = 0.01;

void luminances(const ColorPlanes& planes, int y, float* out) {
    const float* rgb[3];
    planes.row(planes.region.xbegin, y, rgb);
    metrics::luminance_row(rgb[0], rgb[1], rgb[2], out, planes.width());
}

// A pixel of a group that is not finite is black, as where it is indexed: it would be left out of
// the sums with what the group lacks.
void keep_if_finite(float* pixel, const std::array<int, 3>& channel) {
    bool finite = true;
    for (const int c : channel)
        finite = finite && std::isfinite(pixel[c]);
    for (const int c : channel)
        pixel[c] = finite ? pixel[c] : 0;
}

std::array<int, 3> from(int first, const int (&channel)[3]) {
    return {channel[0] - first, channel[1] - first, channel[2] - first};
}

} // namespace

void LightScan::open(const OIIO::ImageBuf& image, const PixelOptions& beauty,
                     const std::vector<LightGroup>& groups, OIIO::ROI region, int nthreads) {
    m_image = &image;
    m_pixels = beauty;
    m_region = region;
    m_nthreads = nthreads;
    m_readers = std::vector<ColorReader>(groups.size());
    for (size_t g = 0; g < groups.size(); ++g) {
        const PixelOptions pixels{groups[g].layer, beauty.from};
        m_readers[g].open(image, pixels, region, false, nthreads);
        m_groups.push_back({groups[g], 0, 0});
    }
}

void LightScan::run(const Sink& sink) {
    compare();
    m_planes.clear();
    for (const ColorReader& reader : m_readers)
        m_planes.push_back(reader.planes());
    for (int begin = m_region.ybegin; begin < m_region.yend; begin += kLuminanceRows) {
        const int end = std::min(begin + kLuminanceRows, m_region.yend);
        for (size_t g = 0; g < m_readers.size(); ++g)
            m_readers[g].read(begin, end, m_planes[g]);
        std::vector<Row> rows(size_t(end - begin));
        make_parallel(m_nthreads)(end - begin, [&](int64_t i) {
            std::vector<int> indices(size_t(m_region.width()));
            scan_row(begin + int(i), rows[size_t(i)], indices.data());
            if (sink)
                sink(begin + int(i), indices.data());
        });
        for (const Row& row : rows)
            add(row);
    }
}

void LightScan::scan_row(int y, Row& row, int* indices) const {
    const size_t count = m_groups.size(), width = size_t(m_region.width());
    std::vector<float> all(count * width);
    std::vector<const float*> light(count);
    for (size_t g = 0; g < count; ++g) {
        light[g] = all.data() + g * width;
        luminances(m_planes[g], y, all.data() + g * width);
    }
    row.pixels.resize(count);
    row.maxima.resize(count);
    for (size_t x = 0; x < width; ++x) {
        double total = 0;
        for (size_t g = 0; g < count; ++g) {
            total += light[g][x];
            row.maxima[g] = std::max(row.maxima[g], double(light[g][x]));
        }
        indices[x] = choose(light.data(), x, total);
        if (indices[x] >= 0)
            ++row.pixels[size_t(indices[x])];
        else
            ++row.unlit;
    }
}

// Compares the values as they are stored, as --qc does: in Rec.709 the light of a group may be
// negative, and would be cut off.
void LightScan::compare() {
    ColorChoice picture;
    ColorSpace space;
    find_picture(deciding_spec(*m_image), m_pixels, picture, space);
    // Of a file of many AOVs only what lies between the first and the last of them is read.
    int first = std::min({picture.r, picture.g, picture.b});
    int last = std::max({picture.r, picture.g, picture.b});
    for (const ScannedGroup& one : m_groups)
        for (const int channel : one.group.channel) {
            first = std::min(first, channel);
            last = std::max(last, channel);
        }
    const int channels = last + 1 - first;
    const std::array<int, 3> beauty = from(first, {picture.r, picture.g, picture.b});
    std::vector<std::array<int, 3>> groups;
    for (const ScannedGroup& one : m_groups)
        groups.push_back(from(first, one.group.channel));
    const OIIO::ROI window = OIIO::roi_intersection(m_image->roi(), m_region);
    RowSource source;
    source.open(*m_image, {{first, last + 1}});
    const size_t width = size_t(source.width()) * size_t(channels);
    std::vector<float> rows;
    for (int begin = window.ybegin, end = begin; begin < window.yend; begin = end) {
        end = std::min(begin + source.rows_at_once(begin), window.yend);
        rows.resize(width * size_t(end - begin));
        source.read(begin, end, 0, rows.data());
        std::vector<metrics::GroupScan> compared(size_t(end - begin));
        make_parallel(m_nthreads)(end - begin, [&](int64_t i) {
            float* row = rows.data() + width * size_t(i);
            if (space.encoded())
                std::transform(row, row + width, row,
                               [&](float v) { return float(space.light(double(v), 1)); });
            for (const auto& group : groups)
                for (size_t x = 0; x < width; x += size_t(channels))
                    keep_if_finite(row + x, group);
            const metrics::ChannelRow pixels{row + (window.xbegin - source.left()) * channels,
                                             channels, window.width(), window.xbegin, begin + i};
            std::vector<metrics::RowChannel> light;
            for (const auto& group : groups)
                for (const int channel : group)
                    light.push_back({pixels, channel});
            compared[size_t(i)].add_row(
                {{pixels, beauty[0]}, {pixels, beauty[1]}, {pixels, beauty[2]}}, light);
        });
        for (const metrics::GroupScan& row : compared)
            m_compared.add(row);
    }
}

int LightScan::choose(const float* const* light, size_t x, double total) const {
    int best = -1;
    for (size_t g = 0; total > 0 && g < m_groups.size(); ++g) {
        const bool counts = m_values.empty() || light[g][x] > kContributes * total;
        if (counts && (best < 0 || goes_before(g, size_t(best), light, x)))
            best = int(g);
    }
    return best;
}

bool LightScan::goes_before(size_t a, size_t b, const float* const* light, size_t x) const {
    if (!m_values.empty() && m_values[a] != m_values[b])
        return m_values[a] && (!m_values[b] || *m_values[a] > *m_values[b]);
    return light[a][x] > light[b][x];
}

void LightScan::add(const Row& row) {
    for (size_t g = 0; g < m_groups.size(); ++g) {
        m_groups[g].pixels += row.pixels[g];
        m_groups[g].maximum = std::max(m_groups[g].maximum, row.maxima[g]);
    }
    m_unlit += row.unlit;
}

double LightScan::percentile(size_t group, double share) const {
    const PixelOptions pixels{m_groups[group].group.layer, m_pixels.from};
    ColorReader reader;
    reader.open(*m_image, pixels, m_region, false, m_nthreads);
    ColorPlanes planes = reader.planes();
    const auto luminance = read_luminance(reader, planes, m_nthreads);
    const metrics::OrderStatistics order(luminance.data(), m_region.width(), m_region.height(),
                                         m_region.width(), make_parallel(m_nthreads));
    return order.find({metrics::Wanted::percentile(share)})[0];
}

std::vector<std::string> LightScan::warnings() const {
    std::vector<std::string> out;
    int64_t nonfinite = 0;
    for (const ColorPlanes& planes : m_planes)
        nonfinite += planes.counts.nonfinite;
    if (nonfinite > 0)
        out.push_back(
            format("{} pixel(s) of the light groups are not finite and count as black", nonfinite));
    if (!additive())
        out.push_back(format("the light groups do not add up to the picture: their light is {:.3g} "
                             "of its, and pixels differ by {:.3g} (at most {} is expected)",
                             sum(), difference(), LightIndexSummary::kMostDifference));
    return out;
}

} // namespace tonetool
