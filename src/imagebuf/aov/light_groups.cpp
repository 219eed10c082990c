// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/light_groups.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/aov/aov_layers.h"
#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::starts_with;

// What follows the name of a picture and is no group of lights, as plain_word() makes it.
bool is_something_else(const std::string& group) {
    const std::string word = plain_word(group);
    for (const char* other : {"denois", "alpha", "noisy", "filtered", "raw"})
        if (starts_with(word, other))
            return true;
    return word.empty() || word == "a" || is_eye(word) || kind_of_layer(group) != AovKind::Light ||
           OIIO::Strutil::ends_with(word, "var");
}

// The group of "C_Key" for "c": what follows the prefix and one of "_ .-"; "" if it is another
// name.
std::string group_after(const std::string& layer_name, const std::string& prefix) {
    const size_t n = prefix.size();
    if (n == 0 || layer_name.size() < n + 2 || lower(layer_name.substr(0, n)) != lower(prefix) ||
        std::string("_ .-").find(layer_name[n]) == std::string::npos)
        return "";
    return layer_name.substr(n + 1);
}

std::vector<LightGroup> family(const std::vector<AovLayer>& layers, const std::string& view_layer,
                               const std::string& prefix) {
    std::vector<LightGroup> groups;
    for (const AovLayer& layer : layers) {
        if (!layer.has_rgb() || layer.plain)
            continue;
        std::string group;
        if (layer.view_layer == view_layer)
            group = group_after(layer.layer_name, prefix);
        else if (view_layer.empty()) // "RGBA.key"
            group = group_after(layer.name, prefix);
        if (group.empty() || is_something_else(group))
            continue;
        groups.push_back({group, layer.name, {layer.rgb[0], layer.rgb[1], layer.rgb[2]}});
    }
    return groups;
}

} // namespace

std::vector<LightGroup> find_light_groups(const OIIO::ImageSpec& spec, const std::string& beauty) {
    const std::vector<AovLayer> layers = aov_layers(spec);
    const auto [view_layer, own] = split_layer(beauty);
    // Blender; Arnold; Karma; RenderMan and MoonRay by custom; V-Ray; Octane; by custom.
    for (const std::string& prefix :
         {own, std::string("combined"), std::string("rgba"), std::string("c"), std::string("ci"),
          std::string("beauty"), std::string("lightselect"), std::string("vraylightselect"),
          std::string("lightmix"), std::string("light id"), std::string("lightgroup"),
          std::string("light"), std::string("lg")}) {
        auto groups = family(layers, view_layer, prefix);
        if (!groups.empty())
            return groups;
    }
    return {};
}

std::vector<LightGroup> choose_light_groups(const OIIO::ImageSpec& spec, const std::string& beauty,
                                            const std::vector<std::string>& names) {
    std::vector<LightGroup> known = find_light_groups(spec, beauty), groups;
    if (names.empty())
        return known;
    for (const AovLayer& layer : aov_layers(spec))
        if (layer.has_rgb() && !layer.plain)
            known.push_back(
                {layer.layer_name, layer.name, {layer.rgb[0], layer.rgb[1], layer.rgb[2]}});
    for (const std::string& name : names) {
        const auto is = [&](const LightGroup& g) { return g.name == name || g.layer == name; };
        const auto it = std::find_if(known.begin(), known.end(), is);
        if (it == known.end()) {
            std::vector<std::string> valid;
            for (const LightGroup& group : known)
                valid.push_back(group.name);
            throw Refusal(unknown_name("light group", name, valid));
        }
        const auto same = [&](const LightGroup& g) { return g.layer == it->layer; };
        if (std::any_of(groups.begin(), groups.end(), same))
            throw Refusal("light group \"" + name + "\" is given twice");
        groups.push_back(*it);
    }
    return groups;
}

} // namespace tonetool
