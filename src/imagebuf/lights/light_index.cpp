// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lights/light_index.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/aov/aov_layers.h"
#include "imagebuf/options/tone_options.h"
#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"
#include "imagebuf/pixels/row_source.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

constexpr double kMostIndex = 1e9, kWhole = 0.01;
// Values of a layer; what has more is no index.
constexpr size_t kMostValues = 1 << 20;

bool is_index(const AovLayer& layer) {
    static const char* const names[] = {"lightindex", "m", "lightid", "lightidx"};
    return layer.count == 1 && std::find(std::begin(names), std::end(names),
                                         plain_word(layer.layer_name)) != std::end(names);
}

// Integers come as 0..1. Where their type is known no more the header may still tell their bits;
// and 32 bits make whole numbers of less than a million values below 0.001, which no index has.
double index_scale(const ImageBuf& image, int channel, double largest) {
    const ImageSpec& native = image.nativespec();
    OIIO::TypeDesc type = OIIO::TypeFloat;
    if (native.nchannels == image.nchannels())
        type = native.channelformat(channel);
    const bool fraction = type == OIIO::TypeDesc::FLOAT && largest > 0 && largest <= 1;
    const int bits = fraction ? native.get_int_attribute("oiio:BitsPerSample") : 0;
    if (type == OIIO::TypeDesc::UINT8 || bits == 8)
        return 255;
    if (type == OIIO::TypeDesc::UINT16 || bits == 16)
        return 65535;
    if (type == OIIO::TypeDesc::INT32)
        return 2147483647.0;
    return type == OIIO::TypeDesc::UINT32 || (largest > 0 && largest < 1e-3) ? 4294967295.0 : 1;
}

} // namespace

std::optional<IndexLayer> find_index_layer(const ImageSpec& spec, const std::string& name,
                                           const std::string& beauty) {
    std::optional<IndexLayer> out;
    const std::string view_layer = split_layer(beauty).view_layer;
    std::vector<std::string> valid;
    for (const AovLayer& layer : aov_layers(spec)) {
        if (layer.scalar() < 0 || layer.name.empty())
            continue;
        valid.push_back(layer.name);
        const bool named = layer.name == name || layer.layer_name == name;
        const bool here = !out || layer.name == name || layer.view_layer == view_layer;
        if ((name.empty() ? is_index(layer) : named) && here)
            out = {layer.name, layer.scalar()};
    }
    if (!out && !name.empty())
        throw Refusal(unknown_name("light index layer", name, valid));
    return out;
}

namespace {

// Values of a channel and how many pixels have them, but NaN.
using ValueCounts = std::map<float, int64_t>;

void count_runs(const std::vector<float>& rows, ValueCounts& counts, int64_t& nans) {
    for (size_t i = 0; i < rows.size();) {
        size_t end = i + 1;
        while (end < rows.size() && rows[end] == rows[i])
            ++end;
        if (std::isnan(rows[i]))
            ++nans;
        else
            counts[rows[i]] += int64_t(end - i);
        i = end;
    }
}

void count_values(const ImageBuf& image, const IndexLayer& layer, ValueCounts& counts,
                  int64_t& nans) {
    RowSource source;
    source.open(image, runs_of({layer.channel}));
    const ROI roi = image.roi();
    std::vector<float> rows;
    for (int first = roi.ybegin; first < roi.yend;) {
        const int last = std::min(first + source.rows_at_once(first), roi.yend);
        rows.resize(size_t(last - first) * size_t(source.width()));
        source.read(first, last, 0, rows.data());
        count_runs(rows, counts, nans);
        if (counts.size() > kMostValues)
            throw Refusal(
                format("layer \"{}\" has more than {} different values: it is not an index "
                       "of lights (lightindex= names one, or groups)",
                       layer.layer, kMostValues));
        first = last;
    }
}

} // namespace

IndexCounts count_indices(const ImageBuf& image, const IndexLayer& layer) {
    ValueCounts values;
    IndexCounts counts;
    count_values(image, layer, values, counts.invalid);
    const double largest = values.empty() ? 0 : values.rbegin()->first;
    const double scale = index_scale(image, layer.channel, largest);
    for (const auto& [stored, pixels] : values) {
        const double value = stored * scale;
        if (!std::isfinite(value) || value > kMostIndex) {
            counts.invalid += pixels;
        } else if (std::round(value) < 0) {
            counts.negative += pixels;
        } else {
            counts.pixels[int(std::lround(value))] += pixels;
            counts.between += std::abs(value - std::round(value)) > kWhole ? pixels : 0;
        }
    }
    return counts;
}

std::vector<const Light*> lights_of(const LightTable& table,
                                    const std::vector<ScannedGroup>& groups) {
    std::vector<const Light*> lights;
    for (const ScannedGroup& group : groups) {
        const Light* light = table.find(group.group.name);
        lights.push_back(light ? light : table.find(group.group.layer));
    }
    if (std::all_of(lights.begin(), lights.end(), [](const Light* l) { return !l; }))
        for (size_t g = 0; g < groups.size(); ++g)
            lights[g] = table.find(int(g));
    return lights;
}

LightScan open_scan(const ImageBuf& image, const PixelOptions& beauty, const LightOptions& options,
                    const LightTable* table, ROI region, int nthreads) {
    check_options(options);
    if (options.index == "power" && !table)
        throw Refusal("index=power needs a table of lights (lights=)");
    const ColorChoice choice = chosen_color(deciding_spec(image), beauty);
    LightScan scan;
    scan.open(image, beauty, choose_light_groups(image.spec(), choice.layer, options.groups),
              region, nthreads);
    if (options.index == "power") {
        std::vector<std::optional<double>> values;
        for (const Light* light : lights_of(*table, scan.groups()))
            values.push_back(light ? table->rank(*light) : std::nullopt);
        scan.rank_by(values);
    }
    return scan;
}

} // namespace tonetool
