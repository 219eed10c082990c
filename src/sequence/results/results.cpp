// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/results.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "sequence/against/against.h"
#include "sequence/frames/file_sequence.h"
#include "sequence/qc/qc.h"
#include "sequence/results/automatic_limits.h"
#include "sequence/results/measuring.h"
#include "sequence/verdict/accepted.h"
#include "tonetool/bias.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

constexpr std::array<const char*, 10> kStatusNames{
    "passed",        "measured", "skipped",    "warning", "failed",
    "size mismatch", "missing",  "unreadable", "error",   "crashed"};
constexpr std::array<const char*, 3> kSeverityNames{"info", "warning", "error"};

constexpr char kNothingMeasured[] = "nothing was measured";
constexpr double kWorstBadness = 1e300;

template <class Enum, size_t N>
std::optional<Enum> named(const std::array<const char*, N>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt : std::optional<Enum>(Enum(found - names.begin()));
}

std::string text_of(const Threshold& threshold, double limit) {
    return format("{} {:.6g} {} {:.6g}", threshold.quantity, threshold.value,
                  threshold.higher_is_better ? "<" : ">", limit);
}

void add_text(std::string& list, const std::string& text) {
    list += (list.empty() ? "" : ", ") + text;
}

bool holds(const Threshold& threshold, double limit) {
    return threshold.higher_is_better ? threshold.value >= limit : threshold.value <= limit;
}

struct Found {
    Status status;
    std::string message;
};

bool undecided(const Measurement& measurement) {
    return measurement.verdict == ToneAlgo::bias_verdict_name(BiasVerdict::NotEnoughSamples);
}

bool is_unlooked_at(const FrameResult& frame) {
    return frame.measurements.empty() && frame.faults.empty() && frame.qc.empty() &&
           frame.against.empty();
}

// All thresholds must hold; the message names those that do not.
Found of_thresholds(const Measurement& measurement) {
    std::string failed, warned;
    bool tested = false;
    for (const Threshold& threshold : measurement.thresholds) {
        if (threshold.automatic && threshold.fail && std::isnan(*threshold.fail)) {
            add_text(failed,
                     format("{}: fail=auto found no limit: it needs {} frames, most of them "
                            "alike",
                            threshold.quantity, kEnoughForLimit));
            continue;
        }
        tested = tested || threshold.fail || threshold.warn;
        if (threshold.fail && !holds(threshold, *threshold.fail))
            add_text(failed, text_of(threshold, *threshold.fail));
        else if (threshold.warn && !holds(threshold, *threshold.warn))
            add_text(warned, text_of(threshold, *threshold.warn));
    }
    const std::string start = measurement.command + ": ";
    const bool in_words = !measurement.verdict.empty();
    if (!failed.empty())
        return {Status::Failed, start + (in_words ? measurement.sentence : failed)};
    if (!warned.empty())
        return {Status::Warning, start + (in_words ? measurement.sentence : warned)};
    if (undecided(measurement)) // neither, also where that is accepted
        return {Status::Measured, start + measurement.sentence};
    return {tested ? Status::Passed : Status::Measured, ""};
}

Found of_fault(const Fault& fault) {
    return {fault.severity == Severity::Error     ? Status::Failed
            : fault.severity == Severity::Warning ? Status::Warning
                                                  : Status::Passed,
            fault.sentence};
}

// The threshold's value in units of its limit; 1 is the limit.
double excess(const Threshold& threshold) {
    const auto limit = threshold.fail ? threshold.fail : threshold.warn;
    if (!limit || std::isnan(*limit))
        return 0;
    const double over = threshold.higher_is_better ? *limit : threshold.value;
    const double under = threshold.higher_is_better ? threshold.value : *limit;
    if (std::isnan(threshold.value))
        return kWorstBadness;
    // This includes 0 for a limit of 0, which holds.
    return over <= 0 ? 0 : under > 0 ? over / under : kWorstBadness;
}

