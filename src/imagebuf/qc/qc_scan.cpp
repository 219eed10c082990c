// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/qc/qc_scan.h"

#include <algorithm>
#include <cmath>

#include "imagebuf/aov/channels.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/qc/qc_header.h"
#include "kernels/curve.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using metrics::Spike;
using OIIO::ImageBuf;
using OIIO::ROI;

} // namespace

void QcScan::open(const std::vector<const ImageBuf*>& parts, const QcOptions& options,
                  int nthreads) {
    m_nthreads = nthreads;
    m_reader.open(parts, options);
    for (const LayerReader::Layer& layer : m_reader.layers())
        m_layers.push_back({layer, {}, {}});
    place_cells();
    choose_guides();
    if (has_picture())
        m_held_begin = m_searched = picture_window().ybegin;
}

void QcScan::run() {
    const int first = m_reader.first_row(), last = m_reader.end_row();
    for (int begin = first; begin < last;) {
        const int end = std::min(begin + m_reader.rows_at_once(begin), last);
        m_reader.read_band(begin, end);
        std::vector<Row> rows(size_t(end - begin));
        make_parallel(m_nthreads)(end - begin,
                                  [&](int64_t i) { scan_row(begin + int(i), rows[size_t(i)]); });
        for (int y = begin; y < end; ++y)
            add(y, rows[size_t(y - begin)]);
        if (has_picture())
            scan_neighbourhoods(end == last);
        begin = end;
    }
    if (has_picture())
        finish_places();
}

void QcScan::scan_row(int y, Row& row) const {
    row.layers.resize(m_layers.size());
    row.exact.resize(m_layers.size());
    for (size_t i = 0; i < m_layers.size(); ++i) {
        const Layer& layer = m_layers[i];
        const metrics::ChannelRow pixels = m_reader.row_of(layer.part, y);
        if (!pixels.pixels)
            continue;
        row.layers[i] = scan_layer(pixels, layer.channels, layer.weights, layer.alpha);
        if (layer.exact)
            row.exact[i] = layer_hash(layer, pixels);
    }
    if (choice().a >= 0) {
        const LayerReader::Place alpha = m_reader.place_of(choice().a);
        const metrics::ChannelRow pixels = m_reader.row_of(alpha.part, y);
        if (pixels.pixels)
            row.alpha = scan_range(pixels, alpha.channel, -QcPicture::kAlphaSlack,
                                   1 + QcPicture::kAlphaSlack);
    }
    scan_guides(y, row);
    scan_albedo(y, row);
    scan_motion(y, row);
    scan_objects(y, row);
    if (has_picture())
        scan_picture_row(y, row);
}

void QcScan::scan_picture_row(int y, Row& row) const {
    const LayerReader::Place place = m_reader.place_of(choice().r);
    const metrics::ChannelRow pixels = m_reader.row_of(place.part, y);
    if (!pixels.pixels)
        return;
    const int channels[3] = {place.channel, m_reader.place_of(choice().g).channel,
                             m_reader.place_of(choice().b).channel};
    std::vector<float> rgb(size_t(pixels.width) * 3);
    for (size_t x = 0; x < size_t(pixels.width); ++x)
        for (size_t c = 0; c < 3; ++c)
            rgb[3 * x + c] = pixels.pixels[x * size_t(pixels.stride) + size_t(channels[c])];
    row.hash = fingerprint(rgb.data(), rgb.size() * sizeof(float));
    if (!groups().empty() && !space().encoded())
        scan_groups(y, row);
    scan_alpha(y, rgb, row);
    scan_places(y, rgb, row);
    if (space().encoded() || space().scale != 1)
        for (float& v : rgb)
            v = float(space().light(double(v), 1));
    row.picture = metrics::scan_picture(rgb.data(), pixels.width, m_reader.weights(), m_columns);
    row.light = metrics::light_row(std::move(row.picture.light));
}

