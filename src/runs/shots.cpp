// SPDX-License-Identifier: BSD-3-Clause
#include "runs/shots.h"

#include <algorithm>
#include <set>
#include <utility>

#include "sequence/results/json_text.h"
#include "sequence/results/shot_exposures.h"
#include "text/error.h"
#include "tonetool/shot.h"

namespace tonetool::runs {

namespace {

std::string frame_name(const sequence::Item& item) {
    return std::to_string(item.frame) + (item.view.empty() ? "" : " (" + item.view + ")");
}

} // namespace

std::string shot_text(const ShotStatistics& shot) {
    std::string text, why;
    if (!ToneAlgo::shot_text(text, shot, why))
        throw CommandError(why);
    return text;
}

ShotStatistics shot_of_text(const std::string& text) {
    ShotStatistics shot;
    std::string why;
    if (!ToneAlgo::shot_of_text(shot, text, why))
        throw CommandError(why);
    return shot;
}

std::vector<ShotCommand> shots_to_measure(const FramePlan& plan) {
    std::vector<ShotCommand> all;
    const bool several = plan.loops && plan.runs.size() > 1 && !plan.named;
    const bool only = plan.check.has("statistics") && plan.check.exposures != "shot";
    for (const ShotCommand& one : plan.check.shots)
        if ((one.need.asked && plan.loops && !plan.named) || several || only)
            all.push_back(one);
    return all;
}

bool is_shot_file(const std::string& file) {
    const auto json = sequence::parsed_or_null(sequence::read_text(file));
    return json.is_object() && json.value("format", "") == "tonetool-shot";
}

std::string merged_shots(const std::vector<std::string>& parts,
                         const std::vector<sequence::Item>& expected) {
    std::vector<ShotStatistics> all;
    std::string why;
    for (const std::string& file : parts)
        if (!ToneAlgo::read_shot(all.emplace_back(), file, why))
            throw CommandError(why);
    ShotStatistics shot;
    if (!ToneAlgo::merge_shots(shot, all, why))
        throw CommandError(why);
    std::set<int> there;
    for (const FrameLight& light : shot.frames)
        there.insert(light.frame);
    Strings missing;
    for (const sequence::Item& item : expected)
        if (there.count(item.frame) == 0)
            missing.push_back(std::to_string(item.frame));
    if (!missing.empty())
        throw CommandError("no part has frame" + std::string(missing.size() > 1 ? "s " : " ") +
                           join(missing, ", ") +
                           " (valid: parts of all frames of --frames, or fewer frames)");
    return shot_text(shot);
}

std::string unmeasured_text(const FramePlan& plan, const std::vector<size_t>& failed,
                            const std::string& first_error) {
    Strings names;
    for (const size_t index : failed)
        names.push_back(frame_name(plan.runs[index].frame.item()));
    return "frame" + std::string(names.size() > 1 ? "s " : " ") + join(names, ", ") +
           (names.size() > 1 ? " have" : " has") +
           " no part in the exposure of the shot: " + first_error;
}

} // namespace tonetool::runs
