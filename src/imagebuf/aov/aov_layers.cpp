// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/aov_layers.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "imagebuf/pixels/names.h"

namespace tonetool {
namespace {

struct Split {
    std::string prefix, component; // component "": the channel is a layer of its own
};

bool is_component(const std::string& word) {
    static const std::set<std::string> known = {"r", "g", "b", "a", "red", "green", "blue", "alpha",
                                                "x", "y", "z", "w", "u",   "v",     "t",    "i"};
    return known.count(word) > 0;
}

// "P.X" and the "Px" of pbrt of 2021, which is one of three: "Pz" alone is Houdini's depth.
Split split(const std::string& full, const std::set<std::string>& all) {
    const auto dot = full.rfind('.');
    const std::string last = dot == std::string::npos ? full : full.substr(dot + 1);
    if (is_component(lower(last)))
        return {dot == std::string::npos ? "" : full.substr(0, dot), lower(last)};
    const std::string stem = full.substr(0, full.size() - 1);
    const char end = full.empty() ? '\0' : full.back();
    if (last.size() > 1 && end >= 'x' && end <= 'z' && all.count(stem + "x") > 0 &&
        all.count(stem + "y") > 0 && all.count(stem + "z") > 0)
        return {stem, std::string(1, end)};
    return {full, ""};
}

void place(AovLayer& layer, const std::string& component, int channel) {
    const std::string names[3][3] = {{"r", "red", "x"}, {"g", "green", "y"}, {"b", "blue", "z"}};
    for (size_t i = 0; i < 3; ++i) {
        if (component == names[i][0] || component == names[i][1]) {
            layer.twice = layer.twice || layer.rgb[i] >= 0;
            layer.rgb[i] = layer.rgb[i] < 0 ? channel : layer.rgb[i];
        }
        if (component == names[i][2] && layer.xyz[i] < 0)
            layer.xyz[i] = channel;
    }
    if (component == "t" && layer.t < 0)
        layer.t = channel;
    if ((component == "a" || component == "alpha") && layer.alpha < 0)
        layer.alpha = channel;
    layer.channels.push_back(channel);
    if (layer.count++ == 0)
        layer.first = channel;
}

AovLayer named(const std::string& prefix, const OIIO::ImageSpec& spec) {
    AovLayer layer;
    layer.plain = prefix.empty();
    // In a file of many parts the name of the part may be all there is.
    layer.name = layer.plain ? part_name(spec) : prefix;
    const LayerName split = split_layer(layer.name);
    layer.view_layer = split.view_layer;
    layer.layer_name = split.layer_name;
    layer.pass = plain_word(layer.layer_name);
    return layer;
}

} // namespace

int AovLayer::scalar() const {
    if (has_lone_z())
        return xyz[2];
    if (t >= 0)
        return t;
    return count == 1 ? first : has_rgb() ? rgb[0] : -1;
}

std::string part_name(const OIIO::ImageSpec& spec) {
    const std::string name = spec.get_string_attribute("oiio:subimagename");
    return name.empty() ? std::string(spec.get_string_attribute("name")) : name;
}

std::vector<AovLayer> aov_layers(const OIIO::ImageSpec& spec) {
    const std::set<std::string> all(spec.channelnames.begin(), spec.channelnames.end());
    std::vector<AovLayer> layers;
    std::vector<std::string> prefixes;
    for (int i = 0; i < spec.nchannels; ++i) {
        const Split channel = split(std::string(spec.channel_name(i)), all);
        auto at =
            size_t(std::find(prefixes.begin(), prefixes.end(), channel.prefix) - prefixes.begin());
        if (at == prefixes.size()) {
            prefixes.push_back(channel.prefix);
            layers.push_back(named(channel.prefix, spec));
        }
        place(layers[at], channel.component, i);
    }
    return layers;
}

LayerName split_layer(const std::string& layer) {
    const auto dot = layer.rfind('.');
    if (dot == std::string::npos)
        return {"", layer};
    const std::string last = layer.substr(dot + 1), before = layer.substr(0, dot);
    const LayerName split = split_layer(before);
    // Stereo pairs of Blender are "ViewLayer.Position.left".
    if (lower(last) == "left" || lower(last) == "right")
        return {split.view_layer + "." + last, split.layer_name};
    // Mitsuba's manual calls a layer "dd.y".
    if (last == "x" || last == "y")
        return {split.view_layer, split.layer_name + "." + last};
    return {before, last};
}

} // namespace tonetool
