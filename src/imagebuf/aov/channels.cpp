// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/channels.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <map>
#include <set>

#include "imagebuf/aov/aov_layers.h"
#include "imagebuf/pixels/layer_name.h"
#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

// What renderers call the final picture, as plain_word() makes it.
constexpr const char* kBeautyNames[] = {"combined", "rgba",  "rgb",        "c",     "ci",
                                        "beauty",   "color", "finalimage", "final", "image"};

struct Layer {
    std::string name; // "" for plain R,G,B
    std::string part; // of plain R,G,B: what the part of the file is called
    int channel[4] = {-1, -1, -1, -1};
    bool twice = false; // a colour is there in two spellings, "R" and "red"
    std::string shown() const { return shown_layer(name); }
    AovKind kind() const {
        return kind_of_layer(split_layer(name.empty() ? part : name).layer_name);
    }
};

// Those with colour, in the order of the file.
std::vector<Layer> find_layers(const OIIO::ImageSpec& spec) {
    std::vector<Layer> layers;
    for (const AovLayer& from : aov_layers(spec))
        if (from.has_rgb())
            layers.push_back({from.plain ? "" : from.name,
                              from.plain ? from.name : "",
                              {from.rgb[0], from.rgb[1], from.rgb[2], from.alpha},
                              from.twice});
    return layers;
}

// The pass name of "ViewLayer.Denoising Normal": "denoisingnormal".
std::string pass_name(const std::string& layer) {
    return plain_word(split_layer(layer).layer_name);
}

bool is_picture(const Layer& layer) {
    return layer.kind() == AovKind::Light;
}

// The last part of a channel's name, in lower case.
std::string last_part(const std::string& channel) {
    const auto dot = channel.rfind('.');
    return lower(dot == std::string::npos ? channel : channel.substr(dot + 1));
}

std::string prefix_of(const std::string& channel) {
    const auto dot = channel.rfind('.');
    return dot == std::string::npos ? "" : channel.substr(0, dot);
}

bool is_alpha(const std::string& channel) {
    const std::string last = last_part(channel);
    return last == "a" || last == "alpha";
}

// The alpha beside a channel of this layer, -1 if there is none.
int alpha_beside(const OIIO::ImageSpec& spec, int channel) {
    const std::string prefix = prefix_of(std::string(spec.channel_name(channel)));
    for (int i = 0; i < spec.nchannels; ++i)
        if (i != channel && is_alpha(std::string(spec.channel_name(i))) &&
            prefix_of(std::string(spec.channel_name(i))) == prefix)
            return i;
    return -1;
}

Layer grey_layer(const OIIO::ImageSpec& spec, int channel) {
    const std::string name(spec.channel_name(channel));
    const std::string prefix = prefix_of(name), last = last_part(name);
    static const std::set<std::string> names = {"y", "r",    "red", "g",    "green",
                                                "b", "blue", "a",   "alpha"};
    const bool plain = prefix.empty() && names.count(last) > 0;
    Layer layer{plain ? "" : prefix.empty() ? name : prefix, part_name(spec), {}, false};
    std::fill_n(layer.channel, 3, channel);
    layer.channel[3] = alpha_beside(spec, channel);
    return layer;
}

// The one channel that a picture without colours consists of, beside its alpha: the only channel of
// the file, or a plain Y without the colour differences RY, BY and without an X that makes it part
// of a vector.
std::vector<Layer> grey_picture(const OIIO::ImageSpec& spec) {
    std::vector<int> channels;
    for (int i = 0; i < spec.nchannels; ++i)
        if (spec.nchannels == 1 || !is_alpha(std::string(spec.channel_name(i))))
            channels.push_back(i);
    const auto plain = [&](const char* name) {
        return std::find_if(channels.begin(), channels.end(), [&](int i) {
            return lower(std::string(spec.channel_name(i))) == name;
        });
    };
    if (channels.size() > 1) {
        const auto none = channels.end();
        // FITS readers name one channel of several.
        const bool grey = plain("y") != none && plain("x") == none && plain("u") == none &&
                          plain("ry") == none && plain("by") == none && plain("") == none;
        channels = grey ? std::vector<int>{*plain("y")} : std::vector<int>{};
    }
    return channels.empty() ? std::vector<Layer>{}
                            : std::vector<Layer>{grey_layer(spec, channels[0])};
}

// Whether a picture of one channel holds light by its names: "Z" and "uv.u" do not.
bool is_grey_picture(const OIIO::ImageSpec& spec, const Layer& layer) {
    const std::string last = last_part(std::string(spec.channel_name(layer.channel[0])));
    static const std::vector<std::string> data = {"z", "x", "u", "v", "w", "t", "i", "id"};
    return is_picture(layer) && std::find(data.begin(), data.end(), last) == data.end() &&
           kind_of_layer(last) == AovKind::Light;
}

