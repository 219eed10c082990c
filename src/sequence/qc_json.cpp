#include "sequence/qc_json.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace tonetool {

namespace {

using nlohmann::ordered_json;

ordered_json json_of(const QcSpot& spot) {
    return {spot.x, spot.y, spot.value, spot.around};
}

QcSpot spot_of(const ordered_json& from) {
    return {from.at(0).get<int>(), from.at(1).get<int>(), from.at(2).get<double>(),
            from.at(3).get<double>()};
}

ordered_json json_of(const std::vector<QcSpot>& spots) {
    ordered_json list = ordered_json::array();
    for (const QcSpot& spot : spots) {
        list.push_back(json_of(spot));
    }
    return list;
}

std::vector<QcSpot> spots_of(const ordered_json& from) {
    std::vector<QcSpot> spots;
    for (const ordered_json& spot : from) {
        spots.push_back(spot_of(spot));
    }
    return spots;
}

// Nothing is the usual finding.
void put(ordered_json& to, const char* key, const QcCount& count) {
    if (count.pixels > 0) {
        to[key] = {{"pixels", count.pixels}, {"first", json_of(count.first)}};
    }
}

QcCount count_of(const ordered_json& from, const char* key) {
    QcCount count;
    if (from.contains(key)) {
        count.pixels = from[key].at("pixels").get<int64_t>();
        count.first = spots_of(from[key].at("first"));
    }
    return count;
}

ordered_json json_of(const QcPart& part) {
    return {{"name", part.name},
            {"data", part.data},
            {"display", part.display},
            {"compression", part.compression},
            {"metadata", part.metadata}};
}

QcPart part_of(const ordered_json& from) {
    return {from.at("name").get<std::string>(), from.at("data").get<std::array<int, 4>>(),
            from.at("display").get<std::array<int, 4>>(), from.at("compression").get<std::string>(),
            from.at("metadata").get<std::map<std::string, std::string>>()};
}

ordered_json json_of(const QcLayer& layer) {
    ordered_json to = {{"name", layer.name},         {"kind", layer.kind}, {"lit", layer.lit},
                       {"constant", layer.constant}, {"min", layer.min},   {"max", layer.max},
                       {"mean", layer.mean}};
    put(to, "nan", layer.nan);
    put(to, "inf", layer.inf);
    put(to, "negative", layer.negative);
    return to;
}

QcLayer layer_of(const ordered_json& from) {
    QcLayer layer;
    from.at("name").get_to(layer.name);
    from.at("kind").get_to(layer.kind);
    from.at("lit").get_to(layer.lit);
    from.at("constant").get_to(layer.constant);
    from.at("min").get_to(layer.min);
    from.at("max").get_to(layer.max);
    from.at("mean").get_to(layer.mean);
    layer.nan = count_of(from, "nan");
    layer.inf = count_of(from, "inf");
    layer.negative = count_of(from, "negative");
    return layer;
}

ordered_json json_of(const QcPicture& picture) {
    ordered_json to = {{"layer", picture.layer},
                       {"space", picture.space},
                       {"hash", picture.hash},
                       {"thumbnail", picture.thumbnail},
                       {"peaks", picture.peaks},
                       {"spike_count", picture.spike_count},
                       {"spikes", json_of(picture.spikes)}};
    put(to, "alpha_low", picture.alpha_low);
    put(to, "alpha_high", picture.alpha_high);
    if (picture.groups > 0) {
        to["groups"] = {{"count", picture.groups},
                        {"sum", picture.group_sum},
                        {"difference", picture.group_difference},
                        {"worst", json_of(picture.group_worst)}};
    }
    return to;
}

std::vector<int> cells_of(const ordered_json& from, const char* key) {
    auto cells = from.at(key).get<std::vector<int>>();
    if (cells.size() != size_t(QcPicture::kWide) * QcPicture::kHigh) {
        throw std::runtime_error(std::string(key) + " has " + std::to_string(cells.size()) +
                                 " values, not " + std::to_string(QcPicture::kWide) + " x " +
                                 std::to_string(QcPicture::kHigh));
    }
    return cells;
}

QcPicture picture_of(const ordered_json& from) {
    QcPicture picture;
    from.at("layer").get_to(picture.layer);
    from.at("space").get_to(picture.space);
    from.at("hash").get_to(picture.hash);
    picture.thumbnail = cells_of(from, "thumbnail");
    picture.peaks = cells_of(from, "peaks");
    from.at("spike_count").get_to(picture.spike_count);
    picture.spikes = spots_of(from.at("spikes"));
    picture.alpha_low = count_of(from, "alpha_low");
    picture.alpha_high = count_of(from, "alpha_high");
    if (from.contains("groups")) {
        const ordered_json& groups = from["groups"];
        groups.at("count").get_to(picture.groups);
        groups.at("sum").get_to(picture.group_sum);
        groups.at("difference").get_to(picture.group_difference);
        picture.group_worst = spot_of(groups.at("worst"));
    }
    return picture;
}

template <class Item>
ordered_json list_of(const std::vector<Item>& items) {
    ordered_json list = ordered_json::array();
    for (const Item& item : items) {
        list.push_back(json_of(item));
    }
    return list;
}

QcFacts facts_of(const ordered_json& from) {
    QcFacts facts;
    for (const ordered_json& part : from.at("parts")) {
        facts.parts.push_back(part_of(part));
    }
    for (const ordered_json& channel : from.at("channels")) {
        facts.channels.emplace_back(channel.at(0).get<std::string>(),
                                    channel.at(1).get<std::string>());
    }
    for (const ordered_json& layer : from.at("layers")) {
        facts.layers.push_back(layer_of(layer));
    }
    facts.picture = picture_of(from.at("picture"));
    if (facts.parts.empty()) {
        throw std::runtime_error("no part of a file");
    }
    return facts;
}

} // namespace

namespace sequence {

std::string to_json(const QcRecord& record) {
    const QcFacts& facts = record.facts;
    ordered_json channels = ordered_json::array();
    for (const auto& [name, type] : facts.channels) {
        channels.push_back({name, type});
    }
    ordered_json to = {{"limits", record.limits.texts()},
                       {"picture", json_of(facts.picture)},
                       {"layers", list_of(facts.layers)},
                       {"channels", channels},
                       {"parts", list_of(facts.parts)}};
    return to.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

QcRecord qc_from_json(const std::string& text) {
    QcRecord record;
    try {
        const ordered_json from = ordered_json::parse(text);
        record.facts = facts_of(from);
        for (const auto& [code, limit] : from.at("limits").items()) {
            record.limits.set(code, limit.get<std::string>());
        }
    } catch (const std::exception& problem) {
        throw std::runtime_error(std::string("not what --qc measured: ") + problem.what());
    }
    return record;
}

} // namespace sequence
} // namespace tonetool
