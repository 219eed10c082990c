// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/qc/qc_json.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "sequence/qc/qc_cells.h"
#include "sequence/results/json_text.h"

namespace tonetool {

namespace {

using nlohmann::json; // what is read: its objects grow without copies of what they hold
using nlohmann::ordered_json;

template <class Int>
void read_whole(const json& from, const char* key, Int& to) {
    to = whole_number<Int>(from.at(key), key);
}

void read_real(const json& from, const char* key, double& to) {
    to = finite_number(from.at(key), key);
}

template <class Ints>
void read_whole_numbers(const json& from, const char* key, Ints& to) {
    to = from.at(key).get<Ints>();
    for (size_t i = 0; i < to.size(); ++i)
        to[i] = whole_number<int>(from[key].at(i), key);
}

ordered_json qc_json_of(const QcSpot& spot) {
    return {spot.x, spot.y, spot.value, spot.around};
}

QcSpot spot_of(const json& from) {
    return {whole_number<int>(from.at(0), "x"), whole_number<int>(from.at(1), "y"),
            finite_number(from.at(2), "value"), finite_number(from.at(3), "around")};
}

ordered_json qc_json_of(const std::vector<QcSpot>& spots) {
    ordered_json list = ordered_json::array();
    for (const QcSpot& spot : spots)
        list.push_back(qc_json_of(spot));
    return list;
}

std::vector<QcSpot> spots_of(const json& from) {
    std::vector<QcSpot> spots;
    for (const json& spot : from)
        spots.push_back(spot_of(spot));
    return spots;
}

// Usually there is none, and the key is left out.
void put(ordered_json& to, const char* key, const QcCount& count) {
    if (count.pixels > 0)
        to[key] = {{"pixels", count.pixels}, {"first", qc_json_of(count.first)}};
}

QcCount count_of(const json& from, const char* key) {
    QcCount count;
    if (from.contains(key)) {
        read_whole(from[key], "pixels", count.pixels);
        count.first = spots_of(from[key].at("first"));
    }
    return count;
}

ordered_json qc_json_of(const QcPart& part) {
    return {{"name", part.name},
            {"data", part.data},
            {"display", part.display},
            {"compression", part.compression},
            {"metadata", part.metadata}};
}

QcPart part_of(const json& from) {
    QcPart part;
    from.at("name").get_to(part.name);
    read_whole_numbers(from, "data", part.data);
    read_whole_numbers(from, "display", part.display);
    from.at("compression").get_to(part.compression);
    from.at("metadata").get_to(part.metadata);
    return part;
}

// Colours by their bits, as JSON has no NaN.
ordered_json qc_json_of(const QcRectangle& of) {
    std::array<uint32_t, 3> bits{};
    std::memcpy(bits.data(), of.color.data(), sizeof bits);
    return {of.x, of.y, of.width, of.height, bits[0], bits[1], bits[2], of.background};
}

QcRectangle rectangle_of(const json& from) {
    QcRectangle to;
    int* const place[] = {&to.x, &to.y, &to.width, &to.height};
    for (size_t i = 0; i < 4; ++i)
        *place[i] = whole_number<int>(from.at(i), "rectangles");
    std::array<uint32_t, 3> bits{};
    for (size_t i = 0; i < 3; ++i)
        bits[i] = whole_number<uint32_t>(from.at(4 + i), "rectangles");
    std::memcpy(to.color.data(), bits.data(), sizeof bits);
    from.at(7).get_to(to.background);
    return to;
}

// Borders of a render are rarely plain, and the key is left out.
void put(ordered_json& to, const char* key, const std::array<int, 32>& shares) {
    if (std::any_of(shares.begin(), shares.end(), [](int share) { return share > 0; }))
        to[key] = shares;
}

void read_shares(const json& from, const char* key, std::array<int, 32>& to) {
    if (from.contains(key))
        read_whole_numbers(from, key, to);
}

ordered_json qc_json_of(const QcLayer& layer) {
    ordered_json to = {{"name", layer.name},         {"kind", layer.kind}, {"lit", layer.lit},
                       {"constant", layer.constant}, {"min", layer.min},   {"max", layer.max},
                       {"mean", layer.mean}};
    if (!layer.hash.empty())
        to["hash"] = layer.hash;
    put(to, "nan", layer.nan);
    put(to, "inf", layer.inf);
    put(to, "negative", layer.negative);
    return to;
}

QcLayer layer_of(const json& from) {
    QcLayer layer;
    from.at("name").get_to(layer.name);
    from.at("kind").get_to(layer.kind);
    if (from.contains("hash"))
        from["hash"].get_to(layer.hash);
    read_whole(from, "lit", layer.lit);
    from.at("constant").get_to(layer.constant);
    read_real(from, "min", layer.min);
    read_real(from, "max", layer.max);
    read_real(from, "mean", layer.mean);
    layer.nan = count_of(from, "nan");
    layer.inf = count_of(from, "inf");
    layer.negative = count_of(from, "negative");
    return layer;
}

// Numbers of the picture, by their names.
template <class Picture, class Visit>
void visit_statistics(Picture& picture, const Visit& visit) {
    visit("fine", picture.fine);
    visit("coarse", picture.coarse);
    visit("across", picture.across);
    visit("down", picture.down);
    visit("magenta", picture.magenta);
    visit("speed", picture.speed);
}

template <class Picture, class Visit>
void visit_clamps(Picture& picture, const Visit& visit) {
    visit("at_one", picture.at_one);
    visit("beside_one", picture.beside_one);
    visit("at_largest_half", picture.at_largest_half);
}

// Those that are 0 are left out.
void put_statistics(ordered_json& to, const QcPicture& picture) {
    ordered_json statistics = ordered_json::object();
    visit_statistics(picture, [&](const char* name, double value) {
        if (value != 0)
            statistics[name] = value;
    });
    visit_clamps(picture, [&](const char* name, int64_t pixels) {
        if (pixels > 0)
            statistics[name] = pixels;
    });
    if (!statistics.empty())
        to["statistics"] = statistics;
}

void read_statistics(const json& from, QcPicture& picture) {
    if (!from.contains("statistics"))
        return;
    const json& statistics = from["statistics"];
    visit_statistics(picture, [&](const char* name, double& value) {
        if (statistics.contains(name))
            read_real(statistics, name, value);
    });
    visit_clamps(picture, [&](const char* name, int64_t& pixels) {
        if (statistics.contains(name))
            read_whole(statistics, name, pixels);
    });
}

void put_places(ordered_json& to, const QcPicture& picture) {
    if (picture.alpha_mean != 0 || picture.alpha_clear != 0)
        to["alpha"] = {{"mean", picture.alpha_mean}, {"clear", picture.alpha_clear}};
    for (const QcRectangle& rectangle : picture.rectangles)
        to["rectangles"].push_back(qc_json_of(rectangle));
    if (picture.pairs != std::array<double, 2>{} || picture.greens > 0) {
        to["values"] = {
            {"pairs", picture.pairs}, {"greens", picture.greens}, {"distinct", picture.distinct}};
    }
    ordered_json borders = ordered_json::object();
    put(borders, "left", picture.borders.left);
    put(borders, "right", picture.borders.right);
    put(borders, "top", picture.borders.top);
    put(borders, "bottom", picture.borders.bottom);
    if (!borders.empty())
        to["borders"] = borders;
}

void read_places(const json& from, QcPicture& picture) {
    if (from.contains("alpha")) {
        read_real(from["alpha"], "mean", picture.alpha_mean);
        read_real(from["alpha"], "clear", picture.alpha_clear);
    }
    if (from.contains("values")) {
        const json& values = from["values"];
        for (size_t i = 0; i < picture.pairs.size(); ++i)
            picture.pairs[i] = finite_number(values.at("pairs").at(i), "pairs");
        read_whole(values, "greens", picture.greens);
        read_whole(values, "distinct", picture.distinct);
    }
    if (from.contains("rectangles"))
        for (const json& rectangle : from["rectangles"])
            picture.rectangles.push_back(rectangle_of(rectangle));
    if (from.contains("borders")) {
        read_shares(from["borders"], "left", picture.borders.left);
        read_shares(from["borders"], "right", picture.borders.right);
        read_shares(from["borders"], "top", picture.borders.top);
        read_shares(from["borders"], "bottom", picture.borders.bottom);
    }
}

ordered_json qc_json_of(const QcPicture& picture) {
    ordered_json to = {{"layer", picture.layer},
                       {"space", picture.space},
                       {"hash", picture.hash},
                       {"spike_count", picture.spike_count},
                       {"spikes", qc_json_of(picture.spikes)}};
    put(to, "alpha_low", picture.alpha_low);
    put(to, "alpha_high", picture.alpha_high);
    if (picture.unseen.pixels > 0) {
        to["lit"] = picture.lit;
        put(to, "unseen", picture.unseen);
    }
    put_places(to, picture);
    put_statistics(to, picture);
    if (picture.groups > 0) {
        to["groups"] = {{"count", picture.groups},
                        {"sum", picture.group_sum},
                        {"difference", picture.group_difference},
                        {"worst", qc_json_of(picture.group_worst)}};
    }
    return to;
}

QcPicture picture_of(const json& from) {
    QcPicture picture;
    from.at("layer").get_to(picture.layer);
    from.at("space").get_to(picture.space);
    from.at("hash").get_to(picture.hash);
    read_whole(from, "spike_count", picture.spike_count);
    picture.spikes = spots_of(from.at("spikes"));
    picture.alpha_low = count_of(from, "alpha_low");
    picture.alpha_high = count_of(from, "alpha_high");
    if (from.contains("lit"))
        read_whole(from, "lit", picture.lit);
    picture.unseen = count_of(from, "unseen");
    read_places(from, picture);
    read_statistics(from, picture);
    if (from.contains("groups")) {
        const json& groups = from["groups"];
        read_whole(groups, "count", picture.groups);
        read_real(groups, "sum", picture.group_sum);
        read_real(groups, "difference", picture.group_difference);
        picture.group_worst = spot_of(groups.at("worst"));
    }
    return picture;
}

template <class Item>
ordered_json list_of(const std::vector<Item>& items) {
    ordered_json list = ordered_json::array();
    for (const Item& item : items)
        list.push_back(qc_json_of(item));
    return list;
}

// Bits of IDs as 8 digits, as a Cryptomatte's manifest has them.
ordered_json qc_json_of(const QcObjects& objects) {
    ordered_json inside = ordered_json::array();
    for (const QcObject& object : objects.inside)
        inside.push_back({OIIO::Strutil::fmt::format("{:08x}", object.id), object.pixels});
    return {{"layer", objects.layer}, {"inside", inside}};
}

QcObjects objects_of(const json& from) {
    QcObjects objects;
    from.at("layer").get_to(objects.layer);
    for (const json& one : from.at("inside")) {
        const auto id = one.at(0).get<std::string>();
        if (id.size() != 8 || id.find_first_not_of("0123456789abcdef") != std::string::npos)
            throw std::runtime_error("\"objects\" has \"" + id + "\", not 8 digits from 0 to f");
        objects.inside.push_back(
            {uint32_t(std::stoul(id, nullptr, 16)), whole_number<int64_t>(one.at(1), "objects")});
    }
    return objects;
}

// Each channel takes 1152 bytes of the cells.
int channels_of_guide(const json& guide) {
    constexpr int most = 16;
    const int channels = whole_number<int>(guide.at(1), "guides");
    if (channels < 1 || channels > most)
        throw std::runtime_error("a guide of " + std::to_string(channels) + " channels");
    return channels;
}

QcFacts facts_of(const json& from) {
    QcFacts facts;
    for (const json& part : from.at("parts"))
        facts.parts.push_back(part_of(part));
    for (const json& channel : from.at("channels")) {
        facts.channels.emplace_back(channel.at(0).get<std::string>(),
                                    channel.at(1).get<std::string>());
    }
    for (const json& layer : from.at("layers"))
        facts.layers.push_back(layer_of(layer));
    facts.picture = picture_of(from.at("picture"));
    for (const json& guide : from.at("guides"))
        facts.guides.push_back({guide.at(0).get<std::string>(), channels_of_guide(guide), {}});
    if (from.contains("objects"))
        facts.picture.objects = objects_of(from["objects"]);
    sequence::read_cells(from.at("cells").get<std::string>(), facts);
    if (facts.parts.empty())
        throw std::runtime_error("no part of a file");
    return facts;
}

} // namespace

namespace sequence {

std::string to_json(const QcRecord& record) {
    const QcFacts& facts = record.facts;
    ordered_json channels = ordered_json::array();
    for (const auto& [name, type] : facts.channels)
        channels.push_back({name, type});
    ordered_json guides = ordered_json::array();
    for (const QcGuide& guide : facts.guides)
        guides.push_back({guide.layer, guide.channels});
    ordered_json to = {{"limits", record.limits.texts()},
                       {"picture", qc_json_of(facts.picture)},
                       {"guides", guides}};
    if (!facts.picture.objects.layer.empty())
        to["objects"] = qc_json_of(facts.picture.objects);
    to.update(ordered_json{{"cells", cells_text(facts)},
                           {"layers", list_of(facts.layers)},
                           {"channels", channels},
                           {"parts", list_of(facts.parts)}});
    if (record.strays.digits > 0)
        to["digits"] = record.strays.digits;
    if (record.strays.first != record.strays.last)
        to["folder"] = {record.strays.first, record.strays.last};
    if (!record.strays.names.empty())
        to["strays"] = record.strays.names;
    return one_line(to);
}

QcRecord qc_from_json(const std::string& text) {
    QcRecord record;
    try {
        const auto from = parse_json<json>(text);
        record.facts = facts_of(from);
        if (from.contains("digits"))
            record.strays.digits = whole_number<int>(from["digits"], "digits");
        if (from.contains("folder")) {
            record.strays.first = whole_number<int>(from["folder"].at(0), "folder");
            record.strays.last = whole_number<int>(from["folder"].at(1), "folder");
        }
        if (from.contains("strays"))
            from["strays"].get_to(record.strays.names);
        for (const auto& [code, limit] : from.at("limits").items())
            record.limits.set(code, limit.get<std::string>());
    } catch (const nlohmann::json::exception& problem) {
        throw std::runtime_error("not what --qc measured: " + reason_of(problem));
    } catch (const std::exception& problem) {
        throw std::runtime_error(std::string("not what --qc measured: ") + problem.what());
    }
    return record;
}

} // namespace sequence
} // namespace tonetool
