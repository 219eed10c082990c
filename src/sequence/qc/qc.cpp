// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/qc/qc.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <tuple>
#include <utility>

#include "imagebuf/pixels/layer_name.h"
#include "sequence/qc/qc_shot.h"
#include "text/printable.h"

namespace tonetool::sequence {

namespace {

// Sorts faults by severity, then in the order of the rules.
void sort_faults(std::vector<Fault>& faults) {
    const auto key = [](const Fault& fault) {
        return std::make_tuple(-int(fault.severity), rank_of(qc_rules(), fault.code));
    };
    std::stable_sort(faults.begin(), faults.end(),
                     [&](const Fault& a, const Fault& b) { return key(a) < key(b); });
}

void take_record(QcFrame& frame, QcRecord record) {
    frame.facts = std::move(record.facts);
    frame.strays = std::move(record.strays);
    frame.measured = true;
    frame.blank = is_blank(frame.facts, record.limits);
}

// A part of a shot may be so short, and is judged anew when it is merged with others.
void find_few(QcShot& shot) {
    const std::vector<QcFrame*> frames = shot.pictures();
    if (frames.size() > 1 && frames.size() < kEnoughFrames) {
        shot.add(*frames.front(), "fewframes",
                 OIIO::Strutil::fmt::format(
                     "{} frames are too few for the rules that need {}: places, moments, motion "
                     "and statistics were not judged",
                     frames.size(), kEnoughFrames));
    }
}

void search(QcShot& shot) {
    for (QcFrame& frame : shot.frames)
        if (frame.measured)
            find_picture_faults(shot, frame);
    find_stray_files(shot);
    find_blank(shot);
    find_hidden(shot);
    find_enlarged(shot);
    find_bands(shot);
    find_gaps(shot);
    find_odd_headers(shot);
    find_lost_layers(shot);
    find_group_faults(shot);
    find_clamped(shot);
    find_magenta(shot);
    find_holes(shot);
    find_stale_buckets(shot);
    find_moments(shot);
    find_stalls(shot);
    find_odd_motion(shot);
    find_flicker(shot);
    find_fireflies(shot);
    find_odd_statistics(shot);
    find_few(shot);
}

bool is_found_here(const Fault& fault) {
    return fault.command.empty() && rank_of(qc_rules(), fault.code) < qc_rules().size();
}

// The frames of one view with what was found in them; without frames where --qc measured none.
QcShot searched(const std::vector<FrameResult*>& frames, bool keep_records) {
    QcShot shot{FaultLimits(qc_rules())};
    bool any = false;
    shot.frames.reserve(frames.size());
    for (FrameResult* result : frames) {
        QcFrame& frame = shot.frames.emplace_back();
        frame.number = result->frame;
        frame.result = result;
        if (!result->qc.empty()) {
            const auto kept = std::exchange(result->record, nullptr);
            QcRecord record = kept ? std::move(*kept) : qc_from_json(result->qc);
            shot.set_limits(record.limits);
            if (keep_records) {
                const auto limits = std::make_shared<QcRecord>();
                limits->limits = record.limits;
                result->record = limits;
            }
            take_record(frame, std::move(record));
            any = true;
        }
    }
    if (!any)
        return QcShot{FaultLimits(qc_rules())};
    for (FrameResult* result : frames) {
        auto& faults = result->faults;
        faults.erase(std::remove_if(faults.begin(), faults.end(), is_found_here), faults.end());
    }
    search(shot);
    return shot;
}

} // namespace

std::vector<Fault> picture_faults(const QcRecord& record) {
    FrameResult result;
    QcShot shot(record.limits);
    QcFrame& frame = shot.frames.emplace_back();
    frame.result = &result;
    take_record(frame, record);
    search(shot);
    sort_faults(result.faults);
    return result.faults;
}

namespace {

using Views = std::map<std::string, std::vector<FrameResult*>>;

void judge_views(const Views& views, bool keep_records) {
    std::map<std::string, QcShot> shots;
    for (const auto& [view, of_view] : views)
        shots.emplace(view, searched(of_view, keep_records));
    find_eye_faults(shots);
    for (auto& [view, shot] : shots) {
        for (QcFrame& frame : shot.frames) {
            sort_faults(frame.result->faults);
            judge(*frame.result);
            if (frame.measured && keep_records) {
                frame.result->record->facts = std::move(frame.facts);
                frame.result->record->strays = std::move(frame.strays);
            }
        }
    }
}

} // namespace

void judge_qc(std::vector<FrameResult>& frames, bool keep_records) {
    std::sort(frames.begin(), frames.end(),
              [](const FrameResult& a, const FrameResult& b) { return a.item() < b.item(); });
    std::map<std::pair<std::string, std::string>, Views> shots; // of a name and method
    for (FrameResult& frame : frames)
        shots[{frame.name, frame.method}][frame.view].push_back(&frame);
    for (const auto& [of, views] : shots)
        judge_views(views, keep_records);
}

void QcShot::add(QcFrame& frame, const std::string& code, const std::string& sentence,
                 const QcDetail& detail) const {
    const auto severity =
        detail.milder ? m_limits.severity(code, *detail.milder) : m_limits.severity(code);
    if (!severity)
        return;
    Fault fault;
    fault.code = code;
    fault.severity = *severity;
    fault.sentence = sentence;
    fault.layer = detail.layer;
    fault.position = detail.position;
    fault.rectangle = detail.rectangle;
    fault.value = detail.value;
    if (detail.value)
        fault.threshold = threshold(code);
    frame.result->faults.push_back(std::move(fault));
}

std::vector<QcFrame*> QcShot::pictures() {
    std::vector<QcFrame*> chosen = filled();
    chosen.erase(std::remove_if(chosen.begin(), chosen.end(),
                                [](const QcFrame* frame) { return !has_picture(frame->facts); }),
                 chosen.end());
    return chosen;
}

std::vector<QcFrame*> QcShot::filled() {
    std::vector<QcFrame*> chosen;
    for (QcFrame& frame : frames)
        if (frame.measured && !frame.blank)
            chosen.push_back(&frame);
    return chosen;
}

std::vector<QcFrame*> QcShot::measured() {
    std::vector<QcFrame*> chosen;
    for (QcFrame& frame : frames)
        if (frame.measured)
            chosen.push_back(&frame);
    return chosen;
}

void mark_change(const std::vector<QcFrame*>& frames, size_t first, size_t last) {
    frames[first]->changed = true;
    if (last + 1 < frames.size())
        frames[last + 1]->changed = true;
}

const QcLayer* find_layer(const QcFacts& facts, const std::string& name) {
    const auto found = std::find_if(facts.layers.begin(), facts.layers.end(),
                                    [&](const QcLayer& layer) { return layer.name == name; });
    return found == facts.layers.end() ? nullptr : &*found;
}

const QcLayer& no_layer() {
    static const QcLayer none;
    return none;
}

const QcLayer& picture_layer(const QcFacts& facts) {
    const auto found = std::find_if(facts.layers.begin(), facts.layers.end(),
                                    [](const QcLayer& layer) { return layer.kind == "picture"; });
    return found == facts.layers.end() ? no_layer() : *found;
}

bool same_windows(const QcFrame& a, const QcFrame& b) {
    const auto same = [](const QcPart& x, const QcPart& y) {
        return x.data == y.data && x.display == y.display;
    };
    const std::vector<QcPart>&parts = a.facts.parts, &others = b.facts.parts;
    return std::equal(parts.begin(), parts.end(), others.begin(), others.end(), same);
}

std::string frames_text(int first, int last) {
    return first == last ? "frame " + std::to_string(first)
                         : "frames " + std::to_string(first) + " to " + std::to_string(last);
}

std::string layer_text(const QcLayer& layer) {
    return layer.kind == "picture" ? "the picture"
           : layer.kind == "light" ? "light group " + layer.name
                                   : "layer " + shown_layer(layer.name);
}

double median(std::vector<double> values) {
    if (values.empty())
        return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double usual_distance(const std::vector<QcFrame*>& frames) {
    std::vector<double> distances;
    for (size_t i = 1; i < frames.size(); ++i)
        distances.push_back(frames[i]->number - frames[i - 1]->number);
    return median(std::move(distances));
}

double median_without(const std::vector<double>& sorted, double value) {
    if (sorted.size() < 2)
        return 0;
    const size_t middle = (sorted.size() - 1) / 2;
    const auto left_out =
        size_t(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
    return sorted[left_out <= middle ? middle + 1 : middle];
}

} // namespace tonetool::sequence