// The levels of alpha; lit pixels, and those of them that alpha hides.
void QcScan::scan_alpha(int y, const std::vector<float>& rgb, Row& row) const {
    if (choice().a < 0)
        return;
    const LayerReader::Place place = m_reader.place_of(choice().a);
    const metrics::RowChannel alpha{m_reader.row_of(place.part, y), place.channel};
    const metrics::ChannelRow& there = alpha.row;
    const int64_t left = picture_window().xbegin;
    for (int64_t x = 0; 3 * size_t(x) < rgb.size(); ++x) {
        const float value = alpha.at(left + x);
        ++row.alpha_levels.pixels;
        row.alpha_levels.clear += value == 0;
        if (std::isfinite(value)) {
            ++row.alpha_levels.finite;
            row.alpha_levels.sum += double(value);
        }
        const float* pixel = &rgb[3 * size_t(x)];
        if (!(std::max({pixel[0], pixel[1], pixel[2]}) > 0))
            continue;
        ++row.lit;
        const bool inside = left + x >= there.x && left + x < there.x + there.width;
        if (there.pixels && inside && value == 0)
            row.unseen.add({left + x, y, 0});
    }
}

// Where a group has no pixel it has no light.
void QcScan::scan_groups(int y, Row& row) const {
    const auto at = [&](int channel) {
        const LayerReader::Place place = m_reader.place_of(channel);
        return metrics::RowChannel{m_reader.row_of(place.part, y), place.channel};
    };
    std::vector<metrics::RowChannel> channels;
    for (const LightGroup& group : groups())
        for (const int channel : group.channel)
            channels.push_back(at(channel));
    row.groups.add_row({at(choice().r), at(choice().g), at(choice().b)}, channels);
}

void QcScan::add(int y, const Row& row) {
    for (size_t i = 0; i < m_layers.size(); ++i)
        m_layers[i].scan.add(row.layers[i]);
    for (size_t i = 0; i < m_layers.size(); ++i)
        m_layers[i].hashes += row.exact[i];
    m_alpha.add(row.alpha);
    m_lit += row.lit;
    m_unseen.add(row.unseen);
    m_alpha_levels.add(row.alpha_levels);
    add_places(y, row);
    add_guides(y, row);
    m_objects.add(row.objects);
    m_group_scan.add(row.groups);
    m_hashes += row.hash;
    if (!row.picture.largest.empty()) {
        m_held.push_back({row.picture.largest, row.light});
        add_cells(y, row.picture.cells);
    }
}

std::string QcScan::Layer::hash() const {
    return exact ? fingerprint(hashes.data(), hashes.size()) : std::string();
}

void QcScan::Alpha::add(const Alpha& later) {
    sum += later.sum;
    finite += later.finite;
    clear += later.clear;
    pixels += later.pixels;
}

std::string QcScan::layer_hash(const Layer& layer, const metrics::ChannelRow& pixels) const {
    std::vector<float> values;
    values.reserve(size_t(pixels.width) * layer.channels.size());
    for (int64_t x = 0; x < pixels.width; ++x)
        for (const int channel : layer.channels)
            values.push_back(pixels.pixels[x * pixels.stride + channel]);
    return fingerprint(values.data(), values.size() * sizeof(float));
}

std::string QcScan::hash() const {
    return fingerprint(m_hashes.data(), m_hashes.size());
}

// The fireflies and the detail of the rows whose neighbours are there.
void QcScan::scan_neighbourhoods(bool last) {
    constexpr int radius = Spike::kRadius;
    static_assert(radius == metrics::DetailScan::kRadius, "both look at the same rows");
    const ROI& window = picture_window();
    const int held = m_held_begin + int(m_held.size());
    const int end = last ? held : held - radius;
    const auto count = size_t(std::max(end - m_searched, 0));
    std::vector<std::vector<Spike>> found(count);
    std::vector<metrics::DetailRow> details(count);
    make_parallel(m_nthreads)(int64_t(count), [&](int64_t i) {
        const int y = m_searched + int(i);
        const float* largest[2 * radius + 1] = {};
        const metrics::LightRow* light[2 * radius + 1] = {};
        for (int at = std::max(y - radius, m_held_begin); at < std::min(y + radius + 1, held);
             ++at) {
            const Held& row = m_held[size_t(at - m_held_begin)];
            largest[at - y + radius] = row.largest.data();
            light[at - y + radius] = &row.light;
        }
        metrics::find_spikes(largest, window.width(), window.xbegin, y, found[size_t(i)]);
        details[size_t(i)] = metrics::DetailScan::scan(light, y - window.ybegin);
    });
    for (size_t i = 0; i < count; ++i) {
        m_spike_count += int64_t(found[i].size());
        m_spikes.insert(m_spikes.end(), found[i].begin(), found[i].end());
        m_detail.add(details[i]);
    }
    metrics::keep_largest(m_spikes, QcPicture::kSpikes);
    m_searched = std::max(end, m_searched);
    while (!m_held.empty() && m_held_begin < m_searched - radius) {
        m_held.pop_front();
        ++m_held_begin;
    }
}