// The number of faults; of as many those are worse of which one is further from its limit.
double faultiness(const FrameResult& frame) {
    double count = 0, share = 0;
    for (const Fault& fault : frame.faults) {
        if (fault.severity == Severity::Info)
            continue;
        ++count;
        if (fault.value && fault.threshold && *fault.threshold != 0)
            share = std::max(share, 1 - 1 / (1 + std::abs(*fault.value / *fault.threshold)));
    }
    return count + share / 2;
}

std::map<Status, size_t> count_of_each(const ShotResult& shot) {
    std::map<Status, size_t> counts;
    for (const FrameResult& frame : shot.frames)
        ++counts[frame.status];
    return counts;
}

std::string name_of(const FrameResult& frame) {
    return item_name(frame.item()) +
           (frame.test_frame ? " (test " + std::to_string(*frame.test_frame) + ")" : "");
}

// The description of the worst frame if it is not bad: the limit that was nearest, else a number.
std::string measured_text(const FrameResult& frame) {
    if (!frame.message.empty() || frame.measurements.empty() ||
        frame.measurements.front().quantities.empty())
        return frame.message;
    const Measurement& first = frame.measurements.front();
    const auto nearest = std::max_element(
        first.thresholds.begin(), first.thresholds.end(),
        [](const Threshold& a, const Threshold& b) { return excess(a) < excess(b); });
    if (!first.verdict.empty())
        return "";
    if (nearest != first.thresholds.end()) {
        return format("{}: {} {:.6g} {} {:.6g}", first.command, nearest->quantity, nearest->value,
                      nearest->higher_is_better ? ">=" : "<=",
                      nearest->fail.value_or(nearest->warn.value_or(0)));
    }
    const auto& [quantity, value] = frame.measurements.front().quantities.front();
    return format("{}: {} {:.6g}", frame.measurements.front().command, quantity, value);
}

// How many frames are to be called different by chance: every test may be wrong in so many.
std::string false_alarms_text(const ShotResult& shot) {
    double expected = 0;
    for (const FrameResult& frame : shot.frames)
        for (const Measurement& measured : frame.measurements)
            for (const auto& [name, value] : measured.parameters)
                expected += !measured.verdict.empty() && name == "alpha" ? value : 0;
    return shot.frames.size() > 1 && expected > 0
               ? format("; false alarms of biascheck to be expected: at most {:.3g}", expected)
               : "";
}

// "2 warnings, 1 failed".
std::string counts_text(const ShotResult& shot) {
    std::vector<std::string> parts;
    const std::map<Status, size_t> counts = count_of_each(shot);
    for (auto item = counts.rbegin(); item != counts.rend(); ++item) {
        const bool noun = item->first == Status::Warning || item->first == Status::Error;
        const bool mismatch = item->first == Status::SizeMismatch;
        const char* plural = item->second == 1 ? "" : noun ? "s" : mismatch ? "es" : "";
        parts.push_back(format("{} {}{}", item->second, status_name(item->first), plural));
    }
    return OIIO::Strutil::join(parts, ", ");
}

// "12 of 40", where not all were asked for.
std::string of_text(const ShotResult& shot) {
    const size_t count = shot.frames.size();
    return shot.cases > count ? format("{} of {}", count, shot.cases) : format("{}", count);
}

// Cases that were compared with an image of any machine, where --key asks for another.
std::string other_key_text(const ShotResult& shot) {
    if (!shot.suite || shot.suite->key.empty())
        return "";
    const auto count =
        std::count_if(shot.frames.begin(), shot.frames.end(), [&](const FrameResult& frame) {
            return frame.of_suite.key != shot.suite->key && !frame.of_suite.sha256.empty() &&
                   frame.status <= Status::Failed;
        });
    return count == 0
               ? ""
               : format("; {} compared with images without the key {}", count, shot.suite->key);
}

