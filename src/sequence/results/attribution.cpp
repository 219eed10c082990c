// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/attribution.h"

#include <cmath>

#include "imagebuf/options/attribute_fields.h"
#include "sequence/results/json_text.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;

ordered_json value_of(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json("nan");
}
ordered_json value_of(int64_t value) {
    return value;
}
ordered_json value_of(const std::string& text) {
    return text;
}
ordered_json value_of(const std::vector<std::string>& texts) {
    return texts;
}
template <size_t N>
ordered_json value_of(const std::array<double, N>& values) {
    ordered_json list = ordered_json::array();
    for (const double value : values)
        list.push_back(value_of(value));
    return list;
}
ordered_json value_of(const std::vector<std::pair<std::string, double>>& pairs) {
    ordered_json list = ordered_json::array();
    for (const auto& [name, value] : pairs)
        list.push_back({name, value_of(value)});
    return list;
}

// What is empty is left out.
template <class Value>
bool is_left_out(const Value&) {
    return false;
}
bool is_left_out(const std::string& text) {
    return text.empty();
}
template <class Value>
bool is_left_out(const std::vector<Value>& list) {
    return list.empty();
}

template <class Value>
void put_value(ordered_json& to, const char* key, const Value& value) {
    if (!is_left_out(value))
        to[key] = value_of(value);
}
template <class Value>
void put_value(ordered_json& to, const char* key, const std::optional<Value>& value) {
    if (value)
        to[key] = value_of(*value);
}

template <class Row>
ordered_json row_json(const Row& row) {
    ordered_json to = ordered_json::object();
    visit_fields(&row, [&](const SummaryField& field, auto member) {
        put_value(to, field.name, row.*member);
    });
    return to;
}

template <class Row>
ordered_json table_json(const std::vector<Row>& rows) {
    ordered_json to = ordered_json::array();
    for (const Row& row : rows)
        to.push_back(row_json(row));
    return to;
}

} // namespace

std::string attribution_json(const AttributeResult& result) {
    ordered_json to{{"findings", ToneAlgo::attribute_findings(result)},
                    {"lights", table_json(result.lights)},
                    {"mattes", ordered_json::object()},
                    {"layers", table_json(result.layers)}};
    for (const AttributedType& type : result.mattes)
        to["mattes"][type.type] = table_json(type.mattes);
    for (const AttributedManifest& manifest : result.manifest_only) {
        ordered_json sides = row_json(manifest);
        sides.erase("type");
        to["manifest_only"][manifest.type] = std::move(sides);
    }
    return one_line(to);
}

std::vector<std::string> attribution_findings(const std::string& json) {
    std::vector<std::string> sentences;
    const ordered_json from = parsed_or_null(json);
    if (!from.is_object() || !from.contains("findings") || !from["findings"].is_array())
        return sentences;
    for (const ordered_json& sentence : from["findings"])
        if (sentence.is_string())
            sentences.push_back(sentence.get<std::string>());
    return sentences;
}

} // namespace tonetool::sequence
