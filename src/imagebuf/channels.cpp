// Which channels of an image are its colour.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <map>

#include "imagebuf/color_names.h"
#include "imagebuf/colorimetry.h"
#include "include/tonetool/pixels.h"

namespace tonetool {
namespace {

using OIIO::Strutil::lower;

constexpr const char* kPlain = "R,G,B";

// What renderers call the final picture, and what is a measurement even though it has R, G, B;
// compared in lower case without spaces, '_' and '-'.
constexpr const char* kBeautyNames[] = {"combined", "rgba",  "rgb",        "c",     "ci",
                                        "beauty",   "color", "finalimage", "final", "image"};
constexpr const char* kDataNames[] = {"p",      "pworld",  "position",        "worldposition",
                                      "n",      "normal",  "normals",         "nworld",
                                      "albedo", "diffcol", "basecolor",       "uv",
                                      "st",     "motion",  "vector",          "motionvector",
                                      "depth",  "z",       "denoisingalbedo", "denoisingnormal"};

template <size_t N>
bool is_one_of(const std::string& name, const char* const (&list)[N]) {
    return std::find(std::begin(list), std::end(list), name) != std::end(list);
}

// 0..3 for R, G, B, A in either case or written out, -1 for any other component.
int component(const std::string& name) {
    const std::string n = lower(name);
    constexpr const char* names[4][2] = {
        {"r", "red"}, {"g", "green"}, {"b", "blue"}, {"a", "alpha"}};
    for (int i = 0; i < 4; ++i)
        if (n == names[i][0] || n == names[i][1])
            return i;
    return -1;
}

struct Layer {
    std::string name; // "" for plain R,G,B
    int channel[4] = {-1, -1, -1, -1};
    bool twice = false; // a colour is there in two spellings, "R" and "red"
    bool has_color() const { return channel[0] >= 0 && channel[1] >= 0 && channel[2] >= 0; }
    std::string shown() const { return name.empty() ? kPlain : name; }
};

// In the order of the file.
std::vector<Layer> find_layers(const OIIO::ImageSpec& spec) {
    std::vector<Layer> layers;
    for (int i = 0; i < spec.nchannels; ++i) {
        const std::string full = spec.channel_name(i);
        const auto dot = full.rfind('.');
        const std::string prefix = dot == std::string::npos ? "" : full.substr(0, dot);
        const int c = component(dot == std::string::npos ? full : full.substr(dot + 1));
        if (c < 0)
            continue;
        auto at = std::find_if(layers.begin(), layers.end(),
                               [&](const Layer& l) { return l.name == prefix; });
        if (at == layers.end())
            at = layers.insert(layers.end(), Layer{prefix, {-1, -1, -1, -1}, false});
        at->twice = at->twice || (c < 3 && at->channel[c] >= 0);
        if (at->channel[c] < 0)
            at->channel[c] = i;
    }
    layers.erase(
        std::remove_if(layers.begin(), layers.end(), [](const Layer& l) { return !l.has_color(); }),
        layers.end());
    return layers;
}

// The pass name of "ViewLayer.Denoising Normal": "denoisingnormal".
std::string pass_name(const std::string& layer) {
    const auto dot = layer.rfind('.');
    std::string name = lower(dot == std::string::npos ? layer : layer.substr(dot + 1));
    name.erase(std::remove_if(name.begin(), name.end(),
                              [](char c) { return c == ' ' || c == '_' || c == '-'; }),
               name.end());
    return name;
}

bool is_data(const Layer& layer) {
    return is_data_name(layer.name);
}

std::string list(const std::vector<Layer>& layers) {
    if (layers.empty())
        return "none";
    std::vector<std::string> names;
    for (const Layer& layer : layers)
        names.push_back(layer.shown());
    return OIIO::Strutil::join(names, ", ");
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
        if (layer.shown() == name)
            exact.push_back(layer);
        if (lower(layer.shown()) == lower(name))
            any_case.push_back(layer);
        if (!layer.name.empty() && pass_name(layer.name) == pass_name(name) &&
            name.find('.') == std::string::npos)
            last_part.push_back(layer);
    }
    return !exact.empty() ? exact : !any_case.empty() ? any_case : last_part;
}

// The one picture of the file.
std::vector<Layer> beauty(const std::vector<Layer>& layers) {
    auto plain = only(layers, [](const Layer& l) { return l.name.empty(); });
    if (!plain.empty())
        return plain;
    auto beauties = only(layers, [](const Layer& l) { return is_beauty_name(l.name); });
    if (!beauties.empty())
        return beauties;
    // A file with one layer in all is about that layer, unless its name says data.
    return layers.size() == 1 && !is_data(layers[0]) ? layers : std::vector<Layer>{};
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
    const auto found = beauty(layers);
    return found.empty() && layers.size() == 1 ? layers : found;
}

std::string no_layer_text(const OIIO::ImageSpec& spec, const std::vector<Layer>& layers,
                          const PixelOptions& options) {
    if (!options.layer.empty())
        return "no colour layer \"" + options.layer + "\"; layers with R,G,B: " + list(layers);
    if (layers.empty())
        return "needs R,G,B, but the image has " + std::to_string(spec.nchannels) +
               " channel(s): " + list_channels(spec);
    return "no plain R,G,B and no layer that is obviously the beauty; pass layer= one of: " +
           list(layers);
}

// Whether the channels are one colour, and a colour at all.
bool usable(const OIIO::ImageSpec& spec, const Layer& layer, std::string& error) {
    if (layer.twice) {
        error = "layer " + layer.shown() +
                " has a colour twice, in two spellings: " + list_channels(spec);
        return false;
    }
    for (int c = 0; c < 3; ++c) {
        const OIIO::TypeDesc type = spec.channelformat(layer.channel[c]);
        if (!type.is_floating_point() && type.size() > 2) {
            error = "channel " + std::string(spec.channel_name(layer.channel[c])) + " is " +
                    type.c_str() +
                    ": numbers of objects, not a colour; valid: half, float, double, "
                    "8 and 16 bit integers";
            return false;
        }
    }
    return true;
}

} // namespace

