// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/suite/approvable.h"

#include "text/text.h"

namespace tonetool::sequence {

std::string approval_refusal(const FrameResult& frame, bool again) {
    if (frame.status == Status::Skipped)
        return "the suite skips it";
    if (frame.of_suite.sha256.empty())
        return frame.message.empty() ? "its image was not read" : frame.message;
    if (frame.status == Status::Passed)
        return again ? "" : "it passed (--again approves it anyhow)";
    const bool unseen = frame.status == Status::Unreadable || frame.status == Status::Error ||
                        frame.status == Status::Crashed;
    return unseen ? status_name(frame.status) + ", " + frame.message : "";
}

bool is_approvable(const ShotResult& shot, const FrameResult& frame) {
    return shot.suite && !shot.suite->store.empty() && approval_refusal(frame, false).empty();
}

std::vector<const FrameResult*> approvable_cases(const ShotResult& shot) {
    std::vector<const FrameResult*> cases;
    for (const FrameResult& frame : shot.frames)
        if (is_approvable(shot, frame))
            cases.push_back(&frame);
    return cases;
}

std::string approve_start(const std::string& json) {
    return "tonetool --approve " + shell_quoted(json.empty() || json == "-" ? "run.json" : json);
}

std::string approve_line(const std::string& json, const std::string& names) {
    return approve_start(json) + " " + names + " --reason 'WHY'";
}

std::string approve_command(const ShotResult& shot, const std::string& json) {
    std::string names;
    for (const FrameResult* frame : approvable_cases(shot))
        if (frame->status == Status::Failed)
            names += (names.empty() ? "" : " ") + shell_quoted(frame->name);
    return names.empty() ? "" : approve_line(json, names);
}

} // namespace tonetool::sequence