// The cell of each column of a data window, of `cells` in the display window, or -1.
std::vector<int> QcScan::columns_of(const ROI& window, int cells) const {
    std::vector<int> columns;
    for (int x = window.xbegin; x < window.xend; ++x) {
        const int64_t at = int64_t(x) - spec().full_x;
        const bool inside = at >= 0 && at < spec().full_width;
        columns.push_back(inside ? int(at * cells / spec().full_width) : -1);
    }
    return columns;
}

void QcScan::place_cells() {
    constexpr int wide = QcPicture::kWide, peaks = QcPicture::kPeaksWide;
    m_columns.cells = size_t(wide);
    m_columns.peaks = size_t(peaks);
    m_cells.assign(size_t(wide) * QcPicture::kHigh, 0);
    m_colors.assign(3 * m_cells.size(), 0);
    m_peaks.assign(size_t(peaks) * QcPicture::kPeaksHigh, 0);
    m_missing.assign(m_cells.size(), 0);
    m_fingerprints = {spec().full_x,      spec().full_y, spec().full_width,
                      spec().full_height, size_t(peaks), size_t(QcPicture::kPeaksHigh)};
    if (!has_picture())
        return;
    m_columns.cell = columns_of(picture_window(), wide);
    m_columns.peak = columns_of(picture_window(), peaks);
}

void QcScan::add_cells(int y, const metrics::CellRow& cells) {
    const int64_t at = int64_t(y) - spec().full_y;
    if (at < 0 || at >= spec().full_height)
        return;
    const auto row = [&](int wide, int high) {
        return size_t(at * high / spec().full_height) * size_t(wide);
    };
    const size_t first = row(QcPicture::kWide, QcPicture::kHigh);
    for (size_t x = 0; x < m_columns.cells; ++x) {
        m_cells[first + x] += cells.light[x];
        m_missing[first + x] += cells.missing[x];
        for (size_t c = 0; c < 3; ++c)
            m_colors[3 * (first + x) + c] += cells.color[3 * x + c];
    }
    const size_t first_peak = row(QcPicture::kPeaksWide, QcPicture::kPeaksHigh);
    for (size_t x = 0; x < m_columns.peaks; ++x)
        m_peaks[first_peak + x] = std::max(m_peaks[first_peak + x], double(cells.peaks[x]));
}

// How many columns (or rows) of `size` fall into a cell of `cells`.
static int64_t in_cell(int cell, int64_t size, int64_t cells) {
    const auto begin = [&](int64_t c) { return (c * size + cells - 1) / cells; };
    return begin(cell + 1) - begin(cell);
}

int64_t QcScan::display_pixels(int cell_x, int cell_y) const {
    return in_cell(cell_x, spec().full_width, QcPicture::kWide) *
           in_cell(cell_y, spec().full_height, QcPicture::kHigh);
}

std::vector<double> QcScan::cell_means() const {
    std::vector<double> means(m_cells.size());
    for (int y = 0; y < QcPicture::kHigh; ++y)
        for (int x = 0; x < QcPicture::kWide; ++x) {
            const auto at = size_t(y) * QcPicture::kWide + size_t(x);
            const int64_t pixels = display_pixels(x, y) - m_missing[at];
            means[at] = pixels > 0 ? m_cells[at] / double(pixels) : 0;
        }
    return means;
}

} // namespace tonetool
