// SPDX-License-Identifier: BSD-3-Clause
// The structure of a file compared with that of its approved version, from the headers alone.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "imagebuf/pixels/layer_name.h"
#include "imagebuf/pixels/names.h"
#include "sequence/against/against_record.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;
using Names = std::vector<std::string>;
using Differences = std::vector<AgainstDifference>;

const AgainstName* other_of(const AgainstFile& file, const AgainstName& layer) {
    return layer.other < 0 ? nullptr : &file.layers.at(size_t(layer.other));
}

std::string last_word(const std::string& channel) {
    return lower(channel.substr(channel.rfind('.') + 1));
}

std::set<std::string> last_words(const Names& channels) {
    std::set<std::string> words;
    for (const std::string& channel : channels)
        words.insert(last_word(channel));
    return words;
}

std::string listed(const std::set<std::string>& names) {
    return OIIO::Strutil::join(Names(names.begin(), names.end()), ",");
}

void compare_layers(const AgainstFile& approved, const AgainstFile& file, Differences& out) {
    for (const AgainstName& layer : approved.layers) {
        const AgainstName* found = other_of(file, layer);
        if (!found) {
            out.push_back(
                {"layermissing", layer.name,
                 "layer " + shown_layer(layer.name) + " of the approved version is missing",
                 Severity::Error});
            continue;
        }
        const std::set<std::string> theirs = last_words(layer.channels);
        const std::set<std::string> ours = last_words(found->channels);
        if (theirs != ours) {
            out.push_back({"channels", layer.name,
                           format("layer {} has the channels {}, approved are {}",
                                  shown_layer(layer.name), listed(ours), listed(theirs)),
                           Severity::Error});
        }
    }
    for (const AgainstName& layer : file.layers)
        if (layer.other < 0)
            out.push_back({"layerextra", layer.name,
                           "layer " + shown_layer(layer.name) + " is not in the approved version",
                           Severity::Warning});
}

void compare_windows(const AgainstFile& approved, const AgainstFile& file, Differences& out) {
    const QcPart &theirs = approved.parts.front(), &ours = file.parts.front();
    if (theirs.display != ours.display) {
        out.push_back({"displaywindow", "",
                       format("the display window is {}, approved is {}", window_text(ours.display),
                              window_text(theirs.display)),
                       Severity::Error});
    }
}

using Window = std::array<int, 4>;

// The windows of the parts that a layer has in both files.
struct Windows {
    Window theirs, ours;
    bool operator<(const Windows& o) const {
        return std::tie(theirs, ours) < std::tie(o.theirs, o.ours);
    }
};

// The data windows of parts that are not the first, whose window is judged over the shot. A new one
// that holds the approved one is milder.
void compare_parts(const AgainstFile& approved, const AgainstFile& file, Differences& out) {
    std::map<Windows, Names> layers;
    for (const AgainstName& layer : approved.layers) {
        const AgainstName* found = other_of(file, layer);
        if (!found)
            continue;
        const Windows windows{approved.parts.at(size_t(layer.part)).data,
                              file.parts.at(size_t(found->part)).data};
        const bool first = windows.theirs == approved.parts.front().data &&
                           windows.ours == file.parts.front().data;
        if (windows.theirs != windows.ours && !first)
            layers[windows].push_back(shown_layer(layer.name));
    }
    for (const auto& [windows, names] : layers) {
        const Window &a = windows.theirs, &b = windows.ours;
        const bool holds = b[0] <= a[0] && b[1] <= a[1] && b[0] + b[2] >= a[0] + a[2] &&
                           b[1] + b[3] >= a[1] + a[3];
        out.push_back({"datawindow", "",
                       format("the data window of {} is {}, approved is {}",
                              OIIO::Strutil::join(names, ", "), window_text(b), window_text(a)),
                       holds ? Severity::Warning : Severity::Error});
    }
}

using Types = std::map<std::string, std::string>;

