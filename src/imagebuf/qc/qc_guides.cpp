// SPDX-License-Identifier: BSD-3-Clause
// What a scan keeps of the layers that are not light: means over cells of those without noise, the
// magenta of an albedo, the speed of a motion layer.
#include <algorithm>
#include <cmath>

#include "imagebuf/qc/qc_header.h"
#include "imagebuf/qc/qc_scan.h"

namespace tonetool {
namespace {

// What renderers write where there is nothing, and other values that are none.
constexpr float kNoValue = 1e9f;

bool is_value(float value) {
    return std::abs(value) < kNoValue; // NaN is not
}

// A texture that was not found is magenta in most renderers.
bool is_magenta(const float* pixel, const std::vector<int>& channels) {
    constexpr float most = 0.98f, least = 0.02f;
    return pixel[channels[0]] > most && pixel[channels[1]] < least && pixel[channels[2]] > most;
}

} // namespace

void QcScan::choose_guides() {
    constexpr size_t most = 2;
    const auto index = [&](const char* kind) {
        const auto found = std::find_if(m_layers.begin(), m_layers.end(),
                                        [&](const Layer& layer) { return layer.kind == kind; });
        return found == m_layers.end() ? -1 : int(found - m_layers.begin());
    };
    m_albedo = index("albedo");
    m_motion = index("motion");
    // Of a Cryptomatte of materials, too, that of objects: two objects may share a material.
    const auto of_objects = std::find_if(m_layers.begin(), m_layers.end(), [](const Layer& layer) {
        return layer.kind == "id" && is_of_objects(layer.name);
    });
    m_object_layer =
        of_objects == m_layers.end() ? index("id") : int(of_objects - m_layers.begin());
    for (const char* kind : {"depth", "normal", "position", "albedo"}) {
        const int layer = index(kind);
        if (layer < 0 || m_guides.size() == most)
            continue;
        Guide& guide = m_guides.emplace_back();
        guide.layer = size_t(layer);
        guide.columns = columns_of(m_reader.window(m_layers[guide.layer].part), QcPicture::kWide);
        guide.pixels.resize(m_cells.size());
        guide.sums.resize(m_cells.size() * m_layers[guide.layer].channels.size());
    }
}

void QcScan::scan_guides(int y, Row& row) const {
    row.guides.resize(m_guides.size());
    for (size_t i = 0; i < m_guides.size(); ++i) {
        const Guide& guide = m_guides[i];
        const std::vector<int>& channels = m_layers[guide.layer].channels;
        const metrics::ChannelRow pixels = m_reader.row_of(m_layers[guide.layer].part, y);
        if (!pixels.pixels)
            continue;
        GuideRow& sums = row.guides[i];
        sums.pixels.resize(size_t(QcPicture::kWide));
        sums.sums.resize(sums.pixels.size() * channels.size());
        for (int64_t x = 0; x < pixels.width; ++x) {
            if (guide.columns[size_t(x)] < 0)
                continue;
            const auto cell = size_t(guide.columns[size_t(x)]);
            ++sums.pixels[cell];
            for (size_t c = 0; c < channels.size(); ++c) {
                const float value = pixels.pixels[x * pixels.stride + channels[c]];
                sums.sums[cell * channels.size() + c] += is_value(value) ? double(value) : 0;
            }
        }
    }
}

void QcScan::scan_albedo(int y, Row& row) const {
    if (m_albedo < 0)
        return;
    const Layer& layer = m_layers[size_t(m_albedo)];
    const metrics::ChannelRow pixels = m_reader.row_of(layer.part, y);
    for (int64_t x = 0; pixels.pixels && x < pixels.width; ++x) {
        ++row.magenta.all;
        row.magenta.some += is_magenta(pixels.pixels + x * pixels.stride, layer.channels);
    }
}

void QcScan::scan_motion(int y, Row& row) const {
    if (m_motion < 0)
        return;
    const Layer& layer = m_layers[size_t(m_motion)];
    const metrics::ChannelRow pixels = m_reader.row_of(layer.part, y);
    for (int64_t x = 0; pixels.pixels && x < pixels.width; ++x)
        for (const int channel : layer.channels) {
            const float value = pixels.pixels[x * pixels.stride + channel];
            if (is_value(value))
                row.speeds.push_back(metrics::StepHistogram::code(std::abs(value)));
        }
}

void QcScan::add_guides(int y, const Row& row) {
    m_magenta.some += row.magenta.some;
    m_magenta.all += row.magenta.all;
    m_speed.add(row.speeds);
    const int64_t at = int64_t(y) - spec().full_y;
    if (at < 0 || at >= spec().full_height)
        return;
    const auto first =
        size_t(at * QcPicture::kHigh / spec().full_height) * size_t(QcPicture::kWide);
    for (size_t i = 0; i < m_guides.size(); ++i) {
        Guide& guide = m_guides[i];
        const size_t channels = m_layers[guide.layer].channels.size();
        for (size_t x = 0; x < row.guides[i].pixels.size(); ++x) {
            guide.pixels[first + x] += row.guides[i].pixels[x];
            for (size_t c = 0; c < channels; ++c)
                guide.sums[(first + x) * channels + c] += row.guides[i].sums[x * channels + c];
        }
    }
}

std::vector<double> QcScan::Guide::means(size_t channels) const {
    std::vector<double> means(sums);
    for (size_t i = 0; i < means.size(); ++i)
        means[i] /= double(std::max<int64_t>(pixels[i / channels], 1));
    return means;
}

double QcScan::magenta() const {
    return m_magenta.all > 0 ? double(m_magenta.some) / double(m_magenta.all) : 0;
}

// The first channel: of a Cryptomatte the IDs of the largest coverage.
void QcScan::scan_objects(int y, Row& row) const {
    if (m_object_layer < 0)
        return;
    const Layer& layer = m_layers[size_t(m_object_layer)];
    const metrics::ChannelRow pixels = m_reader.row_of(layer.part, y);
    row.objects.add_row(pixels, layer.channels[0],
                        int64_t(QcObjects::kBorder * double(pixels.width)));
}

int64_t QcScan::object_pixels() const {
    const OIIO::ROI& window = m_reader.window(m_layers[size_t(m_object_layer)].part);
    return int64_t(window.width()) * window.height();
}

} // namespace tonetool
