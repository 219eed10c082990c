// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/trust.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <map>
#include <stdexcept>

#include "sequence/against/against_record.h"
#include "sequence/qc/qc_json.h"
#include "sequence/verdict/asked.h"
#include "sequence/verdict/contradiction.h"
#include "sequence/verdict/held.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

std::string name_of(const FrameResult& frame) {
    return item_title(frame.item());
}

// What is wrong with a measurement as one of a word, as the end of a sentence.
std::string problem(const Measurement& measured, const Asked& asked) {
    if (asked.limited && measured.thresholds.empty())
        return " has no threshold, though the check gives it a limit";
    std::string why = contradictory_thresholds(measured);
    if (why.empty() && !asked.open)
        why = not_held(measured, asked);
    return why.empty() ? contradictory_numbers(measured, asked) : why;
}

void check_measurement(const FrameResult& frame, const Measurement& measured, const Check& check) {
    const auto found = check.asked.find(measured.command);
    if (found == check.asked.end()) {
        if (check.open)
            return;
        throw std::runtime_error(format("{} was measured by {}, which the check does not have",
                                        name_of(frame), measured.command));
    }
    std::string first;
    for (const Asked& asked : found->second) {
        const std::string why = problem(measured, asked);
        if (why.empty())
            return;
        first = first.empty() ? why : first;
    }
    throw std::runtime_error(name_of(frame) + ": " + measured.command + first);
}

// Nothing kept it from being checked.
bool was_looked_at(const FrameResult& frame) {
    return frame.status <= Status::Failed && frame.status != Status::Skipped;
}

// What is asked for of each frame: a row of a suite may say it for its cases.
class Checks {
public:
    explicit Checks(const ShotResult& shot) : m_all(check_of(shot.check)) {}

    const Check& of(const FrameResult& frame) {
        const auto& words = frame.of_suite.check;
        if (words.empty())
            return m_all;
        const auto found = m_own.find(words);
        return found != m_own.end() ? found->second
                                    : m_own.emplace(words, check_of(words)).first->second;
    }

private:
    Check m_all;
    std::map<std::vector<std::string>, Check> m_own;
};

// What a frame that nothing kept from being checked must have.
void check_whole(const FrameResult& frame, const Check& check) {
    if (check.open || check.blocks || !was_looked_at(frame))
        return;
    for (const auto& [command, words] : check.asked) {
        const auto count = std::count_if(
            frame.measurements.begin(), frame.measurements.end(),
            [&name = command](const Measurement& one) { return one.command == name; });
        if (size_t(count) < words.size()) {
            throw std::runtime_error(format("{} has {} measurements by {}, but the check has {}",
                                            name_of(frame), count, command, words.size()));
        }
    }
}

using LimitTexts = std::map<std::string, std::string>;

// The limits that a search was given, as it has kept them.
LimitTexts kept_limits(const FrameResult& frame, const std::string& command) {
    const bool qc = command == "qc";
    const std::string& facts = qc ? frame.qc : frame.against;
    if (facts.empty()) {
        throw std::runtime_error(
            format("{} has nothing of --{}, which the check has", name_of(frame), command));
    }
    if (qc && frame.record)
        return frame.record->limits.texts();
    return qc ? qc_from_json(facts).limits.texts() : against_from_json(facts).limits.texts();
}

void check_search(const FrameResult& frame, const std::string& command, const LimitTexts& limits) {
    const bool open = std::any_of(limits.begin(), limits.end(), [](const auto& one) {
        return one.second.find('{') != std::string::npos;
    });
    if (kept_limits(frame, command) != limits && !open) {
        throw std::runtime_error(
            format("{} was searched by --{} with other limits than those of the check",
                   name_of(frame), command));
    }
}

} // namespace

void judge_from_numbers(FrameResult& frame) {
    const Status said = frame.status;
    judge(frame);
    const Status found = frame.status;
    if (found == said)
        return;
    if (!has_problem(found) || found < said) {
        throw std::runtime_error(
            format("{} is called \"{}\", but its numbers and faults say \"{}\"", name_of(frame),
                   status_name(said), status_name(found)));
    }
    frame.warnings.push_back(format("it was called \"{}\", but its numbers and faults say \"{}\"",
                                    status_name(said), status_name(found)));
    judge(frame);
}

void check_limits(const ShotResult& shot) {
    Checks checks(shot);
    for (const FrameResult& frame : shot.frames) {
        const Check& check = checks.of(frame);
        for (const Measurement& measured : frame.measurements)
            check_measurement(frame, measured, check);
        check_whole(frame, check);
        if (frame.status == Status::Skipped && !shot.suite)
            throw std::runtime_error(name_of(frame) + " is skipped, and the check is no suite");
    }
}

void check_searches(const ShotResult& shot) {
    Checks checks(shot);
    for (const FrameResult& frame : shot.frames) {
        const Check& check = checks.of(frame);
        if (!check.open && !check.blocks && was_looked_at(frame))
            for (const auto& [command, limits] : check.searches)
                check_search(frame, command, limits);
    }
}

} // namespace tonetool::sequence
