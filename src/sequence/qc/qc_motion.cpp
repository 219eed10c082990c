// SPDX-License-Identifier: BSD-3-Clause
// Consecutive frames: gaps, near duplicates, flicker.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sequence/qc/qc_thumbnails.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// A change is unusual if it is this many times the usual one.
constexpr double kUnusual = 5;

// The most frequent step between frame numbers (the smallest if several are equally frequent); 0 if
// there is none.
int usual_step(const std::vector<QcFrame>& frames) {
    std::map<int, size_t> count;
    for (size_t i = 1; i < frames.size(); ++i)
        ++count[frames[i].number - frames[i - 1].number];
    int step = 0;
    size_t most = 0;
    for (const auto& [apart, times] : count) {
        if (times > most) {
            most = times;
            step = apart;
        }
    }
    return 2 * most >= frames.size() - 1 ? step : 0;
}

class Flicker {
public:
    Flicker(QcShot& shot, std::vector<QcFrame*> frames)
        : m_shot(shot),
          m_frames(std::move(frames)),
          m_thumbnails(thumbnails_of(m_frames)),
          m_gains{0} {
        for (size_t i = 1; i < m_frames.size(); ++i)
            m_gains.push_back(gain(m_thumbnails[i - 1], m_thumbnails[i]));
        m_usual_step = usual_step_of(m_thumbnails);
        for (size_t i = 1; i < m_gains.size(); ++i)
            m_sorted_gains.push_back(std::abs(m_gains[i]));
        std::sort(m_sorted_gains.begin(), m_sorted_gains.end());
    }

    void find() {
        find_alternation();
        for (size_t length = 1; length <= 3; ++length)
            find_runs(length);
    }

private:
    double apart(size_t a, size_t b) const { return distance(m_thumbnails[a], m_thumbnails[b]); }
    double usual_gain(size_t but) const;
    double detour(size_t first, size_t last) const;
    double there_and_back(size_t first, size_t last) const;
    void find_runs(size_t length);
    void find_alternation();

    QcShot& m_shot;
    std::vector<QcFrame*> m_frames;
    std::vector<Thumbnail> m_thumbnails;
    std::vector<double> m_gains; ///< stops by which each frame is brighter than the one before
    std::vector<double> m_sorted_gains; ///< their sizes
    double m_usual_step = 0;            ///< usual distance of consecutive thumbnails in stops
    double m_unusual = 0;               ///< detours up to this are usual
};

// The median change of brightness over all steps but one.
double Flicker::usual_gain(size_t but) const {
    return median_without(m_sorted_gains, std::abs(m_gains[but]));
}

// The distance, in stops, of frames [first, last] from the path between the frame before and the
// frame after; 0 unless the steps at both ends are large: at a cut only one is.
double Flicker::detour(size_t first, size_t last) const {
    const double there = apart(first - 1, first), back = apart(last, last + 1);
    const double off = (there + back - apart(first - 1, last + 1)) / 2;
    return std::min(there, back) > std::max(off / 2, 2 * m_usual_step) ? off : 0;
}

// The smaller of the changes of brightness before and after these frames, if the two cancel out.
double Flicker::there_and_back(size_t first, size_t last) const {
    const double there = m_gains[first], back = m_gains[last + 1];
    const double step = std::min(std::abs(there), std::abs(back));
    const bool cancel = std::abs(gain(m_thumbnails[first - 1], m_thumbnails[last + 1])) < step / 2;
    return there * back < 0 && cancel && step > kUnusual * usual_gain(first) ? step : 0;
}

