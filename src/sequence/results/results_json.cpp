// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/results_json.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <stdexcept>

#include "sequence/results/frame_json.h"
#include "sequence/results/json_text.h"
#include "sequence/results/records.h"
#include "sequence/verdict/accepted.h"
#include "sequence/verdict/accepted_json.h"
#include "sequence/verdict/summary.h"
#include "sequence/verdict/trust.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Acceptance& accepted) {
    ordered_json to{{"frame", accepted.frame}};
    put_names(to, accepted.item());
    to["code"] = accepted.code;
    if (!accepted.layer.empty())
        to["layer"] = accepted.layer;
    to["by"] = accepted.by;
    to["why"] = accepted.why;
    return to;
}

void check_has_records(const ordered_json& from) {
    if (!from.value("records", true)) {
        throw std::runtime_error("was written by --json:records=0, without what --qc measured, "
                                 "which the faults of a shot are drawn from (valid: --json)");
    }
}

ShotResult shot_of(const std::string& text, const std::vector<std::string>& records) {
    return parsed(text, [&](const ordered_json& json) {
        check_format(json, kResultsFormat, kResultsVersion);
        check_has_records(json);
        ShotResult shot;
        shot.program = json.value("program", std::string());
        shot.check = json.at("check").get<std::vector<std::string>>();
        if (json.contains("exposures"))
            shot.exposures = exposures_from(json["exposures"]);
        if (json.contains("suite"))
            shot.suite = suite_from_json(json["suite"]);
        if (json.contains("cases"))
            shot.cases = whole_number<size_t>(json["cases"], "cases");
        if (json.contains("accepted"))
            shot.accepted = acceptances_in(json["accepted"]);
        each_of(json.at("frames"), "frames", [&](const ordered_json& one, const std::string&) {
            shot.frames.push_back(frame_from(one, records));
        });
        check_limits(shot);
        conclude(shot, true);
        check_searches(shot);
        std::vector<Status> said;
        for (const ordered_json& frame : json.at("frames"))
            said.push_back(status_from(frame));
        check_summary(json, said, shot);
        return shot;
    });
}

} // namespace

void check_format(const ordered_json& from, const std::string& format, int version) {
    const bool named = from.is_object() && from.contains("format");
    const std::string is = named ? shown_json(from.at("format")) : "";
    if (is != "\"" + format + "\"") {
        const bool statistics = is == "\"tonetool-shot\"" || is == "\"tonetool-exposures\"";
        throw std::runtime_error(
            (named ? "has \"format\": " + is + ", not \"" : "has no \"format\": \"") + format +
            "\"" +
            (statistics && format == kResultsFormat
                 ? " (valid: results of --json; --merge joins statistics with --statistics FILE)"
                 : ""));
    }
    const int found = whole_number<int>(from.at("version"), "version");
    if (found != version) {
        throw std::runtime_error(
            OIIO::Strutil::fmt::format("is of version {}, this program reads {}", found, version));
    }
}

void put_json(const ShotResult& shot, bool records,
              const std::function<void(const std::string& piece)>& to) {
    ordered_json head{{"format", kResultsFormat},   {"version", kResultsVersion},
                      {"program", shot.program},    {"verdict", status_name(shot.verdict)},
                      {"sentence", shot.sentence},  {"check", shot.check},
                      {"id", check_id(shot.check)}, {"counts", counts_of(shot)}};
    if (shot.program.empty())
        head.erase("program");
    if (shot.suite)
        head["suite"] = suite_json(*shot.suite);
    if (shot.cases > 0)
        head["cases"] = shot.cases;
    if (shot.exposures)
        head["exposures"] = exposures_json(*shot.exposures);
    head["worst"] = worst_of(shot);
    for (const Acceptance& accepted : shot.accepted)
        head["accepted"].push_back(json_of(accepted));
    const bool any = std::any_of(shot.frames.begin(), shot.frames.end(),
                                 [](const FrameResult& frame) { return !frame.qc.empty(); });
    if (!records && any)
        head["records"] = false;
    head["frames"] = ordered_json::array();
    const std::string text = dumped(head);
    const size_t list = text.rfind(']'); // where frames go
    to(text.substr(0, list));
    for (const FrameResult& frame : shot.frames)
        to((&frame == shot.frames.data() ? "\n  " : ",\n  ") + frame_text(frame, records, 2));
    to((shot.frames.empty() ? "" : "\n ") + text.substr(list));
}

std::string to_json(const ShotResult& shot, bool records) {
    std::string text;
    put_json(shot, records, [&](const std::string& piece) { text += piece; });
    return text;
}

ShotResult shot_from_json(const std::string& from) {
    if (const auto rest = without_records(from)) {
        try {
            return shot_of(rest->text, rest->records);
        } catch (const std::runtime_error&) {
            // What is wrong is said of the whole text.
        }
    }
    return shot_of(from, {});
}

std::vector<Acceptance> acceptances_in(const ordered_json& list) {
    std::vector<Acceptance> all;
    each_of(list, "accepted", [&](const ordered_json& one, const std::string&) {
        all.push_back({whole_number<int>(one.at("frame"), "frame"),
                       one.value("view", std::string()), one.at("code").get<std::string>(),
                       one.value("layer", std::string()), one.value("by", std::string()),
                       one.value("why", std::string()), one.value("name", std::string()),
                       one.value("method", std::string())});
    });
    return all;
}

std::string json_string(const std::string& text) {
    return one_line(ordered_json(text));
}

std::string to_json(const FrameResult& frame) {
    return frame_text(frame, true, 0) + "\n";
}

FrameResult frame_from_json(const std::string& from) {
    return parsed(from, [](const ordered_json& json) { return frame_from(json); });
}

} // namespace tonetool::sequence