std::string sentence_of(const ShotResult& shot) {
    if (std::all_of(shot.frames.begin(), shot.frames.end(),
                    [](const FrameResult& frame) { return frame.status == Status::Skipped; }))
        return "all of " + of_text(shot) + " cases are skipped: nothing was checked";
    const FrameResult& worst = shot.frames[shot.worst.front()];
    const std::string why = measured_text(worst);
    if (is_still(shot)) {
        const bool told = has_problem(shot.verdict) || !worst.message.empty();
        return "1 image: " + counts_text(shot) + (told ? " (" + why + ")" : "");
    }
    const bool named = is_named(shot);
    const size_t all = std::max(shot.cases, shot.frames.size());
    std::string text = format("{} {}{}: {}", of_text(shot), named ? "case" : "frame",
                              all == 1 ? "" : "s", counts_text(shot));
    text += other_key_text(shot) + false_alarms_text(shot);
    if (std::any_of(shot.frames.begin(), shot.frames.end(), has_automatic_limit))
        text += "; fail=auto finds frames unlike the others, not what all of them have";
    if (has_problem(shot.verdict) || (shot.frames.size() > 1 && !why.empty()))
        text += format("; worst: {}{}{}", named ? "" : "frame ", name_of(worst),
                       why.empty() ? "" : " (" + why + ")");
    return text;
}

void sort_frames(std::vector<FrameResult>& frames) {
    std::sort(frames.begin(), frames.end(),
              [](const FrameResult& a, const FrameResult& b) { return a.item() < b.item(); });
    const auto twice = std::adjacent_find(
        frames.begin(), frames.end(),
        [](const FrameResult& a, const FrameResult& b) { return a.item() == b.item(); });
    if (twice != frames.end())
        throw std::runtime_error(item_title(twice->item()) + " is there twice");
}

std::vector<size_t> by_badness(const std::vector<FrameResult>& frames) {
    std::vector<size_t> order(frames.size());
    for (size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    const auto key = [&](size_t i) {
        const Status status = frames[i].status;
        return std::make_tuple(status == Status::Skipped ? 1 : -int(status), -badness(frames[i]),
                               i);
    };
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
    return order;
}

} // namespace

bool is_still(const ShotResult& shot) {
    return shot.frames.size() == 1 && shot.frames.front().frame == 0 &&
           !shot.frames.front().item().named() &&
           std::none_of(shot.check.begin(), shot.check.end(), is_pattern);
}

std::string status_name(Status status) {
    return kStatusNames.at(size_t(status));
}

bool has_problem(Status status) {
    return status > Status::Skipped;
}

Status verdict_of(const std::vector<Status>& frames) {
    std::optional<Status> worst;
    for (const Status one : frames)
        if (one != Status::Skipped)
            worst = std::max(worst.value_or(one), one);
    return worst.value_or(Status::Error);
}

std::optional<Status> status_of_name(const std::string& name) {
    return named<Status>(kStatusNames, name);
}

int exit_status(Status status, bool warnings_exit) {
    if (status > Status::Failed)
        return 1;
    return status == Status::Failed ? 3 : (status == Status::Warning && warnings_exit ? 2 : 0);
}

std::string window_text(const std::array<int, 4>& window) {
    return format("{}x{}{:+}{:+}", window[2], window[3], window[0], window[1]);
}

std::string severity_name(Severity severity) {
    return kSeverityNames.at(size_t(severity));
}

std::optional<Severity> severity_of_name(const std::string& name) {
    return named<Severity>(kSeverityNames, name);
}

bool is_named(const ShotResult& shot) {
    return std::any_of(shot.frames.begin(), shot.frames.end(),
                       [](const FrameResult& frame) { return frame.item().named(); });
}

std::string check_name(const ShotResult& shot) {
    return shot.suite && !shot.suite->name.empty() ? shot.suite->name : "check";
}

std::vector<Status> statuses_of(const ShotResult& shot) {
    std::vector<Status> frames;
    for (const FrameResult& frame : shot.frames)
        frames.push_back(frame.status);
    return frames;
}

bool is_unmeasured(const FrameResult& frame) {
    return frame.status == Status::Error && frame.message == kNothingMeasured;
}

