// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/qc/qc_header.h"

#include <OpenImageIO/hash.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <set>

#include "imagebuf/pixels/planes.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;

// Longer values of metadata (manifests, transforms of thousands of objects) are kept as a hash.
constexpr size_t kLongest = 120;
constexpr int kElements = 4096;

std::string kept_value(const std::string& value) {
    if (value.size() <= kLongest)
        return value;
    OIIO::SHA1 hash(value.data(), value.size());
    return OIIO::Strutil::fmt::format("{} characters, SHA-1 {}", value.size(), hash.digest());
}

// What the name tells of a layer that is neither the picture nor light; "" if no more than that.
const char* kind_by_name(const AovLayer& layer) {
    switch (layer.has_lone_z() ? AovKind::Depth : kind_of_layer(layer.layer_name)) {
    case AovKind::Depth:
        return "depth";
    case AovKind::Position:
        return layer.triple() ? "position" : "";
    case AovKind::Normal:
        return layer.triple() ? "normal" : "";
    case AovKind::Albedo:
        return layer.has_rgb() ? "albedo" : "";
    case AovKind::Motion:
        return "motion";
    case AovKind::Id:
        return "id";
    default:
        return "";
    }
}

} // namespace

std::string fingerprint(const void* data, size_t bytes) {
    const auto hash = OIIO::farmhash::Fingerprint128(static_cast<const char*>(data), bytes);
    return OIIO::Strutil::fmt::format("{:016x}{:016x}", hash.first, hash.second);
}

QcPart part_facts(const ImageBuf& image) {
    const ImageSpec& spec = image.spec();
    QcPart part;
    part.name = part_name(spec);
    part.data = {spec.x, spec.y, spec.width, spec.height};
    part.display = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
    part.compression = spec.get_string_attribute("compression");
    for (const OIIO::ParamValue& value : spec.extra_attribs) {
        const std::string name(value.name().string());
        if (name != "compression")
            part.metadata[name] = kept_value(value.get_string(kElements));
    }
    return part;
}

ImageSpec joined_spec(const std::vector<const ImageBuf*>& parts) {
    ImageSpec joined = deciding_spec(*parts.front());
    std::set<std::string> taken(joined.channelnames.begin(), joined.channelnames.end());
    for (size_t p = 1; p < parts.size(); ++p) {
        const ImageSpec& spec = parts[p]->spec();
        const std::string numbered = "part" + std::to_string(p);
        for (const std::string& own : spec.channelnames) {
            std::string name = own;
            if (taken.count(name) > 0 || name.find('.') == std::string::npos)
                name = (part_name(spec).empty() ? numbered : part_name(spec)) + "." + own;
            if (!taken.insert(name).second)
                name = numbered + "." + name;
            joined.channelnames.push_back(name);
        }
    }
    joined.nchannels = int(joined.channelnames.size());
    joined.channelformats.clear();
    return joined;
}

std::vector<std::pair<std::string, std::string>>
channel_facts(const ImageSpec& joined, const std::vector<const ImageBuf*>& parts) {
    std::vector<std::pair<std::string, std::string>> channels;
    for (const ImageBuf* part : parts) {
        const bool native = part->nativespec().nchannels == part->nchannels();
        const ImageSpec& spec = native ? part->nativespec() : part->spec();
        for (int c = 0; c < spec.nchannels; ++c)
            channels.emplace_back(joined.channelnames[channels.size()],
                                  spec.channelformat(c).c_str());
    }
    return channels;
}

std::string layer_kind(const AovLayer& layer, const ColorChoice& picture,
                       const std::vector<LightGroup>& groups) {
    const auto same = [&](const LightGroup& group) { return group.layer == layer.name; };
    if (std::find(layer.channels.begin(), layer.channels.end(), picture.r) != layer.channels.end())
        return "picture";
    if (std::any_of(groups.begin(), groups.end(), same))
        return "light";
    const char* kind = kind_by_name(layer);
    return *kind ? kind : layer.has_rgb() ? "color" : "data";
}

bool is_of_objects(const std::string& name) {
    return OIIO::Strutil::icontains(name, "object");
}

bool is_filtered(const std::string& name) {
    const std::string word = plain_word(name);
    const auto tells = [&](const char* part) { return word.find(part) != std::string::npos; };
    return tells("mist") || tells("denois") || tells("filtered");
}

bool is_exact(const std::string& kind, const std::string& name) {
    return (kind == "depth" || kind == "position" || kind == "id") && !is_filtered(name);
}

} // namespace tonetool