bool is_data(const std::string& kind) {
    return kind == "position" || kind == "depth" || kind == "id" || kind == "vector";
}

// The types, approved and new, of the first channel of a layer that has another.
std::optional<std::pair<std::string, std::string>> other_types(const AgainstName& layer,
                                                               const Types& theirs,
                                                               const AgainstName& found,
                                                               const Types& ours) {
    for (const std::string& channel : layer.channels) {
        const auto a = theirs.find(channel);
        for (const std::string& other : found.channels) {
            const auto b = ours.find(other);
            if (last_word(channel) == last_word(other) && a != theirs.end() && b != ours.end() &&
                a->second != b->second)
                return std::make_pair(a->second, b->second);
        }
    }
    return std::nullopt;
}

// The types of layers that both have; a layer is told once.
void compare_types(const AgainstFile& approved, const AgainstFile& file, Differences& out) {
    const Types theirs(approved.channels.begin(), approved.channels.end());
    const Types ours(file.channels.begin(), file.channels.end());
    std::map<std::pair<std::string, std::string>, Names> layers[2]; // by types: colours, data
    for (const AgainstName& layer : approved.layers) {
        const AgainstName* found = other_of(file, layer);
        const auto types = found ? other_types(layer, theirs, *found, ours) : std::nullopt;
        if (!types)
            continue;
        const bool lost = is_data(layer.kind) && types->first == "float" && types->second == "half";
        layers[lost ? 1 : 0][*types].push_back(shown_layer(layer.name));
    }
    for (const size_t lost : {size_t(1), size_t(0)})
        for (const auto& [types, names] : layers[lost])
            out.push_back({"type", "",
                           format("{} {} {}, approved {} {}{}", OIIO::Strutil::join(names, ", "),
                                  names.size() == 1 ? "is" : "are", types.second,
                                  names.size() == 1 ? "is" : "are", types.first,
                                  lost ? ": data needs all of its digits" : ""),
                           lost ? Severity::Error : Severity::Warning});
}

bool is_lossy(const std::string& compression) {
    const std::string name = compression.substr(0, compression.find(':'));
    return name == "dwaa" || name == "dwab" || name == "b44" || name == "b44a" || name == "pxr24" ||
           name == "jpeg";
}

void compare_compression(const AgainstFile& approved, const AgainstFile& file, Differences& out) {
    const std::string &theirs = approved.parts.front().compression,
                      &ours = file.parts.front().compression;
    if (theirs == ours)
        return;
    const bool lossy = is_lossy(ours) && !is_lossy(theirs);
    const auto shown = [](const std::string& name) { return name.empty() ? "none" : name; };
    out.push_back({"compression", "",
                   format("the compression is {}{}, approved is {}", shown(ours),
                          lossy ? ", which loses digits" : "", shown(theirs)),
                   lossy ? Severity::Error : Severity::Warning});
}

// What the headers of all parts say of a name, each value once.
std::string said(const AgainstFile& file, const std::string& name) {
    std::set<std::string> values;
    for (const QcPart& part : file.parts) {
        const auto found = part.metadata.find(name);
        if (found != part.metadata.end())
            values.insert(found->second);
    }
    return OIIO::Strutil::join(Names(values.begin(), values.end()), ", ");
}

// Numbers that are written in other ways are the same: 24, 24.0 and 24/1.
bool same_value(const std::string& name, std::string a, std::string b) {
    const auto number = [](const std::string& text) {
        const size_t slash = text.find('/');
        const double above = OIIO::Strutil::stod(text);
        const double below = slash == std::string::npos
                                 ? 1
                                 : OIIO::Strutil::stod(std::string(text.substr(slash + 1)));
        return below != 0 ? above / below : above;
    };
    if (name == "PixelAspectRatio") {
        a = a.empty() ? "1" : a;
        b = b.empty() ? "1" : b;
    }
    const bool numbers =
        name == "PixelAspectRatio" || name == "framesPerSecond" || name == "FramesPerSecond";
    const bool several = a.find(',') != std::string::npos || b.find(',') != std::string::npos;
    if (numbers && !several && !a.empty() && !b.empty())
        return std::abs(number(a) - number(b)) <= 1e-6 * std::abs(number(a));
    return a == b;
}