void judge(FrameResult& frame) {
    if (frame.status == Status::Skipped && is_unlooked_at(frame))
        return;
    std::vector<Found> found;
    for (Measurement& measurement : frame.measurements) {
        found.push_back(of_thresholds(measurement));
        measurement.status = found.back().status;
    }
    for (const Fault& fault : frame.faults) // what is only told is no test that was passed
        if (fault.severity > Severity::Info || frame.unjudged.empty())
            found.push_back(of_fault(fault));
    for (const std::string& warning : frame.warnings)
        found.push_back({Status::Warning, warning});
    if (frame.status > Status::Failed)
        return;
    frame.message.clear();
    const bool searched = !frame.qc.empty() || !frame.against.empty();
    if (frame.measurements.empty() && frame.faults.empty() && !searched) {
        frame.status = Status::Error;
        frame.message = kNothingMeasured;
        return;
    }
    // A frame passes if --qc and --against found nothing or a threshold held; measurements alone do
    // not pass it.
    const auto any = [&](auto is) { return std::any_of(found.begin(), found.end(), is); };
    const auto open = [](const Found& one) {
        return one.status == Status::Measured && !one.message.empty();
    };
    const bool tested = any([](const Found& one) { return one.status == Status::Passed; });
    const bool judged = !frame.qc.empty() || (!frame.against.empty() && frame.unjudged.empty());
    frame.status = !any(open) && (tested || judged) ? Status::Passed : Status::Measured;
    if (frame.status == Status::Measured)
        frame.message = frame.unjudged;
    for (const Found& one : found) {
        if (open(one) && frame.status == Status::Measured && frame.message.empty())
            frame.message = one.message;
        if (has_problem(one.status) && one.status > frame.status) {
            frame.status = one.status;
            frame.message = one.message;
        }
    }
}

bool is_undecided(const FrameResult& frame) {
    return frame.status <= Status::Warning &&
           std::any_of(frame.measurements.begin(), frame.measurements.end(), undecided);
}

std::optional<double> quantity_of(const Measurement& measured, const std::string& name) {
    const auto& all = measured.quantities;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == name; });
    return found == all.end() ? std::nullopt : std::optional<double>(found->second);
}

double badness(const FrameResult& frame) {
    double most = 0;
    for (const Measurement& measurement : frame.measurements) {
        const double bound = quantity_of(measurement, "bound").value_or(0);
        if (!measurement.verdict.empty() && !(measurement.status <= Status::Passed))
            most = std::max(most, std::isfinite(bound) ? bound : kWorstBadness);
        for (const Threshold& threshold : measurement.thresholds)
            most = std::max(most, measurement.verdict.empty() ? excess(threshold) : 0);
    }
    if (most > 0)
        return most;
    most = faultiness(frame);
    const auto& all = frame.measurements;
    if (most > 0 || all.empty() || all.front().quantities.empty())
        return most;
    const auto& [quantity, value] = all.front().quantities.front();
    if (std::isnan(value))
        return kWorstBadness;
    return higher_is_better(all.front().command, quantity) ? -value : std::max(value, 0.0);
}

void conclude(ShotResult& shot, bool keep_records) {
    sort_frames(shot.frames);
    set_automatic_limits(shot.frames);
    judge_qc(shot.frames, keep_records);
    judge_against(shot.frames);
    accept_faults(shot);
    shot.worst = by_badness(shot.frames);
    if (shot.frames.empty()) {
        shot.verdict = Status::Error;
        shot.sentence = "no frame was checked";
        return;
    }
    shot.verdict = verdict_of(statuses_of(shot));
    const auto good = [&](size_t i) { return !has_problem(shot.frames[i].status); };
    const auto end = std::find_if(shot.worst.begin(), shot.worst.end(), good);
    shot.worst.erase(end == shot.worst.begin() ? end + 1 : end, shot.worst.end());
    shot.sentence = sentence_of(shot);
}

} // namespace tonetool::sequence
