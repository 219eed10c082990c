#include "sequence/results_json.h"

#include <OpenImageIO/strutil.h>
#include <cmath>
#include <stdexcept>

#include "sequence/json_text.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;

// ---- values

ordered_json of(double value) {
    if (std::isnan(value)) {
        return "nan";
    }
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
    for (const auto& [name, value] : list) {
        object[name] = of(value);
    }
    return object;
}

ordered_json of(const std::vector<double>& values) {
    ordered_json list = ordered_json::array();
    for (double value : values) {
        list.push_back(of(value));
    }
    return list;
}

double number(const ordered_json& from) {
    if (from.is_string()) {
        const auto text = from.get<std::string>();
        if (text == "nan") {
            return std::nan("");
        }
        if (text == "inf" || text == "-inf") {
            return text == "inf" ? HUGE_VAL : -HUGE_VAL;
        }
    }
    return from.get<double>();
}

template <class List>
void put_list(ordered_json& to, const char* key, const List& list) {
    if (!list.empty()) {
        to[key] = of(list);
    }
}

template <class Value>
void put(ordered_json& to, const char* key, const std::optional<Value>& value) {
    if (value) {
        to[key] = of(*value);
    }
}

void put(ordered_json& to, const char* key, const std::string& text) {
    if (!text.empty()) {
        to[key] = text;
    }
}

std::string text(const ordered_json& from, const char* key) {
    return from.value(key, std::string());
}

std::optional<double> maybe_number(const ordered_json& from, const char* key) {
    return from.contains(key) ? std::optional<double>(number(from[key])) : std::nullopt;
}

std::optional<Position> maybe_position(const ordered_json& from, const char* key) {
    if (!from.contains(key)) {
        return std::nullopt;
    }
    return Position{from[key].at(0).get<int>(), from[key].at(1).get<int>()};
}

Numbers numbers(const ordered_json& from, const char* key) {
    Numbers list;
    if (from.contains(key)) {
        for (const auto& item : from[key].items()) {
            list.emplace_back(item.key(), number(item.value()));
        }
    }
    return list;
}

Texts texts(const ordered_json& from, const char* key) {
    Texts list;
    if (from.contains(key)) {
        for (const auto& item : from[key].items()) {
            list.emplace_back(item.key(), item.value().get<std::string>());
        }
    }
    return list;
}

template <class Value>
std::vector<Value> values(const ordered_json& from, const char* key) {
    return from.value(key, std::vector<Value>());
}

Status status(const ordered_json& from) {
    const auto name = from.at("status").get<std::string>();
    const auto found = status_of_name(name);
    if (!found) {
        throw std::runtime_error("unknown status \"" + name + "\"");
    }
    return *found;
}

// ---- structs

ordered_json json_of(const Fault& fault) {
    ordered_json to{{"code", fault.code}, {"severity", severity_name(fault.severity)}};
    put(to, "sentence", fault.sentence);
    put(to, "layer", fault.layer);
    put(to, "position", fault.position);
    put(to, "value", fault.value);
    put(to, "threshold", fault.threshold);
    return to;
}

Fault fault_of(const ordered_json& from) {
    Fault fault;
    fault.code = from.at("code").get<std::string>();
    const auto severity = severity_of_name(from.at("severity").get<std::string>());
    if (!severity) {
        throw std::runtime_error("unknown severity " + from.at("severity").dump());
    }
    fault.severity = *severity;
    fault.sentence = text(from, "sentence");
    fault.layer = text(from, "layer");
    fault.position = maybe_position(from, "position");
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
    return to;
}

Threshold threshold_of(const ordered_json& from) {
    return {from.at("quantity").get<std::string>(), number(from.at("value")),
            from.at("higher_is_better").get<bool>(), maybe_number(from, "fail"),
            maybe_number(from, "warn")};
}

ordered_json json_of(const Measurement& measured) {
    ordered_json to{{"command", measured.command}};
    put(to, "reference", measured.reference);
    put(to, "test", measured.test);
    to["status"] = status_name(measured.status);
    if (measured.threshold) {
        to["threshold"] = json_of(*measured.threshold);
    }
    put_list(to, "quantities", measured.quantities);
    if (!measured.histogram.empty()) {
        to["histogram"] = measured.histogram;
    }
    put(to, "worst", measured.worst);
    to["pixels"] = measured.pixels;
    put_list(to, "exposures", measured.exposures);
    put_list(to, "parameters", measured.parameters);
    put_list(to, "settings", measured.settings);
    if (!measured.warnings.empty()) {
        to["warnings"] = measured.warnings;
    }
    return to;
}

Measurement measurement_of(const ordered_json& from) {
    Measurement measured;
    measured.command = from.at("command").get<std::string>();
    measured.reference = text(from, "reference");
    measured.test = text(from, "test");
    measured.status = status(from);
    if (from.contains("threshold")) {
        measured.threshold = threshold_of(from["threshold"]);
    }
    measured.quantities = numbers(from, "quantities");
    measured.histogram = values<long long>(from, "histogram");
    measured.worst = maybe_position(from, "worst");
    measured.pixels = from.at("pixels").get<long long>();
    for (const ordered_json& stops : from.value("exposures", ordered_json::array())) {
        measured.exposures.push_back(number(stops));
    }
    measured.parameters = numbers(from, "parameters");
    measured.settings = texts(from, "settings");
    measured.warnings = values<std::string>(from, "warnings");
    return measured;
}