// By which renderers call the camera.
const char* const kCameras[] = {"camera", "Camera", "cameraName", "CameraName"};

bool is_camera(const std::string& name) {
    return std::find(std::begin(kCameras), std::end(kCameras), name) != std::end(kCameras);
}

// The names that must agree: those that are always meant, Cryptomatte's, and the user's.
std::set<std::string> header_names(const AgainstFile& approved, const AgainstFile& file,
                                   const Names& more) {
    std::set<std::string> names = {
        "PixelAspectRatio", "framesPerSecond", "FramesPerSecond", "view",
        "multiView",        "chromaticities",  "oiio:ColorSpace", "colorInteropID"};
    names.insert(std::begin(kCameras), std::end(kCameras));
    names.insert(more.begin(), more.end());
    for (const AgainstFile* side : {&approved, &file})
        for (const QcPart& part : side->parts)
            for (const auto& [name, value] : part.metadata)
                if (OIIO::Strutil::starts_with(name, "cryptomatte/") &&
                    (OIIO::Strutil::ends_with(name, "/hash") ||
                     OIIO::Strutil::ends_with(name, "/name") ||
                     OIIO::Strutil::ends_with(name, "/conversion")))
                    names.insert(name);
    return names;
}

void compare_headers(const AgainstFile& approved, const AgainstFile& file, const Names& more,
                     Differences& out) {
    const auto shown = [](const std::string& value) {
        return value.empty() ? std::string("not there") : "\"" + value + "\"";
    };
    for (const std::string& name : header_names(approved, file, more)) {
        const std::string theirs = said(approved, name), ours = said(file, name);
        if (!same_value(name, theirs, ours)) {
            out.push_back({"header", "",
                           format("{} is {}, approved is {}", name, shown(ours), shown(theirs)),
                           is_camera(name) ? Severity::Warning : Severity::Error});
        }
    }
}

// The objects of a manifest change with the scene. One that is gone leaves ids that nobody can
// name.
void compare_manifests(const AgainstFile& approved, const AgainstFile& file, Differences& out) {
    const auto names_objects = [](const std::string& manifest) {
        return manifest.find(':') != std::string::npos ||
               manifest.find(", SHA-1 ") != std::string::npos;
    };
    std::set<std::string> names;
    for (const QcPart& part : approved.parts)
        for (const auto& [name, value] : part.metadata)
            if (OIIO::Strutil::starts_with(name, "cryptomatte/") &&
                OIIO::Strutil::ends_with(name, "/manifest") && names_objects(value))
                names.insert(name);
    for (const std::string& name : names)
        if (!names_objects(said(file, name)))
            out.push_back({"header", "",
                           name + " names no object, that of the approved version does",
                           Severity::Error});
}

} // namespace

AgainstRecord record_of(const AgainstFacts& facts, const Names& headers) {
    AgainstRecord record;
    record.approved_data = facts.approved.parts.front().data;
    record.data = facts.file.parts.front().data;
    record.approved_moment = facts.approved.moment;
    record.moment = facts.file.moment;
    record.layers = facts.layers;
    compare_layers(facts.approved, facts.file, record.differences);
    compare_windows(facts.approved, facts.file, record.differences);
    compare_parts(facts.approved, facts.file, record.differences);
    compare_types(facts.approved, facts.file, record.differences);
    compare_compression(facts.approved, facts.file, record.differences);
    compare_headers(facts.approved, facts.file, headers, record.differences);
    compare_manifests(facts.approved, facts.file, record.differences);
    return record;
}

} // namespace tonetool::sequence
