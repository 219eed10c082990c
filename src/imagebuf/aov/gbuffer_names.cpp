// SPDX-License-Identifier: BSD-3-Clause
// Which layers of an image are the guides, by the names renderers give them.
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/aov/aov_layers.h"
#include "imagebuf/aov/gbuffer.h"
#include "imagebuf/pixels/layer_name.h"
#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageSpec;
using OIIO::Strutil::starts_with;
using Layers = std::vector<const AovLayer*>;

enum Guide { Position, Normal, Albedo, Depth, kGuides };
constexpr const char* kGuideNames[kGuides] = {"position", "normal", "albedo", "depth"};

constexpr AovKind kKinds[kGuides] = {AovKind::Position, AovKind::Normal, AovKind::Albedo,
                                     AovKind::Depth};
constexpr int kWeakRank = 100, kNoRank = 1000;

bool is_vray(const ImageSpec& spec, const std::vector<AovLayer>& layers) {
    const auto says_so = [](const OIIO::ParamValue& p) {
        return starts_with(lower(p.name().string()), "vray");
    };
    const auto is_named_so = [](const AovLayer& l) {
        return starts_with(l.pass, "vray") || starts_with(l.pass, "lightselect");
    };
    const std::string software = plain_word(spec.get_string_attribute("Software"));
    return software.find("vray") != std::string::npos ||
           std::any_of(spec.extra_attribs.begin(), spec.extra_attribs.end(), says_so) ||
           std::any_of(layers.begin(), layers.end(), is_named_so);
}

bool usable(Guide guide, const AovLayer& layer) {
    return guide == Depth ? layer.scalar() >= 0 : layer.triple() != nullptr;
}

// 0 for the best name, kNoRank for none of this guide.
int rank_of(Guide guide, const AovLayer& layer, bool vray) {
    const bool plain_z = guide == Depth && layer.plain && layer.has_lone_z();
    const std::string pass = plain_z ? "z" : bare_pass(layer.pass);
    if (!usable(guide, layer) || (guide == Albedo && pass == "diffuse" && !vray))
        return kNoRank;
    const auto& passes = guide_passes(kKinds[guide]);
    const auto at = std::find(passes.begin(), passes.end(), pass);
    if (at != passes.end())
        return int(at - passes.begin());
    // A Z among the colours of a picture, and Mitsuba's distance, which the user named.
    const bool beside_color = layer.has_rgb() && layer.has_lone_z();
    return guide == Depth && (beside_color || layer.t >= 0) ? kWeakRank : kNoRank;
}

// How a layer is called in texts: the plain Z of an image by its channel.
std::string shown(Guide guide, const AovLayer& layer, const ImageSpec& spec) {
    if (layer.plain && guide == Depth)
        return std::string(spec.channel_name(layer.scalar()));
    return shown_layer(layer.name);
}

struct Finder {
    const ImageSpec& spec;
    std::vector<AovLayer> layers;
    bool vray = false;
    std::string view_layer;

    std::string show(Guide guide, const Layers& list) const {
        std::vector<std::string> names;
        for (const AovLayer* layer : list)
            names.push_back(shown(guide, *layer, spec));
        return OIIO::Strutil::join(names, ", ");
    }

    Layers best(Guide guide, const std::string& of_view_layer) const {
        Layers out;
        int lowest = kNoRank;
        for (const AovLayer& layer : layers) {
            const int rank =
                layer.view_layer == of_view_layer ? rank_of(guide, layer, vray) : kNoRank;
            if (rank < lowest)
                out.clear();
            lowest = std::min(lowest, rank);
            if (rank == lowest && rank < kNoRank)
                out.push_back(&layer);
        }
        return out;
    }

    int guides_of(const std::string& of_view_layer) const {
        int count = 0;
        for (int guide = 0; guide < kGuides; ++guide)
            count += !best(Guide(guide), of_view_layer).empty();
        return count;
    }

    void find_view_layer(const GuideOptions& options, std::vector<std::string>& notes);
    const AovLayer* named(Guide guide, const std::string& name) const;
};