bool is_data_name(const std::string& layer) {
    const std::string pass = pass_name(layer);
    return is_one_of(pass, kDataNames) || OIIO::Strutil::starts_with(pass, "crypto");
}

bool is_beauty_name(const std::string& layer) {
    return is_one_of(pass_name(layer), kBeautyNames);
}

namespace ToneAlgo {

bool find_color(const OIIO::ImageSpec& spec, const PixelOptions& options, ColorChoice& choice,
                std::string& error) {
    const auto layers = find_layers(spec);
    auto found = options.layer.empty() ? beauty(layers) : named(layers, options.layer);
    if (found.empty() && !options.layer.empty())
        found = of_part(spec, layers, options.layer);
    if (found.empty()) {
        error = no_layer_text(spec, layers, options);
        return false;
    }
    if (found.size() > 1) {
        error = std::to_string(found.size()) + " layers could be meant: " + list(found) +
                "; pass layer= one of them";
        return false;
    }
    const Layer& layer = found[0];
    if (!usable(spec, layer, error))
        return false;
    choice = {};
    choice.r = layer.channel[0];
    choice.g = layer.channel[1];
    choice.b = layer.channel[2];
    choice.a = layer.channel[3];
    choice.layer = layer.name;
    ColorSpace space;
    if (!find_space(spec, options.from, space, error))
        return false;
    choice.space = space.name;
    choice.display_encoded = space.srgb_encoded;
    return true;
}

std::vector<std::string> color_layers(const OIIO::ImageSpec& spec) {
    std::vector<std::string> names;
    for (const Layer& layer : find_layers(spec))
        names.push_back(layer.shown());
    return names;
}

} // namespace ToneAlgo
} // namespace tonetool