ordered_json json_of(const FrameResult& frame) {
    ordered_json to{{"frame", frame.frame}};
    put(to, "view", frame.view);
    to["status"] = status_name(frame.status);
    put(to, "message", frame.message);
    put(to, "reference", frame.reference);
    put(to, "test", frame.test);
    for (const Measurement& measured : frame.measurements) {
        to["measurements"].push_back(json_of(measured));
    }
    for (const Fault& fault : frame.faults) {
        to["faults"].push_back(json_of(fault));
    }
    if (!frame.warnings.empty()) {
        to["warnings"] = frame.warnings;
    }
    if (!frame.qc.empty()) {
        to["qc"] = ordered_json::parse(frame.qc);
    }
    return to;
}

FrameResult frame_of(const ordered_json& from) {
    FrameResult frame;
    frame.frame = from.at("frame").get<int>();
    frame.view = text(from, "view");
    frame.status = status(from);
    frame.message = text(from, "message");
    frame.reference = text(from, "reference");
    frame.test = text(from, "test");
    for (const ordered_json& measured : from.value("measurements", ordered_json::array())) {
        frame.measurements.push_back(measurement_of(measured));
    }
    for (const ordered_json& fault : from.value("faults", ordered_json::array())) {
        frame.faults.push_back(fault_of(fault));
    }
    frame.warnings = values<std::string>(from, "warnings");
    frame.qc = from.contains("qc") ? from["qc"].dump() : "";
    return frame;
}

ordered_json json_of(const ShotExposures& exposures) {
    return {{"max_luminance", of(exposures.max_luminance)},
            {"median_luminance", of(exposures.median_luminance)},
            {"frames", exposures.frames}};
}

ShotExposures exposures_of(const ordered_json& from) {
    return {number(from.at("max_luminance")), number(from.at("median_luminance")),
            from.at("frames").get<int>()};
}

ordered_json worst_of(const ShotResult& shot) {
    ordered_json list = ordered_json::array();
    for (size_t index : shot.worst) {
        const FrameResult& frame = shot.frames.at(index);
        ordered_json one{{"frame", frame.frame}};
        put(one, "view", frame.view);
        list.push_back(one);
    }
    return list;
}

ordered_json counts_of(const ShotResult& shot) {
    ordered_json counts = ordered_json::object();
    for (Status one : {Status::Passed, Status::Measured, Status::Warning, Status::Failed,
                       Status::SizeMismatch, Status::Missing, Status::Unreadable, Status::Error}) {
        counts[status_name(one)] = 0;
    }
    for (const FrameResult& frame : shot.frames) {
        counts[status_name(frame.status)] = counts[status_name(frame.status)].get<int>() + 1;
    }
    return counts;
}

} // namespace

void check_format(const ordered_json& from, const std::string& format, int version) {
    if (!from.is_object() || text(from, "format") != format) {
        throw std::runtime_error("has no \"format\": \"" + format + "\"");
    }
    const int found = from.at("version").get<int>();
    if (found != version) {
        throw std::runtime_error(
            OIIO::Strutil::fmt::format("is of version {}, this program reads {}", found, version));
    }
}

std::string to_json(const ShotResult& shot) {
    ordered_json to{{"format", results_format},
                    {"version", results_version},
                    {"verdict", status_name(shot.verdict)},
                    {"sentence", shot.sentence},
                    {"check", shot.check},
                    {"counts", counts_of(shot)}};
    if (shot.exposures) {
        to["exposures"] = json_of(*shot.exposures);
    }
    to["worst"] = worst_of(shot);
    to["frames"] = ordered_json::array();
    for (const FrameResult& frame : shot.frames) {
        to["frames"].push_back(json_of(frame));
    }
    return dumped(to);
}

ShotResult shot_from_json(const std::string& from) {
    return parsed(from, [](const ordered_json& json) {
        check_format(json, results_format, results_version);
        ShotResult shot;
        shot.check = json.at("check").get<std::vector<std::string>>();
        if (json.contains("exposures")) {
            shot.exposures = exposures_of(json["exposures"]);
        }
        for (const ordered_json& frame : json.at("frames")) {
            shot.frames.push_back(frame_of(frame));
        }
        conclude(shot);
        return shot;
    });
}

std::string to_json(const FrameResult& frame) {
    return dumped(json_of(frame));
}

FrameResult frame_from_json(const std::string& from) {
    return parsed(from, [](const ordered_json& json) { return frame_of(json); });
}

std::string valid_utf8(const std::string& text) {
    const auto quoted =
        ordered_json(text).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    return ordered_json::parse(quoted).get<std::string>();
}

} // namespace tonetool::sequence
