// SPDX-License-Identifier: BSD-3-Clause
// Frames that show a moment again: frozen, duplicate, repeat.
//
// A moment is told by the layers without noise, which are equal where the camera and the geometry
// are; without such layers by the pixels of the picture.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <set>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;
using Frames = std::vector<QcFrame*>;
using Keys = std::vector<std::string>;

// Consecutive frames of one moment.
struct Run {
    size_t first, last;
    size_t length() const { return last - first + 1; }
};

const std::string& hash_of(const QcFrame& frame) {
    return frame.facts.picture.hash;
}

// Coverage of ids is sampled, so ids tell a moment only where nothing else does.
std::string geometry_of(const QcFacts& facts, bool ids) {
    std::string key;
    for (const QcLayer& layer : facts.layers)
        if (!layer.hash.empty() && (layer.kind == "id") == ids)
            key += layer.name + " " + layer.hash + "\n";
    return key.empty() && !ids ? geometry_of(facts, true) : key;
}

std::set<std::string> layers_of(const QcFacts& facts) {
    std::set<std::string> names;
    for (const QcLayer& layer : facts.layers)
        if (!layer.hash.empty())
            names.insert(layer.name);
    return names;
}

} // namespace

std::string moment_of(const QcFacts& facts) {
    return geometry_of(facts, false);
}

namespace {

// With a fixed camera, geometry may stand still while the picture does not.
Keys keys_of(const Frames& frames) {
    Keys geometry, pictures;
    bool all = true;
    for (const QcFrame* frame : frames) {
        geometry.push_back(moment_of(frame->facts));
        pictures.push_back(hash_of(*frame));
        all = all && !geometry.back().empty() &&
              layers_of(frame->facts) == layers_of(frames.front()->facts);
    }
    const size_t moments = std::set<std::string>(geometry.begin(), geometry.end()).size();
    const size_t images = std::set<std::string>(pictures.begin(), pictures.end()).size();
    const bool still = 2 * moments < frames.size() && images > 2 * moments;
    return all && !still ? geometry : pictures;
}

std::vector<Run> runs_of(const Frames& frames, const Keys& keys) {
    const double step = usual_distance(frames);
    std::vector<Run> runs;
    for (size_t i = 0; i < frames.size(); ++i) {
        const bool goes_on =
            i > 0 && keys[i] == keys[i - 1] && frames[i]->number - frames[i - 1]->number == step;
        if (goes_on)
            runs.back().last = i;
        else
            runs.push_back({i, i});
        frames[i]->held = goes_on;
    }
    return runs;
}

// The length of the runs in animation on twos or threes, or where at least a third of the frames
// are held like that; else 1.
size_t intended_length(const std::vector<Run>& runs, size_t frames) {
    constexpr size_t enough = 3, longest = 3;
    constexpr double mostly = 0.7;
    std::map<size_t, size_t> count;
    size_t held = 0;
    for (size_t i = 0; i < runs.size(); ++i) {
        if (i > 0 && i + 1 < runs.size())
            ++count[runs[i].length()];
        if (runs[i].length() <= longest)
            held += runs[i].length() - 1;
    }
    const size_t inner = runs.size() - std::min<size_t>(2, runs.size());
    for (const size_t length : {size_t(2), longest})
        if (inner >= enough && double(count[length]) >= mostly * double(inner))
            return length;
    return 3 * held >= frames && held > 1 ? longest : 1;
}

bool same_pictures(const Frames& frames, const Run& run) {
    return std::all_of(
        frames.begin() + std::ptrdiff_t(run.first), frames.begin() + std::ptrdiff_t(run.last) + 1,
        [&](const QcFrame* frame) { return hash_of(*frame) == hash_of(*frames[run.first]); });
}

// A hold by intent is at an end of the shot, or has the noise of frames that were rendered.
void add_frozen(QcShot& shot, const Frames& frames, const Run& run) {
    const bool inside = run.first > 0 && run.last + 1 < frames.size();
    const bool same = same_pictures(frames, run);
    std::optional<Severity> milder;
    if (!inside || !same)
        milder = Severity::Warning;
    shot.add(*frames[run.first + 1], "frozen",
             format("{} show one moment{}",
                    frames_text(frames[run.first]->number, frames[run.last]->number),
                    same ? "" : ", though not the same pixels"),
             {"", {}, double(run.length()), milder});
}

void add_duplicate(QcShot& shot, const Frames& frames, const Run& run) {
    const int number = frames[run.first]->number;
    shot.add(*frames[run.first + 1], "duplicate",
             same_pictures(frames, run)
                 ? format("the same pixels as frame {}", number)
                 : format("the moment of frame {}, though not the same pixels", number));
}

void find_held(QcShot& shot, const Frames& frames, const std::vector<Run>& runs, size_t intended) {
    for (const Run& run : runs) {
        if (run.length() <= intended)
            continue;
        if (double(run.length()) > shot.threshold("frozen"))
            add_frozen(shot, frames, run);
        else
            add_duplicate(shot, frames, run);
        mark_change(frames, run.first + 1, run.last);
    }
}

// Whether the moment may come again: a pose of rest, or the end of a loop.
bool may_return(const std::vector<Run>& runs, size_t before, size_t here) {
    constexpr size_t rest = 3;
    const size_t first = runs[before].length(), second = runs[here].length();
    const bool closes = before == 0 && here + 1 == runs.size() && second <= first;
    return closes || (first > rest && second > rest);
}

// A frame under a wrong number. Where it happens often, it is a loop.
void find_repeats(QcShot& shot, const Frames& frames, const std::vector<Run>& runs,
                  const Keys& keys) {
    std::map<std::string, size_t> seen;
    std::vector<std::pair<size_t, size_t>> again;
    for (size_t i = 0; i < runs.size(); ++i) {
        const std::string& key = keys[runs[i].first];
        const auto [before, is_new] = seen.emplace(key, i);
        const bool beside = i > 0 && keys[runs[i - 1].first] == key; // with a gap between
        if (!is_new && !beside)
            again.emplace_back(before->second, i);
    }
    if (again.size() > std::max<size_t>(1, runs.size() / 10))
        return;
    for (const auto& [before, here] : again) {
        if (may_return(runs, before, here))
            continue;
        QcFrame& frame = *frames[runs[here].first];
        const QcFrame& first = *frames[runs[before].first];
        shot.add(frame, "repeat",
                 format("the {} of frame {} again, after others",
                        hash_of(frame) == hash_of(first) ? "same pixels" : "moment", first.number));
        mark_change(frames, runs[here].first, runs[here].last);
    }
}

} // namespace

void find_moments(QcShot& shot) {
    const Frames frames = shot.pictures();
    if (frames.size() < 2)
        return;
    const Keys keys = keys_of(frames);
    const std::vector<Run> runs = runs_of(frames, keys);
    if (runs.size() == 1)
        return;
    const size_t intended = intended_length(runs, frames.size());
    find_held(shot, frames, runs, intended);
    if (intended == 1)
        find_repeats(shot, frames, runs, keys);
}

} // namespace tonetool::sequence
