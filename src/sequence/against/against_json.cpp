// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>

#include "sequence/against/against_record.h"
#include "sequence/results/json_text.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;

AgainstRecord::Window window_of(const ordered_json& from) {
    AgainstRecord::Window window{};
    for (size_t i = 0; i < window.size(); ++i)
        window[i] = whole_number<int>(from.at(i), "window");
    return window;
}

ordered_json json_of(const AgainstDifference& difference) {
    ordered_json to{{"code", difference.code}, {"severity", severity_name(difference.severity)}};
    if (!difference.layer.empty())
        to["layer"] = difference.layer;
    to["sentence"] = difference.sentence;
    return to;
}

AgainstDifference difference_of(const ordered_json& from) {
    AgainstDifference difference;
    from.at("code").get_to(difference.code);
    if (rank_of(against_rules(), difference.code) == against_rules().size())
        throw std::runtime_error("no fault of --against is called \"" + difference.code + "\"");
    const auto severity = severity_of_name(from.at("severity").get<std::string>());
    if (!severity)
        throw std::runtime_error("no severity: " + one_line(from.at("severity")));
    difference.severity = *severity;
    difference.layer = from.value("layer", std::string());
    from.at("sentence").get_to(difference.sentence);
    return difference;
}

ordered_json json_of(const AgainstLayer& layer) {
    ordered_json to = {{"name", layer.name},
                       {"kind", layer.kind},
                       {"quantities", layer.quantities},
                       {"at", {layer.x, layer.y}}};
    const auto share = layer.quantities.find("one_finite");
    if (share != layer.quantities.end() && share->second > 0)
        to["one_finite_at"] = {layer.one_finite_x, layer.one_finite_y};
    return to;
}

AgainstLayer layer_from(const ordered_json& from) {
    AgainstLayer layer;
    from.at("name").get_to(layer.name);
    from.at("kind").get_to(layer.kind);
    for (const auto& [name, value] : from.at("quantities").items())
        layer.quantities[name] = finite_number(value, name.c_str());
    layer.x = whole_number<int>(from.at("at").at(0), "at");
    layer.y = whole_number<int>(from.at("at").at(1), "at");
    if (const auto at = from.find("one_finite_at"); at != from.end()) {
        layer.one_finite_x = whole_number<int>(at->at(0), "one_finite_at");
        layer.one_finite_y = whole_number<int>(at->at(1), "one_finite_at");
    }
    return layer;
}

AgainstRecord record_from(const ordered_json& from) {
    AgainstRecord record;
    for (const auto& [code, limit] : from.at("limits").items())
        record.limits.set(code, limit.get<std::string>());
    record.approved = from.at("approved").get<bool>();
    record.between = from.value("between", false);
    if (!record.approved)
        return record;
    record.approved_data = window_of(from.at("windows").at(0));
    record.data = window_of(from.at("windows").at(1));
    record.approved_moment = from.at("moments").at(0).get<std::string>();
    record.moment = from.at("moments").at(1).get<std::string>();
    for (const ordered_json& difference : from.at("differences"))
        record.differences.push_back(difference_of(difference));
    for (const ordered_json& layer : from.at("layers"))
        record.layers.push_back(layer_from(layer));
    return record;
}

} // namespace

std::string to_json(const AgainstRecord& record) {
    ordered_json to = {{"limits", record.limits.texts()}, {"approved", record.approved}};
    if (record.between)
        to["between"] = true;
    if (record.approved) {
        to["windows"] = {record.approved_data, record.data};
        to["moments"] = {record.approved_moment, record.moment};
        to["differences"] = ordered_json::array();
        for (const AgainstDifference& difference : record.differences)
            to["differences"].push_back(json_of(difference));
        to["layers"] = ordered_json::array();
        for (const AgainstLayer& layer : record.layers)
            to["layers"].push_back(json_of(layer));
    }
    return one_line(to);
}

AgainstRecord against_from_json(const std::string& text) {
    try {
        return record_from(parse_json<ordered_json>(text));
    } catch (const nlohmann::json::exception& problem) {
        throw std::runtime_error("not what --against measured: " + reason_of(problem));
    } catch (const std::exception& problem) {
        throw std::runtime_error(std::string("not what --against measured: ") + problem.what());
    }
}

} // namespace tonetool::sequence
