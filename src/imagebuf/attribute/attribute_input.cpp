// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/attribute/attribute_input.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "imagebuf/compare/pair.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/qc/qc_header.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

const char* side_word(size_t side) {
    return side == 0 ? "the reference" : "the test";
}

// Lossy compressions destroy the bits of ids. Of float, also PXR24.
bool is_lossy(const std::string& compression) {
    const std::string name = OIIO::Strutil::lower(compression);
    for (const char* lossy : {"b44", "dwa", "pxr24", "lossy", "jpeg"})
        if (OIIO::Strutil::starts_with(name, lossy))
            return true;
    return false;
}

// Names that one has and the other lacks.
std::vector<std::string> names_only_in(const CryptomatteType& one, const CryptomatteType& other) {
    std::set<std::string> names, others;
    for (const auto& [id, name] : one.names)
        names.insert(name);
    for (const auto& [id, name] : other.names)
        others.insert(name);
    std::vector<std::string> only;
    std::set_difference(names.begin(), names.end(), others.begin(), others.end(),
                        std::back_inserter(only));
    return only;
}

// Names of types, those of objects first: what is told of a layer is told by objects.
std::vector<std::string> objects_first(const std::map<std::string, CryptomatteType>& types) {
    std::vector<std::string> names;
    for (const auto& [name, type] : types)
        names.push_back(name);
    std::stable_partition(names.begin(), names.end(), is_of_objects);
    return names;
}

} // namespace

void AttributeInput::open(const Images& reference, const Images& test,
                          const AttributeOptions& options, const OIIO::ROI& region) {
    const QcOptions reading{options.pixels, {}};
    const Images parts[2] = {reference, test};
    for (size_t side = 0; side < 2; ++side) {
        m_readers[side].open(parts[side], reading);
        if (!m_readers[side].has_picture())
            throw Refusal(std::string(side_word(side)) + " has no picture");
    }
    find_region(reference, test, options, region);
    want_picture();
    want_groups();
    want_types(parts);
    want_layers();
}

void AttributeInput::find_region(const Images& reference, const Images& test,
                                 const AttributeOptions& options, const OIIO::ROI& region) {
    const auto image_of = [&](size_t side, const Images& parts) -> const OIIO::ImageBuf& {
        return *parts[m_readers[side].place_of(m_readers[side].choice().r).part];
    };
    if (options.size == SizePolicy::Resize)
        throw Refusal("images that are resized have no ids (valid: size match or crop)");
    const OIIO::ROI compared =
        compared_region(image_of(0, reference), image_of(1, test), options.size);
    m_region = region.defined() ? plane_of(region) : compared;
    m_ignored.open(options, image_of(0, reference).spec(), m_region);
}

AttributeInput::Wanted AttributeInput::wanted(size_t side, const std::vector<int>& channels) const {
    Wanted wanted;
    wanted.side = side;
    wanted.part = m_readers[side].place_of(channels.front()).part;
    for (const int channel : channels) {
        const LayerReader::Place place = m_readers[side].place_of(channel);
        if (place.part != wanted.part)
            throw Refusal(format("channel {} of {} lies in another part than its layer",
                                 m_readers[side].spec().channel_name(channel), side_word(side)));
        wanted.channels.push_back(place.channel);
    }
    return wanted;
}

void AttributeInput::want_picture() {
    for (size_t side = 0; side < 2; ++side) {
        const ColorChoice& choice = m_readers[side].choice();
        Wanted one = wanted(side, {choice.r, choice.g, choice.b});
        one.light = true;
        one.values = &m_picture[side];
        m_wanted.push_back(std::move(one));
    }
}

