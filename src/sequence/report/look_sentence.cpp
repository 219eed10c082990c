// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/look_sentence.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <set>
#include <vector>

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;
using OIIO::Strutil::fmt::format;

constexpr size_t kMostReasons = 6;

std::string place_of(const ordered_json& fault) {
    if (fault.contains("rectangle")) {
        const ordered_json& at = fault["rectangle"];
        return format(" ({}x{} at {},{})", at.at(2).get<int>(), at.at(3).get<int>(),
                      at.at(0).get<int>(), at.at(1).get<int>());
    }
    if (fault.contains("position")) {
        return format(" (at {},{})", fault["position"].at(0).get<int>(),
                      fault["position"].at(1).get<int>());
    }
    return "";
}

std::string reason_of(const Fault& fault, const ordered_json& json) {
    return fault.code + (fault.layer.empty() ? "" : " in " + fault.layer) + place_of(json);
}

std::string reason_of(const FrameResult& frame, const ordered_json& json) {
    if (frame.status > Status::Failed)
        return status_name(frame.status);
    // A fault says what is wrong, a limit only that something is.
    const Severity wanted = frame.status == Status::Failed ? Severity::Error : Severity::Warning;
    for (size_t i = 0; i < frame.faults.size(); ++i)
        if (frame.faults[i].severity == wanted)
            return reason_of(frame.faults[i], json.at("faults").at(i));
    return frame.message;
}

// Frames one after another with the same reason.
struct Run {
    const FrameResult *first, *last;
    std::string reason;
};

std::string name_of(const FrameResult& frame) {
    return item_name(frame.item());
}

std::string text_of(const Run& run) {
    const std::string noun = run.first->item().named() ? ""
                             : run.first == run.last   ? "frame "
                                                       : "frames ";
    return noun + name_of(*run.first) + (run.first == run.last ? "" : "-" + name_of(*run.last)) +
           ": " + run.reason;
}

std::vector<Run> runs_of(const ShotResult& shot, const ordered_json& result) {
    std::vector<Run> runs;
    for (size_t i = 0; i < shot.frames.size(); ++i) {
        const FrameResult& frame = shot.frames[i];
        if (!has_problem(frame.status))
            continue;
        const std::string reason = reason_of(frame, result.at("frames").at(i));
        const bool next = !runs.empty() && runs.back().reason == reason &&
                          runs.back().last + 1 == &frame &&
                          runs.back().last->frame + 1 == frame.frame && frame.view.empty() &&
                          series_of(runs.back().last->item()) == series_of(frame.item());
        if (next)
            runs.back().last = &frame;
        else
            runs.push_back({&frame, &frame, reason});
    }
    std::stable_sort(runs.begin(), runs.end(),
                     [](const Run& a, const Run& b) { return a.first->status > b.first->status; });
    return runs;
}

std::string accepted_text(const ShotResult& shot) {
    std::set<size_t> frames;
    for (const Acceptance& accepted : shot.accepted)
        for (size_t i = 0; i < shot.frames.size(); ++i)
            if (shot.frames[i].item() == accepted.item())
                frames.insert(i);
    return frames.empty() ? ""
                          : format("; faults of {} {} accepted", frames.size(),
                                   frames.size() == 1 ? "frame are" : "frames are");
}

} // namespace

std::string look_sentence(const ShotResult& shot, const ordered_json& result) {
    const std::vector<Run> runs = runs_of(shot, result);
    const size_t all = shot.frames.size();
    const bool named = is_named(shot);
    if (runs.empty() && is_still(shot)) {
        return std::string(shot.verdict == Status::Passed
                               ? "The image needs no look"
                               : "Measured only: no limit says whether it needs a look") +
               accepted_text(shot) + ".";
    }
    if (runs.empty()) {
        const std::string noun = named ? "case" : "frame";
        const std::string what =
            shot.verdict == Status::Passed
                ? "No " + noun + " needs a look"
                : "Measured only: no limit says which " + noun + "s need a look";
        return what + accepted_text(shot) + ".";
    }
    const auto bad = std::count_if(shot.frames.begin(), shot.frames.end(),
                                   [](const auto& frame) { return has_problem(frame.status); });
    if (is_still(shot))
        return "The image needs a look: " + runs.front().reason + accepted_text(shot);
    std::vector<std::string> texts;
    size_t told = 0;
    for (size_t i = 0; i < std::min(kMostReasons, runs.size()); ++i) {
        texts.push_back(text_of(runs[i]));
        told += size_t(runs[i].last - runs[i].first) + 1;
    }
    if (told < size_t(bad))
        texts.push_back(format("... {} more", size_t(bad) - told));
    return format("{} of {} {} {} a look: {}{}", bad, all, named ? "cases" : "frames",
                  bad == 1 ? "needs" : "need", OIIO::Strutil::join(texts, "; "),
                  accepted_text(shot));
}

} // namespace tonetool::sequence
