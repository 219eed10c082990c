// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/qc/layer_reader.h"

#include <algorithm>
#include <set>

#include "imagebuf/aov/channels.h"
#include "imagebuf/qc/qc_header.h"
#include "kernels/curve.h"
#include "metrics/refusal.h"

namespace tonetool {

using OIIO::ImageBuf;

void LayerReader::open(const std::vector<const ImageBuf*>& parts, const QcOptions& options) {
    m_spec = joined_spec(parts);
    try {
        find_picture(m_spec, options.pixels, m_choice, m_space);
    } catch (const Refusal&) {
        // Layers of data are looked at without one.
        if (!options.pixels.layer.empty() || !holds_only_data(m_spec))
            throw;
        m_choice = {};
        m_space = {};
    }
    if (has_picture())
        m_groups = choose_light_groups(m_spec, m_choice.layer, options.groups);
    open_parts(parts);
    for (size_t c = 0; c < 3; ++c)
        for (size_t p = 0; p < 3; ++p)
            m_weights[c] += kernels::kLuminance[p] * m_space.to_rec709[p][c];
    list_layers();
}

void LayerReader::open_parts(const std::vector<const ImageBuf*>& parts) {
    for (const ImageBuf* image : parts) {
        Part& part = m_parts.emplace_back();
        part.window = image->roi();
        part.channels = image->nchannels();
        part.source.open(*image, {{0, part.channels}});
    }
    if (!has_picture())
        return;
    const size_t picture = place_of(m_choice.r).part;
    if (place_of(m_choice.g).part != picture || place_of(m_choice.b).part != picture)
        throw Refusal("red, green and blue of the picture are in different parts of the file");
}

LayerReader::Place LayerReader::place_of(int channel) const {
    Place place{0, channel};
    while (place.channel >= m_parts[place.part].channels)
        place.channel -= m_parts[place.part++].channels;
    return place;
}

// Whether a channel is part of what its layer is about: beside R, G, B, and beside the one channel
// of a grey picture, other channels are layers of their own. "Z" is no colour.
bool LayerReader::belongs(const AovLayer& layer, int channel) const {
    if (layer.has_rgb())
        return std::find(layer.rgb, layer.rgb + 3, channel) != layer.rgb + 3;
    const auto& all = layer.channels;
    const bool grey = std::find(all.begin(), all.end(), m_choice.r) != all.end();
    return !grey || channel == m_choice.r;
}

// Whether a channel is the alpha of its layer: that of ids is a coverage like the others.
static bool is_alpha(const AovLayer& layer, const std::string& kind, int channel) {
    return channel == layer.alpha && layer.count > 1 && kind != "id";
}

LayerReader::Layer LayerReader::layer_of(const AovLayer& from) const {
    Layer layer;
    layer.name = from.plain && from.has_rgb() ? "" : from.name;
    layer.kind = layer_kind(from, m_choice, m_groups);
    layer.part = place_of(from.first).part;
    const bool ids = layer.kind == "id";
    for (const int channel : from.channels) {
        const bool alpha = is_alpha(from, layer.kind, channel);
        if (alpha || ids || belongs(from, channel))
            layer.names.emplace_back(m_spec.channel_name(channel));
        if (alpha && place_of(channel).part == layer.part)
            layer.alpha = place_of(channel).channel;
        if (alpha || (!ids && !belongs(from, channel)))
            continue;
        const auto* color = std::find(from.rgb, from.rgb + 3, channel);
        const bool colored = from.has_rgb() && color != from.rgb + 3;
        layer.channels.push_back(place_of(channel).channel);
        layer.weights.push_back(colored ? m_weights[color - from.rgb] : 1.0);
    }
    for (double& weight : layer.weights)
        weight /= from.has_rgb() && !ids ? 1.0 : double(layer.weights.size());
    layer.exact = is_exact(layer.kind, layer.name);
    return layer;
}

void LayerReader::list_layers() {
    for (const AovLayer& from : aov_layers(m_spec)) {
        m_layers.push_back(layer_of(from));
        const std::string kind = m_layers.back().kind;
        for (const int channel : from.channels)
            if (kind != "id" && !is_alpha(from, kind, channel) && !belongs(from, channel))
                m_layers.push_back(lone_layer(channel));
    }
}

LayerReader::Layer LayerReader::lone_layer(int channel) const {
    const std::string name(m_spec.channel_name(channel));
    OIIO::ImageSpec one(1, 1, 1, OIIO::TypeFloat);
    one.channelnames = {name};
    const Place place = place_of(channel);
    const std::string kind = layer_kind(aov_layers(one).front(), {}, {});
    return {name, kind, place.part, {place.channel}, {1.0}, {name}};
}

int LayerReader::first_row() const {
    int first = m_parts[0].window.ybegin;
    for (const Part& part : m_parts)
        first = std::min(first, part.window.ybegin);
    return first;
}

int LayerReader::end_row() const {
    int end = m_parts[0].window.yend;
    for (const Part& part : m_parts)
        end = std::max(end, part.window.yend);
    return end;
}

void LayerReader::read_band(int begin, int end) {
    for (Part& part : m_parts) {
        part.begin = std::clamp(begin, part.window.ybegin, part.window.yend);
        part.end = std::clamp(end, part.begin, part.window.yend);
        const size_t row = size_t(part.window.width()) * size_t(part.channels);
        part.pixels.resize(row * size_t(part.end - part.begin));
        if (part.begin < part.end)
            part.source.read(part.begin, part.end, 0, part.pixels.data());
    }
}

metrics::ChannelRow LayerReader::row_of(size_t which, int y) const {
    const Part& part = m_parts[which];
    if (y < part.begin || y >= part.end)
        return {};
    const size_t row = size_t(part.window.width()) * size_t(part.channels);
    return {part.pixels.data() + row * size_t(y - part.begin), part.channels, part.window.width(),
            part.window.xbegin, y};
}

std::vector<float> LayerReader::values(size_t part, const std::vector<int>& channels,
                                       const OIIO::ROI& window, int y) const {
    const metrics::ChannelRow row = row_of(part, y);
    std::vector<float> values(size_t(window.width()) * channels.size());
    for (int64_t x = window.xbegin; row.pixels && x < window.xend; ++x) {
        const int64_t from = x - row.x;
        if (from < 0 || from >= row.width)
            continue;
        const float* pixel = row.pixels + from * row.stride;
        float* to = &values[size_t(x - window.xbegin) * channels.size()];
        for (size_t c = 0; c < channels.size(); ++c)
            to[c] = pixel[channels[c]];
    }
    return values;
}

std::vector<float> LayerReader::light(size_t part, const std::vector<int>& channels,
                                      const OIIO::ROI& window, int y) const {
    std::vector<float> row = values(part, channels, window, y);
    if (channels.size() != 3)
        return row;
    if (m_space.convert) {
        m_space.convert(row.data(), ptrdiff_t(row.size() / 3));
        return row;
    }
    if (m_space.encoded() || m_space.scale != 1)
        for (float& v : row)
            v = float(m_space.light(double(v), 1));
    if (m_space.is_rec709)
        return row;
    for (size_t at = 0; at < row.size(); at += 3) {
        const double in[3] = {row[at], row[at + 1], row[at + 2]};
        for (size_t p = 0; p < 3; ++p) {
            const auto& m = m_space.to_rec709[p];
            row[at + p] = float(m[0] * in[0] + m[1] * in[1] + m[2] * in[2]);
        }
    }
    return row;
}

std::vector<std::array<size_t, 2>> same_layers(const std::vector<LayerReader::Layer>& first,
                                               const std::vector<size_t>& listed_first,
                                               const std::vector<LayerReader::Layer>& second,
                                               const std::vector<size_t>& listed_second) {
    using Layer = LayerReader::Layer;
    std::vector<std::array<size_t, 2>> pairs;
    std::set<size_t> taken;
    const auto match = [&](size_t theirs, const auto& same) {
        const auto found = std::find_if(listed_second.begin(), listed_second.end(), [&](size_t i) {
            return taken.count(i) == 0 && same(first[theirs], second[i]);
        });
        if (found == listed_second.end())
            return false;
        taken.insert(*found);
        pairs.push_back({theirs, *found});
        return true;
    };
    std::vector<size_t> left;
    for (const size_t i : listed_first)
        if (!match(i, [](const Layer& a, const Layer& b) { return a.name == b.name; }))
            left.push_back(i);
    for (const size_t i : left)
        match(i, [](const Layer& a, const Layer& b) {
            const bool nameless = a.name.empty() || b.name.empty();
            return split_layer(a.name).layer_name == split_layer(b.name).layer_name ||
                   (nameless && a.kind == "picture" && b.kind == "picture");
        });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

} // namespace tonetool