// Guides of another view layer are of another geometry: all come from one. The picture's is the
// one; without guides there, that with the most of them.
void Finder::find_view_layer(const GuideOptions& options, std::vector<std::string>& notes) {
    const bool plain_picture = std::any_of(
        layers.begin(), layers.end(), [](const AovLayer& l) { return l.plain && l.has_rgb(); });
    view_layer = split_layer(options.beauty).view_layer;
    if ((!options.beauty.empty() || plain_picture) && guides_of(view_layer) > 0)
        return;
    std::vector<std::string> view_layers;
    for (const AovLayer& layer : layers)
        if (guides_of(layer.view_layer) > 0 && std::find(view_layers.begin(), view_layers.end(),
                                                         layer.view_layer) == view_layers.end())
            view_layers.push_back(layer.view_layer);
    if (view_layers.empty())
        return;
    view_layer = *std::max_element(
        view_layers.begin(), view_layers.end(),
        [&](const auto& a, const auto& b) { return guides_of(a) < guides_of(b); });
    if (view_layers.size() > 1)
        notes.push_back(std::to_string(view_layers.size()) +
                        " view layers have guides; those of \"" + view_layer + "\" are taken");
}

// A layer by its full name, in any case, or by its last part.
const AovLayer* Finder::named(Guide guide, const std::string& name) const {
    Layers exact, any_case, by_pass, in_view_layer;
    std::vector<std::string> valid;
    for (const AovLayer& layer : layers) {
        if (!usable(guide, layer))
            continue;
        const std::string full = shown(guide, layer, spec);
        valid.push_back(full);
        if (full == name)
            exact.push_back(&layer);
        if (lower(full) == lower(name))
            any_case.push_back(&layer);
        if (!layer.pass.empty() && layer.pass == plain_word(name))
            by_pass.push_back(&layer);
    }
    const Layers& all = !exact.empty() ? exact : !any_case.empty() ? any_case : by_pass;
    std::copy_if(all.begin(), all.end(), std::back_inserter(in_view_layer),
                 [&](const AovLayer* layer) { return layer->view_layer == view_layer; });
    const Layers& list = all.size() > 1 && !in_view_layer.empty() ? in_view_layer : all;
    const std::string what = std::string(kGuideNames[guide]) + " layer";
    if (list.empty())
        throw Refusal(unknown_name(what, name, valid));
    if (list.size() > 1)
        throw Refusal(what + " \"" + name + "\" could be one of " + show(guide, list) +
                      "; pass one of them");
    return list[0];
}

GuideChannels channels_of(Guide guide, const AovLayer& layer, const ImageSpec& spec) {
    GuideChannels out;
    out.layer = shown(guide, layer, spec);
    if (guide == Depth)
        out.channel[0] = layer.scalar();
    else
        std::copy_n(layer.triple(), 3, out.channel);
    return out;
}

} // namespace

GBufferNames find_gbuffer(const ImageSpec& spec, const GuideOptions& options) {
    GBufferNames names;
    Finder finder{spec, aov_layers(spec), false, ""};
    finder.vray = is_vray(spec, finder.layers);
    finder.find_view_layer(options, names.notes);
    const std::string* wanted[kGuides] = {&options.position, &options.normal, &options.albedo,
                                          &options.depth};
    std::optional<GuideChannels>* out[kGuides] = {&names.position, &names.normal, &names.albedo,
                                                  &names.depth};
    for (int i = 0; i < kGuides; ++i) {
        const auto guide = Guide(i);
        const AovLayer* found = nullptr;
        if (*wanted[i] == "none")
            continue;
        if (!wanted[i]->empty()) {
            found = finder.named(guide, *wanted[i]);
        } else if (const Layers best = finder.best(guide, finder.view_layer); !best.empty()) {
            found = best[0];
            if (best.size() > 1)
                names.notes.push_back(std::string(kGuideNames[i]) + " could be one of " +
                                      finder.show(guide, best) + "; the first is taken");
        }
        if (found)
            *out[i] = channels_of(guide, *found, spec);
    }
    return names;
}

} // namespace tonetool