void AttributeInput::want_groups() {
    std::set<std::string> names;
    for (const LayerReader& reader : m_readers)
        for (const LightGroup& group : reader.groups())
            names.insert(group.name);
    if (m_readers[0].groups().empty() != m_readers[1].groups().empty()) {
        m_warnings.push_back(format("{} has no light groups, so lights are not told",
                                    side_word(m_readers[0].groups().empty() ? 0 : 1)));
        return;
    }
    m_groups.reserve(names.size()); // they stay where they are
    for (const std::string& name : names) {
        Group& group = m_groups.emplace_back();
        group.name = name;
        for (size_t side = 0; side < 2; ++side) {
            const std::vector<LightGroup>& known = m_readers[side].groups();
            const auto found = std::find_if(known.begin(), known.end(),
                                            [&](const LightGroup& g) { return g.name == name; });
            if (found == known.end())
                continue;
            Wanted one = wanted(side, {found->channel, found->channel + 3});
            one.light = true;
            one.values = &group.light[side];
            m_wanted.push_back(std::move(one));
        }
    }
}

void AttributeInput::want_types(const Images (&parts)[2]) {
    std::map<std::string, CryptomatteType> known[2];
    for (size_t side = 0; side < 2; ++side) {
        std::vector<std::string> warnings;
        known[side] = cryptomatte_types(parts[side], warnings);
        for (const std::string& warning : warnings)
            m_warnings.push_back(std::string(side_word(side)) + ": " + warning);
    }
    compare_manifests(known[0], known[1]);
    std::map<std::string, CryptomatteType> all = std::move(known[1]); // the test's names count
    for (auto& [name, type] : known[0])
        all[name].names.merge(type.names);
    m_types.reserve(all.size()); // they stay where they are
    for (const std::string& name : objects_first(all)) {
        CryptomatteType& type = all[name];
        std::vector<int> channels[2];
        for (size_t side = 0; side < 2; ++side)
            channels[side] = cryptomatte_channels(m_readers[side].spec(), name);
        if (channels[0].empty() || channels[1].empty())
            continue;
        Type& added = m_types.emplace_back();
        added.name = name;
        added.names = std::move(type.names);
        for (size_t side = 0; side < 2; ++side) {
            check_ids(side, parts[side], name, channels[side]);
            Wanted one = wanted(side, channels[side]);
            one.coverage = &added.coverage[side];
            m_wanted.push_back(std::move(one));
        }
    }
}

void AttributeInput::compare_manifests(const std::map<std::string, CryptomatteType>& reference,
                                       const std::map<std::string, CryptomatteType>& test) {
    for (const auto& [name, type] : reference) {
        const auto other = test.find(name);
        if (other == test.end() || type.names.empty() || other->second.names.empty())
            continue;
        AttributedManifest only{name, names_only_in(type, other->second),
                                names_only_in(other->second, type)};
        for (std::vector<std::string>* names : {&only.reference, &only.test}) {
            constexpr size_t most = 1000;
            if (names->size() > most) {
                m_warnings.push_back(format("{} name(s) of {} are in one manifest alone: the first "
                                            "{} are told",
                                            names->size(), name, most));
                names->resize(most);
            }
        }
        if (!only.reference.empty() || !only.test.empty())
            m_manifest_only.push_back(std::move(only));
    }
}

void AttributeInput::check_ids(size_t side, const Images& parts, const std::string& type,
                               const std::vector<int>& channels) const {
    for (size_t i = 0; i < channels.size(); i += 2) {
        const LayerReader::Place place = m_readers[side].place_of(channels[i]);
        const OIIO::ImageBuf& part = *parts[place.part];
        const OIIO::ImageSpec& spec =
            part.nativespec().nchannels == part.nchannels() ? part.nativespec() : part.spec();
        const OIIO::TypeDesc stored = spec.channelformat(place.channel);
        const std::string compression = spec.get_string_attribute("compression");
        if (stored != OIIO::TypeFloat || is_lossy(compression)) {
            throw Refusal(format("the ids of {} in {} have been through {}, which destroys them "
                                 "(valid: float, without loss)",
                                 type, side_word(side),
                                 stored != OIIO::TypeFloat ? stored.c_str() : compression));
        }
    }
}

