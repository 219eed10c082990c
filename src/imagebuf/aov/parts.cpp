// SPDX-License-Identifier: BSD-3-Clause
// Chooses the part (subimage) of a file that holds several images.
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/aov/channels.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/layer_name.h"
#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"
#include "tonetool/parts.h"

namespace tonetool {
namespace {

using OIIO::ImageSpec;

// A layer with colour of one of the parts.
struct Picture {
    int part = 0;
    std::string name;  ///< the layer's, or where its channels are called R, G, B the part's
    std::string shown; ///< what layer= chooses it by
    std::string view;
    bool data = false, beauty = false;
};

bool is_eye(const std::string& word) {
    return word == "left" || word == "right";
}

// The views that a file of one part names, the default first.
std::vector<std::string> listed_views(const ImageSpec& spec) {
    std::vector<std::string> views;
    const OIIO::ParamValue* list = spec.find_attribute("multiView");
    const bool texts = list && list->type().basetype == OIIO::TypeDesc::STRING;
    const int count = texts ? int(list->type().basevalues()) : 0;
    for (int i = 0; i < count; ++i)
        views.emplace_back(list->get_string_indexed(i));
    return views;
}

// "right" of "right", "diffuse.right" or "rgba_right".
std::string view_in_name(const std::string& name, const std::vector<std::string>& views) {
    std::vector<std::string> words;
    OIIO::Strutil::split(OIIO::Strutil::replace(name, "_", ".", true), words, ".");
    for (const std::string& word : words)
        if (is_eye(lower(word)) || std::count(views.begin(), views.end(), word) > 0)
            return lower(word);
    return "";
}

// Without the word of the view: "rgba" of "rgba_right", "" of "right".
std::string without_view(const std::string& name, const std::string& view) {
    std::vector<std::string> words, kept;
    OIIO::Strutil::split(OIIO::Strutil::replace(name, "_", ".", true), words, ".");
    for (const std::string& word : words)
        if (view.empty() || lower(word) != view)
            kept.push_back(word);
    return kept.size() == words.size() ? name : OIIO::Strutil::join(kept, ".");
}

Picture picture_of(const ImageSpec& spec, int part, const std::string& layer) {
    const std::vector<std::string> views = listed_views(spec);
    const bool plain = layer == kPlainLayer;
    Picture picture;
    picture.part = part;
    picture.name = plain ? std::string(spec.get_string_attribute("oiio:subimagename")) : layer;
    picture.shown = picture.name.empty() ? layer : picture.name;
    picture.view = lower(std::string(spec.get_string_attribute("view")));
    if (picture.view.empty())
        picture.view = view_in_name(picture.name, views);
    if (picture.view.empty() && !views.empty())
        picture.view = lower(views.front());
    const std::string name = without_view(picture.name, picture.view);
    picture.data = is_data_name(name);
    picture.beauty = name.empty() || is_beauty_name(name);
    return picture;
}

std::vector<Picture> pictures_of(const std::vector<ImageSpec>& parts) {
    std::vector<Picture> all;
    for (size_t i = 0; i < parts.size(); ++i)
        for (const std::string& layer : ToneAlgo::color_layers(parts[i]))
            all.push_back(picture_of(parts[i], int(i), layer));
    return all;
}

std::vector<std::string> names_of(const std::vector<Picture>& pictures) {
    std::vector<std::string> names;
    for (const Picture& one : pictures)
        if (std::find(names.begin(), names.end(), one.shown) == names.end())
            names.push_back(one.shown);
    return names;
}

std::string list(const std::vector<Picture>& pictures) {
    return pictures.empty() ? "none" : OIIO::Strutil::join(names_of(pictures), ", ");
}

// How well a part answers to a name: 3 exactly, 2 in any case, 1 by its view or the last part of a
// layer's name, 0 not at all.
int rank_of(const ImageSpec& spec, const std::string& name) {
    ColorChoice ignored;
    std::string untold;
    if (!ToneAlgo::find_color(spec, {name, ""}, ignored, untold))
        return 0;
    std::vector<std::string> names = ToneAlgo::color_layers(spec);
    names.emplace_back(spec.get_string_attribute("oiio:subimagename"));
    const auto fits = [&](const auto& test) {
        return std::any_of(names.begin(), names.end(), test);
    };
    if (fits([&](const std::string& one) { return one == name; }))
        return 3;
    return fits([&](const std::string& one) { return lower(one) == lower(name); }) ? 2 : 1;
}

// Parts of one view that all answer to its name: its beauty.
std::vector<int> beauties_of(const std::vector<Picture>& pictures, const std::vector<int>& parts) {
    std::vector<int> found;
    for (const Picture& one : pictures)
        if (one.beauty && !one.data &&
            std::find(parts.begin(), parts.end(), one.part) != parts.end() &&
            std::find(found.begin(), found.end(), one.part) == found.end())
            found.push_back(one.part);
    return found.size() == 1 ? found : parts;
}

int find_named(const std::vector<ImageSpec>& parts, const PixelOptions& options,
               const std::vector<Picture>& pictures) {
    int best = 1;
    std::vector<int> found;
    for (size_t i = 0; i < parts.size(); ++i) {
        const int rank = rank_of(parts[i], options.layer);
        if (rank > best)
            found.clear();
        best = std::max(best, rank);
        if (rank == best)
            found.push_back(int(i));
    }
    found = beauties_of(pictures, found);
    if (found.empty())
        throw Refusal("no colour layer or part \"" + options.layer + "\"; " +
                      meant_layer(options.layer, names_of(pictures)) +
                      "there are: " + list(pictures));
    if (found.size() > 1)
        throw Refusal(std::to_string(found.size()) + " parts could be meant by layer=" +
                      options.layer + "; there are: " + list(pictures));
    return found[0];
}

// The first of the pictures that `fits`, or null.
template <class Test>
const Picture* first(const std::vector<Picture>& pictures, const Test& fits) {
    const auto found = std::find_if(pictures.begin(), pictures.end(), fits);
    return found == pictures.end() ? nullptr : &*found;
}

PartChoice chosen_part(const std::vector<ImageSpec>& parts, const PixelOptions& options) {
    PartChoice choice;
    const std::vector<Picture> pictures = pictures_of(parts);
    if (!options.layer.empty() && parts.size() > 1)
        choice.part = find_named(parts, options, pictures);
    if (!options.layer.empty() || pictures.empty())
        return choice; // find_color() says what the only part, or the first, lacks
    const Picture* chosen =
        first(pictures, [](const Picture& one) { return one.beauty && !one.data; });
    if (!chosen)
        chosen = first(pictures, [](const Picture& one) { return !one.data; });
    if (!chosen && parts.size() > 1)
        throw Refusal("no part that is not data by its name; pass layer= one of: " +
                      list(pictures));
    if (!chosen)
        return choice;
    choice.part = chosen->part;
    choice.picture = chosen->shown;
    for (const Picture& one : pictures)
        if (!one.data && (one.part != chosen->part || one.view != chosen->view))
            choice.left_out.push_back(one.shown);
    return choice;
}

} // namespace

namespace ToneAlgo {

bool find_part(const std::vector<ImageSpec>& parts, const PixelOptions& options, PartChoice& choice,
               std::string& error) {
    choice = {};
    return contained(error, [&] { choice = chosen_part(parts, options); });
}

} // namespace ToneAlgo
} // namespace tonetool