// A detour must be several times the usual one of the shot, since noise and fire flicker by nature.
void Flicker::find_runs(size_t length) {
    std::vector<double> detours;
    for (size_t i = 1; i + length < m_frames.size(); ++i)
        detours.push_back(detour(i, i + length - 1));
    m_unusual = std::max(m_unusual, kUnusual * median(detours));
    for (size_t i = 1; i + length < m_frames.size(); ++i) {
        const size_t last = i + length - 1;
        if (m_frames[i]->changed || m_frames[last + 1]->changed)
            continue;
        const double off = detours[i - 1] > m_unusual ? detours[i - 1] : 0;
        const double stops = std::max(off, there_and_back(i, last));
        if (stops <= m_shot.threshold("flicker"))
            continue;
        mark_change(m_frames, i, last);
        m_shot.add(*m_frames[i], "flicker",
                   format("{} unlike frames {} and {} by {:.2f} stops more than these differ from "
                          "each other",
                          length == 1
                              ? "it is"
                              : frames_text(m_frames[i]->number, m_frames[last]->number) + " are",
                          m_frames[i - 1]->number, m_frames[last + 1]->number, stops),
                   {"", {}, stops});
    }
}

// Brighter, darker, brighter, ...: here the neighbours are as unusual as the frame itself.
void Flicker::find_alternation() {
    constexpr size_t enough = 6;
    const double limit = m_shot.threshold("flicker");
    for (size_t first = 1; first < m_frames.size(); ++first) {
        size_t last = first;
        while (last + 1 < m_frames.size() && std::abs(m_gains[last]) > limit &&
               std::abs(m_gains[last + 1]) > limit && m_gains[last] * m_gains[last + 1] < 0)
            ++last;
        if (last - first + 1 >= enough) {
            for (size_t i = first; i <= last; ++i)
                m_frames[i]->changed = true;
            m_shot.add(*m_frames[first], "flicker",
                       format("{} are brighter and darker by turns, by {:.2f} stops at first",
                              frames_text(m_frames[first - 1]->number, m_frames[last]->number),
                              std::abs(m_gains[first])),
                       {"", {}, std::abs(m_gains[first])});
        }
        first = last;
    }
}

} // namespace

void find_gaps(QcShot& shot) {
    std::vector<QcFrame>& frames = shot.frames;
    for (QcFrame& frame : frames)
        if (frame.result->status == Status::Missing)
            shot.add(frame, "missing",
                     frame.measured ? frame.result->message : "the frame is not there");
    const int step = frames.size() > 2 ? usual_step(frames) : 0;
    for (size_t i = 1; step > 0 && i < frames.size(); ++i) {
        const int before = frames[i - 1].number, here = frames[i].number;
        if (here - before > step && (here - before) % step == 0) {
            shot.add(frames[i], "missing",
                     format("{} before this one {} not there",
                            frames_text(before + step, here - step),
                            here - before == 2 * step ? "is" : "are"));
        }
    }
}

// A frozen frame without layers that tell it: the change to it is a small part of the changes
// before and after it. A hold that lasts to the end of the shot is no fault.
void find_stalls(QcShot& shot) {
    constexpr double visible = 0.005; // stops; less is no motion
    const std::vector<QcFrame*> frames = shot.pictures();
    if (frames.size() < 4)
        return;
    const std::vector<Thumbnail> thumbnails = thumbnails_of(frames);
    std::vector<double> change{0};
    for (size_t i = 1; i < frames.size(); ++i)
        change.push_back(distance(thumbnails[i - 1], thumbnails[i]));
    // Beside a flash all motion is small, so the usual change of the shot counts, too.
    const double usual = usual_step_of(thumbnails);
    for (size_t i = 2; i + 1 < frames.size(); ++i) {
        const double around = std::min({change[i - 1], change[i + 1], 2 * usual});
        const double share = around > 0 ? change[i] / around : 1;
        if (!frames[i]->held && around > visible && share < shot.threshold("nearduplicate")) {
            shot.add(*frames[i], "nearduplicate",
                     format("nearly the same picture as frame {}: the change is {:.2g} of that "
                            "around it",
                            frames[i - 1]->number, share),
                     {"", {}, share, {}});
        }
    }
}

void find_flicker(QcShot& shot) {
    std::vector<QcFrame*> frames = shot.pictures();
    if (frames.size() > 2)
        Flicker(shot, std::move(frames)).find();
}

} // namespace tonetool::sequence
