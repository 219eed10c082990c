// Frames beside each other: gaps, duplicates, flicker, jumps.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "sequence/qc_thumbnails.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// The step most numbers are apart, the smallest of the most frequent; 0 without a rule.
int usual_step(const std::vector<QcFrame>& frames) {
    std::map<int, size_t> count;
    for (size_t i = 1; i < frames.size(); ++i) {
        ++count[frames[i].number - frames[i - 1].number];
    }
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

// Pixels of a still, or of animation on twos or threes, are those of the frame before by intent.
bool is_held(const std::vector<QcFrame*>& frames) {
    size_t same = 0;
    for (size_t i = 1; i < frames.size(); ++i) {
        same += frames[i]->facts.picture.hash == frames[i - 1]->facts.picture.hash;
    }
    return 3 * same >= frames.size() && same > 1;
}

void find_identical(QcShot& shot, const std::vector<QcFrame*>& frames) {
    if (is_held(frames)) {
        return;
    }
    std::map<std::string, const QcFrame*> first;
    for (QcFrame* frame : frames) {
        const auto [same, is_new] = first.emplace(frame->facts.picture.hash, frame);
        if (!is_new) {
            shot.add(*frame, "duplicate",
                     format("the same pixels as frame {}", same->second->number));
        }
    }
}

// A pair whose change is a small part of the change before it and after it: what moves stands
// still for a frame. A hold that lasts to the end is none.
void find_stalls(QcShot& shot, const std::vector<QcFrame*>& frames,
                 const std::vector<Thumbnail>& thumbnails) {
    constexpr double visible = 0.005; // stops; less is no motion
    std::vector<double> change{0};
    for (size_t i = 1; i < frames.size(); ++i) {
        change.push_back(distance(thumbnails[i - 1], thumbnails[i]));
    }
    for (size_t i = 2; i + 1 < frames.size(); ++i) {
        const double around = std::min(change[i - 1], change[i + 1]);
        const bool identical = frames[i]->facts.picture.hash == frames[i - 1]->facts.picture.hash;
        const double share = around > 0 ? change[i] / around : 1;
        if (!identical && around > visible && share < shot.threshold("near-duplicate")) {
            shot.add(*frames[i], "near-duplicate",
                     format("nearly the same picture as frame {}: the change is {:.2g} of that "
                            "around it",
                            frames[i - 1]->number, share),
                     {"", {}, share});
        }
    }
}

class Flicker {
public:
    Flicker(QcShot& shot, std::vector<QcFrame*> frames)
        : m_shot(shot),
          m_frames(std::move(frames)),
          m_thumbnails(thumbnails_of(m_frames)),
          m_explained(m_frames.size(), false) {}

    void find() {
        for (size_t length = 1; length <= 3; ++length) {
            find_runs(length);
        }
        find_alternation();
        find_jumps();
    }

private:
    double apart(size_t a, size_t b) const { return distance(m_thumbnails[a], m_thumbnails[b]); }
    // How far, in stops, frames [first, last] are off the way from the frame before to that after.
    double detour(size_t first, size_t last) const {
        return (apart(first - 1, first) + apart(last, last + 1) - apart(first - 1, last + 1)) / 2;
    }
    void find_runs(size_t length);
    void find_alternation();
    void find_jumps();
    bool is_jump(size_t i, const std::vector<double>& gains) const;

    QcShot& m_shot;
    std::vector<QcFrame*> m_frames;
    std::vector<Thumbnail> m_thumbnails;
    std::vector<bool> m_explained; ///< the step to this frame from the one before
};

// Five times what is usual in the shot: noise and fire flicker by nature.
void Flicker::find_runs(size_t length) {
    constexpr double unusual = 5;
    std::vector<double> detours;
    for (size_t i = 1; i + length < m_frames.size(); ++i) {
        detours.push_back(detour(i, i + length - 1));
    }
    const double limit =
        std::max(m_shot.threshold("flicker"), unusual * std::max(median(detours), 0.0));
    for (size_t i = 1; i + length < m_frames.size(); ++i) {
        const size_t last = i + length - 1;
        const double off = detours[i - 1];
        const bool there_and_back =
            std::min(apart(i - 1, i), apart(last, last + 1)) > off / 2 && off > limit;
        if (!there_and_back || m_explained[i] || m_explained[last + 1]) {
            continue;
        }
        m_explained[i] = m_explained[last + 1] = true;
        m_shot.add(*m_frames[i], "flicker",
                   format("{} {} unlike frames {} and {} by {:.2f} stops more than these differ "
                          "from each other",
                          frames_text(m_frames[i]->number, m_frames[last]->number),
                          length == 1 ? "is" : "are", m_frames[i - 1]->number,
                          m_frames[last + 1]->number, off),
                   {"", {}, off});
    }
}

// Brighter, darker, brighter, ...: unusual is what the neighbours are.
void Flicker::find_alternation() {
    constexpr size_t enough = 6;
    const double limit = m_shot.threshold("flicker");
    std::vector<double> gains{0};
    for (size_t i = 1; i < m_frames.size(); ++i) {
        gains.push_back(gain(m_thumbnails[i - 1], m_thumbnails[i]));
    }
    for (size_t first = 1; first < m_frames.size(); ++first) {
        size_t last = first;
        while (last + 1 < m_frames.size() && std::abs(gains[last]) > limit &&
               std::abs(gains[last + 1]) > limit && gains[last] * gains[last + 1] < 0) {
            ++last;
        }
        if (last - first + 1 >= enough) {
            std::fill(m_explained.begin() + std::ptrdiff_t(first),
                      m_explained.begin() + std::ptrdiff_t(last + 1), true);
            m_shot.add(*m_frames[first], "flicker",
                       format("{} are brighter and darker by turns, by {:.2f} stops at first",
                              frames_text(m_frames[first - 1]->number, m_frames[last]->number),
                              std::abs(gains[first])),
                       {"", {}, std::abs(gains[first])});
        }
        first = last;
    }
}

// Much more than usual, and than the steps beside it, which a fade has alike.
bool Flicker::is_jump(size_t i, const std::vector<double>& gains) const {
    constexpr double unusual = 6, alone = 3, alike = 0.9;
    const double step = std::abs(gains[i]);
    std::vector<double> others;
    for (size_t k = 1; k < gains.size(); ++k) {
        if (k != i) {
            others.push_back(std::abs(gains[k]));
        }
    }
    const bool first = i == 1, last = i + 1 == gains.size();
    return step > m_shot.threshold("jump") && step > unusual * median(others) &&
           (first || m_explained[i - 1] || step > alone * std::abs(gains[i - 1])) &&
           (last || m_explained[i + 1] || step > alone * std::abs(gains[i + 1])) &&
           correlation(m_thumbnails[i - 1], m_thumbnails[i]) > alike;
}

// A cut changes the picture, too.
void Flicker::find_jumps() {
    std::vector<double> gains{0};
    for (size_t i = 1; i < m_frames.size(); ++i) {
        gains.push_back(gain(m_thumbnails[i - 1], m_thumbnails[i]));
    }
    for (size_t i = 1; i < m_frames.size(); ++i) {
        if (!m_explained[i] && is_jump(i, gains)) {
            m_shot.add(*m_frames[i], "jump",
                       format("{:.2f} stops {} than frame {}, of the same picture",
                              std::abs(gains[i]), gains[i] > 0 ? "brighter" : "darker",
                              m_frames[i - 1]->number),
                       {"", {}, std::abs(gains[i])});
        }
    }
}

} // namespace

void find_gaps(QcShot& shot) {
    std::vector<QcFrame>& frames = shot.frames;
    for (QcFrame& frame : frames) {
        if (frame.result->status == Status::Missing) {
            shot.add(frame, "missing", "the frame is not there");
        }
    }
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

void find_duplicates(QcShot& shot) {
    const std::vector<QcFrame*> frames = shot.pictures();
    find_identical(shot, frames);
    if (frames.size() > 3) {
        find_stalls(shot, frames, thumbnails_of(frames));
    }
}

void find_flicker(QcShot& shot) {
    std::vector<QcFrame*> frames = shot.pictures();
    if (frames.size() > 2) {
        Flicker(shot, std::move(frames)).find();
    }
}

} // namespace tonetool::sequence
