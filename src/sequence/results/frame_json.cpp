// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/frame_json.h"

#include <cmath>
#include <stdexcept>

#include "sequence/results/json_text.h"
#include "sequence/results/records.h"
#include "sequence/verdict/trust.h"

namespace tonetool::sequence {

using nlohmann::ordered_json;

Status status_from(const ordered_json& from) {
    const auto name = from.at("status").get<std::string>();
    const auto found = status_of_name(name);
    if (!found)
        throw std::runtime_error("unknown status \"" + name + "\"");
    return *found;
}

namespace {

// ---- values

ordered_json of(double value) {
    if (std::isnan(value))
        return "nan";
    return std::isinf(value) ? ordered_json(value > 0 ? "inf" : "-inf") : ordered_json(value);
}

ordered_json of(const std::string& text) {
    return text;
}

ordered_json of(const Position& at) {
    return {at.x, at.y};
}

template <class Value>
ordered_json of(const std::vector<std::pair<std::string, Value>>& list) {
    ordered_json object = ordered_json::object();
    for (const auto& [name, value] : list)
        object[name] = of(value);
    return object;
}

ordered_json of(const std::vector<double>& values) {
    ordered_json list = ordered_json::array();
    for (double value : values)
        list.push_back(of(value));
    return list;
}

// What is infinite or no number is a text; the numbers themselves are finite.
double number(const ordered_json& from, const std::string& key) {
    if (from.is_string()) {
        const auto text = from.get<std::string>();
        if (text == "nan")
            return std::nan("");
        if (text == "inf" || text == "-inf")
            return text == "inf" ? HUGE_VAL : -HUGE_VAL;
    }
    return finite_number(from, key);
}

template <class List>
void put_list(ordered_json& to, const char* key, const List& list) {
    if (!list.empty())
        to[key] = of(list);
}

template <class Value>
void put(ordered_json& to, const char* key, const std::optional<Value>& value) {
    if (value)
        to[key] = of(*value);
}

void put(ordered_json& to, const char* key, const std::string& text) {
    if (!text.empty())
        to[key] = text;
}

std::string text(const ordered_json& from, const char* key) {
    return from.value(key, std::string());
}

std::optional<double> maybe_number(const ordered_json& from, const char* key) {
    return from.contains(key) ? std::optional<double>(number(from[key], key)) : std::nullopt;
}

std::optional<Position> maybe_position(const ordered_json& from, const char* key) {
    if (!from.contains(key))
        return std::nullopt;
    const ordered_json& at = from[key];
    return Position{whole_number<int>(at.at(0), key), whole_number<int>(at.at(1), key)};
}

Numbers numbers(const ordered_json& from, const char* key) {
    Numbers list;
    if (from.contains(key))
        for (const auto& item : from[key].items())
            list.emplace_back(item.key(), number(item.value(), item.key()));
    return list;
}

Texts texts(const ordered_json& from, const char* key) {
    Texts list;
    if (from.contains(key))
        for (const auto& item : from[key].items())
            list.emplace_back(item.key(), item.value().get<std::string>());
    return list;
}

template <class Value>
std::vector<Value> values(const ordered_json& from, const char* key) {
    return from.value(key, std::vector<Value>());
}

// ---- structs

ordered_json json_of(const Fault& fault) {
    ordered_json to{{"code", fault.code}, {"severity", severity_name(fault.severity)}};
    put(to, "sentence", fault.sentence);
    put(to, "layer", fault.layer);
    put(to, "position", fault.position);
    put(to, "command", fault.command);
    if (fault.rectangle)
        to["rectangle"] = *fault.rectangle;
    put(to, "value", fault.value);
    put(to, "threshold", fault.threshold);
    return to;
}

Fault fault_of(const ordered_json& from) {
    Fault fault;
    fault.code = from.at("code").get<std::string>();
    const auto severity = severity_of_name(from.at("severity").get<std::string>());
    if (!severity)
        throw std::runtime_error("unknown severity " + one_line(from.at("severity")));
    fault.severity = *severity;
    fault.sentence = text(from, "sentence");
    fault.layer = text(from, "layer");
    fault.position = maybe_position(from, "position");
    if (from.contains("rectangle")) {
        fault.rectangle.emplace();
        for (size_t i = 0; i < fault.rectangle->size(); ++i)
            (*fault.rectangle)[i] = whole_number<int>(from["rectangle"].at(i), "rectangle");
    }
    fault.command = text(from, "command");
    fault.value = maybe_number(from, "value");
    fault.threshold = maybe_number(from, "threshold");
    return fault;
}

ordered_json json_of(const Threshold& threshold) {
    ordered_json to{{"quantity", threshold.quantity},
                    {"value", of(threshold.value)},
                    {"higher_is_better", threshold.higher_is_better}};
    put(to, "fail", threshold.fail);
    put(to, "warn", threshold.warn);
    if (threshold.automatic)
        to["automatic"] = true;
    return to;
}

Threshold threshold_of(const ordered_json& from) {
    return {from.at("quantity").get<std::string>(),
            number(from.at("value"), "value"),
            from.at("higher_is_better").get<bool>(),
            maybe_number(from, "fail"),
            maybe_number(from, "warn"),
            from.value("automatic", false)};
}

ordered_json json_of(const Measurement& measured) {
    ordered_json to{{"command", measured.command}};
    put(to, "reference", measured.reference);
    put(to, "test", measured.test);
    to["status"] = status_name(measured.status);
    for (const Threshold& threshold : measured.thresholds)
        to["thresholds"].push_back(json_of(threshold));
    put_list(to, "quantities", measured.quantities);
    if (!measured.histogram.empty())
        to["histogram"] = measured.histogram;
    put(to, "worst", measured.worst);
    to["pixels"] = measured.pixels;
    put_list(to, "exposures", measured.exposures);
    put_list(to, "parameters", measured.parameters);
    put_list(to, "settings", measured.settings);
    put(to, "verdict", measured.verdict);
    put(to, "sentence", measured.sentence);
    if (!measured.evidence.empty())
        to["evidence"] = measured.evidence;
    if (!measured.warnings.empty())
        to["warnings"] = measured.warnings;
    if (!measured.attribution.empty())
        to["attribution"] = parse_json<ordered_json>(measured.attribution);
    return to;
}

Measurement measurement_of(const ordered_json& from) {
    Measurement measured;
    measured.command = from.at("command").get<std::string>();
    measured.reference = text(from, "reference");
    measured.test = text(from, "test");
    measured.status = status_from(from);
    if (from.contains("threshold")) // as it was written before there could be several
        measured.thresholds.push_back(threshold_of(from["threshold"]));
    for (const ordered_json& threshold : from.value("thresholds", ordered_json::array()))
        measured.thresholds.push_back(threshold_of(threshold));
    measured.quantities = numbers(from, "quantities");
    for (const ordered_json& bucket : from.value("histogram", ordered_json::array()))
        measured.histogram.push_back(whole_number<long long>(bucket, "histogram"));
    measured.worst = maybe_position(from, "worst");
    measured.pixels = whole_number<long long>(from.at("pixels"), "pixels");
    for (const ordered_json& stops : from.value("exposures", ordered_json::array()))
        measured.exposures.push_back(number(stops, "exposures"));
    measured.parameters = numbers(from, "parameters");
    measured.settings = texts(from, "settings");
    measured.verdict = text(from, "verdict");
    measured.sentence = text(from, "sentence");
    measured.evidence = values<std::string>(from, "evidence");
    measured.warnings = values<std::string>(from, "warnings");
    if (from.contains("attribution")) {
        if (!from["attribution"].is_object())
            throw std::runtime_error("\"attribution\" is " + shown_json(from["attribution"]) +
                                     ", not an object");
        measured.attribution = one_line(from["attribution"]);
    }
    return measured;
}

void put_suite(ordered_json& to, const SuiteCase& of_suite) {
    if (!of_suite.check.empty())
        to["check"] = of_suite.check;
    if (of_suite.line > 0)
        to["line"] = of_suite.line;
    put(to, "why", of_suite.why);
    put(to, "sha256", of_suite.sha256);
    put(to, "key", of_suite.key);
    for (const Tried& one : of_suite.tried) {
        to["tried"].push_back(
            {{"file", one.file}, {"status", one.status}, {"badness", of(one.badness)}});
    }
}

SuiteCase suite_case_of(const ordered_json& from) {
    SuiteCase found;
    found.check = values<std::string>(from, "check");
    found.line = from.contains("line") ? whole_number<int>(from["line"], "line") : 0;
    found.why = text(from, "why");
    found.sha256 = text(from, "sha256");
    found.key = text(from, "key");
    for (const ordered_json& one : from.value("tried", ordered_json::array()))
        found.tried.push_back({one.at("file").get<std::string>(),
                               one.at("status").get<std::string>(),
                               number(one.at("badness"), "badness")});
    return found;
}

// Without its record.
ordered_json json_of(const FrameResult& frame) {
    ordered_json to{{"frame", frame.frame}};
    put_names(to, frame.item());
    if (frame.test_frame)
        to["test_frame"] = *frame.test_frame;
    to["status"] = status_name(frame.status);
    put(to, "message", frame.message);
    put(to, "reference", frame.reference);
    put(to, "test", frame.test);
    put_suite(to, frame.of_suite);
    for (const Measurement& measured : frame.measurements)
        to["measurements"].push_back(json_of(measured));
    for (const Fault& fault : frame.faults)
        to["faults"].push_back(json_of(fault));
    if (!frame.warnings.empty())
        to["warnings"] = frame.warnings;
    if (!frame.against.empty())
        to["against"] = parse_json<ordered_json>(frame.against);
    return to;
}

// The record of a frame, or its index among those that were taken out of the text.
std::string record_of(const ordered_json& from, const std::vector<std::string>& records) {
    if (!from.contains("qc"))
        return "";
    const ordered_json& qc = from["qc"];
    const bool taken = qc.is_number_unsigned() && qc.get<size_t>() < records.size();
    return taken ? records[qc.get<size_t>()] : one_line(qc);
}

} // namespace

void put_names(ordered_json& to, const Item& item) {
    put(to, "name", item.name);
    put(to, "method", item.method);
    put(to, "view", item.view);
}

std::string frame_text(const FrameResult& frame, bool record, size_t depth) {
    ordered_json json = json_of(frame);
    const bool has_record = record && !frame.qc.empty();
    if (has_record)
        json["qc"] = 0;
    std::string text = laid_out(one_line(json), depth);
    if (has_record) {
        const size_t end = text.rfind('0');
        text.replace(end, 1, laid_out(frame.qc, depth + 1));
    }
    return printable_json(text);
}

FrameResult frame_from(const ordered_json& from, const std::vector<std::string>& records) {
    FrameResult frame;
    frame.frame = whole_number<int>(from.at("frame"), "frame");
    frame.view = text(from, "view");
    frame.name = text(from, "name");
    frame.method = text(from, "method");
    if (from.contains("test_frame"))
        frame.test_frame = whole_number<int>(from["test_frame"], "test_frame");
    frame.status = status_from(from);
    frame.message = text(from, "message");
    frame.reference = text(from, "reference");
    frame.test = text(from, "test");
    frame.of_suite = suite_case_of(from);
    const ordered_json none = ordered_json::array();
    each_of(from.contains("measurements") ? from["measurements"] : none, "measurements",
            [&](const ordered_json& one, const std::string&) {
                frame.measurements.push_back(measurement_of(one));
            });
    each_of(from.contains("faults") ? from["faults"] : none, "faults",
            [&](const ordered_json& one, const std::string&) {
                frame.faults.push_back(fault_of(one));
            });
    frame.warnings = values<std::string>(from, "warnings");
    frame.qc = record_of(from, records);
    frame.against = from.contains("against") ? one_line(from["against"]) : "";
    judge_from_numbers(frame);
    return frame;
}

ordered_json suite_json(const SuiteOrigin& suite) {
    ordered_json to = ordered_json::object();
    put(to, "name", suite.name);
    put(to, "file", suite.file);
    put(to, "sha256", suite.sha256);
    put(to, "store", suite.store);
    put(to, "key", suite.key);
    to["test_line"] = suite.test_line;
    return to;
}

SuiteOrigin suite_from_json(const ordered_json& from) {
    return {text(from, "name"),   text(from, "file"),
            text(from, "sha256"), text(from, "store"),
            text(from, "key"),    whole_number<int>(from.at("test_line"), "test_line")};
}

ordered_json exposures_json(const ShotExposures& exposures) {
    ordered_json to{{"max_luminance", of(exposures.max_luminance)},
                    {"median_luminance", of(exposures.median_luminance)},
                    {"frames", exposures.frames}};
    if (!exposures.references.empty())
        to["references"] = exposures.references;
    return to;
}

ShotExposures exposures_from(const ordered_json& from) {
    return {number(from.at("max_luminance"), "max_luminance"),
            number(from.at("median_luminance"), "median_luminance"),
            whole_number<int>(from.at("frames"), "frames"), values<std::string>(from, "references"),
            ""};
}

} // namespace tonetool::sequence
