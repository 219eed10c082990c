// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/accepted.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "sequence/results/json_text.h"
#include "sequence/verdict/accepted_json.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;
using OIIO::Strutil::fmt::format;

constexpr char kAcceptedWord[] = "accepted";

Acceptances acceptances_of(const ordered_json& json) {
    if (!json.is_object() || !json.contains("check") || !json.contains("accepted"))
        throw std::runtime_error("has no \"check\" and \"accepted\"");
    Acceptances found;
    found.check = json.at("check").get<std::string>();
    found.accepted = acceptances_in(json.at("accepted"));
    return found;
}

bool is_of(const Acceptance& accepted, const FrameResult& frame) {
    return accepted.item() == frame.item();
}

bool is_of(const Acceptance& accepted, const Fault& fault) {
    return accepted.code == fault.code && (accepted.layer.empty() || accepted.layer == fault.layer);
}

std::string sentence_of(const Acceptance& accepted, const Fault& fault) {
    return std::string(kAcceptedWord) + (accepted.by.empty() ? "" : " by " + accepted.by) +
           (accepted.why.empty() ? "" : " (" + accepted.why + ")") + ": " + fault.sentence;
}

bool accept_in(FrameResult& frame, const std::vector<Acceptance>& all) {
    bool changed = false;
    for (const Acceptance& accepted : all) {
        for (Fault& fault : frame.faults) {
            if (!is_of(accepted, frame) || !is_of(accepted, fault) ||
                fault.severity == Severity::Info)
                continue;
            fault.severity = Severity::Info;
            fault.sentence = sentence_of(accepted, fault);
            changed = true;
        }
    }
    return changed;
}

std::string name_of(const Acceptance& accepted) {
    return format("{}: {}{}", item_title(accepted.item()), accepted.code,
                  accepted.layer.empty() ? "" : " in " + accepted.layer);
}

} // namespace

std::string check_id(const std::vector<std::string>& check) {
    uint64_t hash = 14695981039346656037U; // FNV-1a
    for (const std::string& word : check)
        for (const char c : word + '\0')
            hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211U;
    return format("{:016x}", hash);
}

Acceptances read_acceptances(const std::string& file) {
    std::string text;
    if (!OIIO::Filesystem::read_text_file(file, text))
        throw std::runtime_error(format("could not read the accepted faults \"{}\"", file));
    try {
        return parsed(text, acceptances_of);
    } catch (const std::runtime_error& problem) {
        throw std::runtime_error(format("\"{}\" {} (valid: a file that the report's page exports)",
                                        file, problem.what()));
    }
}

void check_same_check(const Acceptances& acceptances, const std::vector<std::string>& check,
                      const std::string& file) {
    const std::string id = check_id(check);
    if (acceptances.check == id)
        return;
    throw std::runtime_error(format("\"{}\" accepts faults of another check: it is of {}, this one "
                                    "is {} (valid: a file that the page of this check exports)",
                                    file, acceptances.check, id));
}

void accept_faults(ShotResult& shot) {
    for (FrameResult& frame : shot.frames)
        if (!shot.accepted.empty() && accept_in(frame, shot.accepted))
            judge(frame);
}

std::vector<std::string> unused_acceptances(const ShotResult& shot) {
    std::vector<std::string> unused;
    size_t elsewhere = 0;
    for (const Acceptance& accepted : shot.accepted) {
        const auto frame = std::find_if(shot.frames.begin(), shot.frames.end(),
                                        [&](const auto& one) { return is_of(accepted, one); });
        if (frame == shot.frames.end()) {
            ++elsewhere;
            continue;
        }
        const bool there = std::any_of(frame->faults.begin(), frame->faults.end(),
                                       [&](const Fault& fault) { return is_of(accepted, fault); });
        if (!there)
            unused.push_back(name_of(accepted) + " is accepted, but there is no such fault");
    }
    if (elsewhere > 0) {
        unused.push_back(format("{} of {} accepted faults {} of frames that were not checked here",
                                elsewhere, shot.accepted.size(), elsewhere == 1 ? "is" : "are"));
    }
    return unused;
}

} // namespace tonetool::sequence