std::vector<std::string> names_of(const std::vector<Layer>& layers) {
    std::vector<std::string> names;
    for (const Layer& layer : layers)
        names.push_back(layer.name.empty() && !is_picture(layer) ? layer.part : layer.shown());
    return names;
}

std::string list(const std::vector<Layer>& layers) {
    return layers.empty() ? "none" : OIIO::Strutil::join(names_of(layers), ", ");
}

std::string list_channels(const OIIO::ImageSpec& spec) {
    constexpr size_t most = 16;
    std::vector<std::string> names(spec.channelnames.begin(),
                                   spec.channelnames.begin() +
                                       ptrdiff_t(std::min(spec.channelnames.size(), most)));
    if (spec.channelnames.size() > most)
        names.push_back("and " + std::to_string(spec.channelnames.size() - most) + " more");
    return names.empty() ? "none" : OIIO::Strutil::join(names, ", ");
}

std::vector<Layer> only(const std::vector<Layer>& layers, bool (*keep)(const Layer&)) {
    std::vector<Layer> out;
    std::copy_if(layers.begin(), layers.end(), std::back_inserter(out), keep);
    return out;
}

// The layer a user named: exactly, else in any case, else by its last part.
std::vector<Layer> named(const std::vector<Layer>& layers, const std::string& name) {
    std::vector<Layer> exact, any_case, last_part;
    for (const Layer& layer : layers) {
        const bool by_part = layer.name.empty() && !layer.part.empty();
        if (layer.shown() == name || (by_part && layer.part == name))
            exact.push_back(layer);
        if (lower(layer.shown()) == lower(name) || (by_part && lower(layer.part) == lower(name)))
            any_case.push_back(layer);
        if (!layer.name.empty() && pass_name(layer.name) == pass_name(name) &&
            name.find('.') == std::string::npos)
            last_part.push_back(layer);
    }
    return !exact.empty() ? exact : !any_case.empty() ? any_case : last_part;
}

// The layers of one channel that a user named: by the layer, or by the whole name of the channel.
std::vector<Layer> named_grey(const OIIO::ImageSpec& spec, const std::string& name) {
    std::map<std::string, std::vector<int>> channels; // of each layer, but alpha
    std::vector<Layer> exact, any_case;
    for (int i = 0; i < spec.nchannels; ++i) {
        const std::string full(spec.channel_name(i));
        if (!is_alpha(full) || full == name)
            channels[prefix_of(full)].push_back(i);
        if (lower(full) == lower(name))
            (full == name ? exact : any_case).push_back(grey_layer(spec, i));
    }
    for (const auto& [prefix, of_layer] : channels)
        if (of_layer.size() == 1 && !prefix.empty() && lower(prefix) == lower(name))
            (prefix == name ? exact : any_case).push_back(grey_layer(spec, of_layer[0]));
    return !exact.empty() ? exact : any_case;
}

// The one picture of the file.
std::vector<Layer> beauty(const OIIO::ImageSpec& spec, const std::vector<Layer>& layers) {
    auto plain = only(layers, [](const Layer& l) { return l.name.empty() && is_picture(l); });
    if (!plain.empty())
        return plain;
    auto beauties =
        only(layers, [](const Layer& l) { return !l.name.empty() && is_beauty_name(l.name); });
    if (!beauties.empty())
        return beauties;
    // A file with one layer in all is about that layer, unless its name says data.
    if (layers.size() == 1 && is_picture(layers[0]))
        return layers;
    const auto grey = layers.empty() ? grey_picture(spec) : std::vector<Layer>{};
    return !grey.empty() && is_grey_picture(spec, grey[0]) ? grey : std::vector<Layer>{};
}

// How a user asks for a layer that is not taken for the picture.
std::string asked_as(const Layer& layer) {
    return !layer.name.empty() ? layer.name : shown_layer(layer.part);
}

std::string data_text(const OIIO::ImageSpec& spec, const Layer& layer) {
    const std::string channel(spec.channel_name(layer.channel[0]));
    const bool grey = layer.channel[0] == layer.channel[1];
    AovKind kind = layer.kind();
    if (kind == AovKind::Light)
        kind = kind_of_layer(last_part(channel));
    const std::string holds = kind == AovKind::Light ? "data" : plural_of(kind);
    const std::string name = grey && layer.name.empty() ? channel : asked_as(layer);
    return "\"" + name + "\", the only layer, holds " + holds +
           " by its name, and is not taken for the picture; pass layer=" + name +
           " to look at it all the same";
}