void AttributeInput::want_layers() {
    static const std::set<std::string> kinds = {"depth", "position", "normal",
                                                "id",    "albedo",   "color"};
    const std::vector<LayerReader::Layer>&first = m_readers[0].layers(),
          &second = m_readers[1].layers();
    const auto listed = [&](const std::vector<LayerReader::Layer>& layers) {
        std::vector<size_t> places;
        for (size_t i = 0; i < layers.size(); ++i)
            if (kinds.count(layers[i].kind) > 0 && !is_filtered(layers[i].name))
                places.push_back(i);
        return places;
    };
    const auto same = same_layers(first, listed(first), second, listed(second));
    m_layers.reserve(same.size()); // they stay where they are
    for (const auto& [a, b] : same) {
        const LayerReader::Layer* layers[2] = {&first[a], &second[b]};
        const std::string& kind = layers[0]->kind;
        const size_t channels = layers[0]->channels.size();
        const size_t needed = kind == "depth" ? 1 : kind == "id" ? channels : 3;
        if (kind != layers[1]->kind || channels != needed ||
            channels != layers[1]->channels.size() || is_cryptomatte(layers[0]->name))
            continue;
        Layer& layer = m_layers.emplace_back();
        layer.name = layers[0]->name;
        layer.kind = kind;
        layer.channels = channels;
        for (size_t side = 0; side < 2; ++side) {
            Wanted one;
            one.side = side;
            one.part = layers[side]->part;
            one.channels = layers[side]->channels;
            one.light = kind == "albedo" || kind == "color";
            one.values = &layer.values[side];
            m_wanted.push_back(std::move(one));
        }
    }
}

// Told by names, whether or not the header describes it.
bool AttributeInput::is_cryptomatte(const std::string& layer) const {
    return plain_word(layer).find("crypto") != std::string::npos ||
           std::any_of(m_types.begin(), m_types.end(), [&](const Type& type) {
               return OIIO::Strutil::starts_with(layer, type.name);
           });
}

uint64_t AttributeInput::bytes() const {
    uint64_t floats = 0;
    for (const Wanted& one : m_wanted)
        floats += one.values ? one.channels.size() : 0;
    return floats * sizeof(float) * pixels();
}

void AttributeInput::read(int nthreads) {
    for (const Wanted& one : m_wanted)
        if (one.values)
            one.values->resize(one.channels.size() * pixels());
    for (int begin = m_region.ybegin; begin < m_region.yend;) {
        const int end = std::min(m_region.yend, begin + std::min(m_readers[0].rows_at_once(begin),
                                                                 m_readers[1].rows_at_once(begin)));
        for (LayerReader& reader : m_readers)
            reader.read_band(begin, end);
        read_rows(begin, end, nthreads);
        begin = end;
    }
    leave_out_ignored();
    for (Group& group : m_groups) // what is not finite is in the rest
        for (std::vector<float>& light : group.light)
            for (float& value : light)
                value = std::isfinite(value) ? value : 0;
}

// Of lights and colours; data have no surface there (attribute_layers()).
void AttributeInput::leave_out_ignored() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto clear = [&](std::vector<float>& values, size_t channels) {
        for (size_t i = 0; i < values.size(); ++i)
            if (!counts(i / channels))
                values[i] = nan;
    };
    for (Group& group : m_groups)
        for (std::vector<float>& light : group.light)
            clear(light, 3);
    for (Layer& layer : m_layers)
        for (std::vector<float>& values : layer.values)
            if (layer.kind == "albedo" || layer.kind == "color")
                clear(values, layer.channels);
}

void AttributeInput::read_rows(int begin, int end, int nthreads) {
    for (const Wanted& one : m_wanted) {
        const LayerReader& reader = m_readers[one.side];
        std::vector<metrics::Coverage::Row> rows(one.coverage ? size_t(end - begin) : 0);
        make_parallel(nthreads)(end - begin, [&](int64_t i) {
            const int y = begin + int(i);
            const std::vector<float> row = one.light
                                               ? reader.light(one.part, one.channels, m_region, y)
                                               : reader.values(one.part, one.channels, m_region, y);
            if (one.coverage)
                rows[size_t(i)] = metrics::Coverage::decode(
                    row, one.channels.size() / 2, m_ignored.any() ? m_ignored.row(y) : nullptr);
            else
                std::copy(row.begin(), row.end(),
                          one.values->begin() + (y - m_region.ybegin) * ptrdiff_t(row.size()));
        });
        for (const metrics::Coverage::Row& row : rows)
            one.coverage->add(row);
    }
}

} // namespace tonetool