// The picture of a part of that name or view; of a file of one part with several views, that of
// the first, whose channels have no prefix.
std::vector<Layer> of_part(const OIIO::ImageSpec& spec, const std::vector<Layer>& layers,
                           const std::string& name) {
    std::string view;
    if (const OIIO::ParamValue* views = spec.find_attribute("multiView"))
        view = views->get_string_indexed(0);
    const std::string names[] = {spec.get_string_attribute("oiio:subimagename"),
                                 spec.get_string_attribute("view"), view};
    const bool meant = std::any_of(std::begin(names), std::end(names), [&](const std::string& one) {
        return !one.empty() && lower(one) == lower(name);
    });
    if (!meant)
        return {};
    const auto found = beauty(spec, layers);
    return found.empty() && layers.size() == 1 ? layers : found;
}

// Whether channels of that layer are there: "Depth" of ViewLayer.Depth.Z.
bool has_data_layer(const OIIO::ImageSpec& spec, const std::string& name) {
    const std::string inner = "." + lower(name) + ".";
    return std::any_of(spec.channelnames.begin(), spec.channelnames.end(),
                       [&](const std::string& channel) {
                           return ("." + lower(channel)).find(inner) != std::string::npos;
                       });
}

std::string no_layer_text(const OIIO::ImageSpec& spec, const std::vector<Layer>& layers,
                          const std::string& name) {
    if (!name.empty())
        return (has_data_layer(spec, name)
                    ? "layer \"" + name + "\" has no R,G,B; "
                    : "no colour layer \"" + name + "\"; " + meant_layer(name, names_of(layers))) +
               "layers with R,G,B: " + list(layers);
    const auto grey = layers.empty() ? grey_picture(spec) : std::vector<Layer>{};
    if (layers.size() == 1 || !grey.empty())
        return data_text(spec, layers.empty() ? grey[0] : layers[0]);
    if (layers.empty())
        return "needs R,G,B, but the image has " + std::to_string(spec.nchannels) +
               " channel(s): " + list_channels(spec);
    return "no plain R,G,B and no layer that is obviously the beauty; pass layer= one of: " +
           list(layers);
}

// Refuses channels that are not one colour, or no colour at all.
void check_usable(const OIIO::ImageSpec& spec, const Layer& layer) {
    if (layer.twice)
        throw Refusal("layer " + layer.shown() +
                      " has a colour twice, in two spellings: " + list_channels(spec));
    for (int c = 0; c < 3; ++c) {
        const OIIO::TypeDesc type = spec.channelformat(layer.channel[c]);
        if (!type.is_floating_point() && type.size() > 2)
            throw Refusal("channel " + std::string(spec.channel_name(layer.channel[c])) + " is " +
                          type.c_str() +
                          ": numbers of objects, not a colour; valid: half, float, double, "
                          "8 and 16 bit integers");
    }
}

} // namespace

bool is_data_name(const std::string& layer) {
    return kind_of_layer(split_layer(layer).layer_name) != AovKind::Light;
}

bool is_beauty_name(const std::string& layer) {
    const std::string pass = pass_name(layer);
    return std::find(std::begin(kBeautyNames), std::end(kBeautyNames), pass) !=
           std::end(kBeautyNames);
}

bool holds_only_data(const OIIO::ImageSpec& spec) {
    const auto layers = find_layers(spec);
    const auto grey = grey_picture(spec);
    return std::none_of(layers.begin(), layers.end(), is_picture) &&
           (!layers.empty() || grey.empty() || !is_grey_picture(spec, grey[0]));
}

ColorChoice chosen_channels(const OIIO::ImageSpec& spec, const std::string& name) {
    const auto layers = find_layers(spec);
    auto found = name.empty() ? beauty(spec, layers) : named(layers, name);
    if (found.empty() && !name.empty())
        found = of_part(spec, layers, name);
    if (found.empty() && !name.empty())
        found = named_grey(spec, name);
    if (found.empty())
        throw Refusal(no_layer_text(spec, layers, name));
    if (found.size() > 1)
        throw Refusal(std::to_string(found.size()) + " layers could be meant: " + list(found) +
                      "; pass layer= one of them");
    const Layer& layer = found[0];
    check_usable(spec, layer);
    ColorChoice choice;
    choice.r = layer.channel[0];
    choice.g = layer.channel[1];
    choice.b = layer.channel[2];
    choice.a = layer.channel[3];
    choice.layer = layer.name;
    return choice;
}

std::vector<std::string> ToneAlgo::color_layers(const OIIO::ImageSpec& spec) {
    std::vector<std::string> names;
    for (const Layer& layer : find_layers(spec))
        names.push_back(layer.shown());
    return names;
}

} // namespace tonetool
