// SPDX-License-Identifier: BSD-3-Clause
// What moves as it should not, told by the layers without noise: oddframe, order, skip, pop,
// cutatend.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <set>

#include "imagebuf/pixels/layer_name.h"
#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;
using Frames = std::vector<QcFrame*>;

constexpr size_t kCells = size_t(QcPicture::kWide) * QcPicture::kHigh;

const QcGuide* find_guide(const QcFacts& facts, const QcGuide& like) {
    const auto found =
        std::find_if(facts.guides.begin(), facts.guides.end(), [&](const QcGuide& guide) {
            return guide.layer == like.layer && guide.channels == like.channels;
        });
    return found == facts.guides.end() ? nullptr : &*found;
}

double quantile_of(std::vector<double> values, double share) {
    if (values.empty())
        return 0;
    const auto at = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

// The cells of one layer over the shot, in units of their standard deviation.
class Motion {
public:
    Motion(const Frames& frames, const QcGuide& like);

    size_t frames() const { return m_cells.size(); }
    bool is_plain() const { return m_deviation < 1e-9; }
    /// The mean difference of two frames.
    double apart(size_t a, size_t b) const;
    double step(size_t i) const { return m_steps[i]; } ///< from i to i + 1
    const std::vector<double>& steps() const { return m_steps; }
    double usual() const { return m_usual; }
    /// The largest difference of the channels of a cell in two frames.
    double apart(size_t a, size_t b, size_t cell) const;
    /// How far each cell of frame i is off the mean of those around it.
    std::vector<double> bends(size_t i) const;

private:
    size_t m_channels;
    std::vector<std::vector<float>> m_cells; ///< ten thousand frames may be held
    double m_deviation = 0, m_usual = 0;
    std::vector<double> m_steps;
};

Motion::Motion(const Frames& frames, const QcGuide& like) : m_channels(size_t(like.channels)) {
    double sum = 0, squares = 0;
    for (const QcFrame* frame : frames) {
        std::vector<float>& cells = m_cells.emplace_back();
        for (const int code : find_guide(frame->facts, like)->cells) {
            cells.push_back(float(QcGuide::value(code)));
            sum += double(cells.back());
        }
    }
    const double count = double(m_cells.size() * m_cells.front().size());
    for (const std::vector<float>& cells : m_cells)
        for (const float value : cells)
            squares += (double(value) - sum / count) * (double(value) - sum / count);
    m_deviation = std::sqrt(squares / count);
    for (std::vector<float>& cells : m_cells)
        for (float& value : cells)
            value = float(double(value) / (m_deviation + 1e-12));
    for (size_t i = 0; i + 1 < m_cells.size(); ++i)
        m_steps.push_back(apart(i, i + 1));
    m_usual = median(m_steps);
}

double Motion::apart(size_t a, size_t b) const {
    double sum = 0;
    for (size_t i = 0; i < m_cells[a].size(); ++i)
        sum += std::abs(double(m_cells[a][i]) - double(m_cells[b][i]));
    return sum / double(m_cells[a].size());
}

double Motion::apart(size_t a, size_t b, size_t cell) const {
    double most = 0;
    for (size_t i = cell * m_channels; i < (cell + 1) * m_channels; ++i)
        most = std::max(most, std::abs(double(m_cells[a][i]) - double(m_cells[b][i])));
    return most;
}

std::vector<double> Motion::bends(size_t i) const {
    std::vector<double> bends(kCells);
    for (size_t at = 0; at < m_cells[i].size(); ++at) {
        const double way = (double(m_cells[i - 1][at]) + double(m_cells[i + 1][at])) / 2;
        double& bend = bends[at / m_channels];
        bend = std::max(bend, std::abs(double(m_cells[i][at]) - way));
    }
    return bends;
}

// The searches in one layer. What was told by another layer is not told again.
class MotionSearch {
public:
    MotionSearch(QcShot& shot, const Frames& frames, const Motion& motion, const QcGuide& layer,
                 std::set<size_t>& told)
        : m_shot(shot),
          m_frames(frames),
          m_motion(motion),
          m_layer(layer),
          m_told(told),
          m_distance(usual_distance(frames)) {}

    void find() {
        find_order();
        find_odd();
        find_ends();
        find_skips();
        find_pops();
    }

private:
    bool is_joined(size_t first, size_t last) const;
    void tell(size_t i, const std::string& code, const std::string& sentence);
    void find_odd();
    bool is_odd(size_t i, const std::vector<double>& bends, double limit) const;
    bool is_exchanged(size_t i) const;
    void find_order();
    void find_ends();
    void find_skips();
    void find_pops();

    QcShot& m_shot;
    const Frames& m_frames;
    const Motion& m_motion;
    const QcGuide& m_layer;
    std::string m_name = "layer " + shown_layer(m_layer.layer); ///< for sentences
    std::set<size_t>& m_told;
    double m_distance; ///< the usual one of the numbers
};

// Whether these frames follow each other, and no other rule explains a change between them.
bool MotionSearch::is_joined(size_t first, size_t last) const {
    for (size_t i = first + 1; i <= last; ++i)
        if (m_frames[i]->changed || m_frames[i]->held ||
            m_frames[i]->number - m_frames[i - 1]->number != m_distance ||
            !same_windows(*m_frames[i - 1], *m_frames[i]))
            return false;
    return true;
}

void MotionSearch::tell(size_t i, const std::string& code, const std::string& sentence) {
    if (m_told.insert(i).second)
        m_shot.add(*m_frames[i], code, sentence, {m_layer.layer, {}, {}, {}});
}

// A frame that is off the way, in cells where the frames around it are alike.
bool MotionSearch::is_odd(size_t i, const std::vector<double>& bends, double limit) const {
    constexpr size_t few = 2;
    constexpr double detour = 0.35, near = 0.3;
    const double there = m_motion.step(i - 1), back = m_motion.step(i);
    const double around = m_motion.apart(i - 1, i + 1);
    const double least = std::min(there, back);
    if ((there + back - around) / 2 <= detour * least || least <= near * around)
        return false;
    std::vector<double> bent, local;
    for (size_t cell = 0; cell < bends.size(); ++cell) {
        if (bends[cell] > limit) {
            bent.push_back(bends[cell]);
            local.push_back(m_motion.apart(i - 1, i + 1, cell));
        }
    }
    return bent.size() >= few && median(local) < median(bent);
}

void MotionSearch::find_odd() {
    constexpr double unusual = 5, visible = 0.02, highest = 0.99;
    std::vector<std::vector<double>> bends(m_motion.frames());
    std::vector<double> high;
    for (size_t i = 1; i + 1 < m_motion.frames(); ++i) {
        bends[i] = m_motion.bends(i);
        high.push_back(quantile_of(bends[i], highest));
    }
    const double limit = std::max(unusual * median(std::move(high)), visible);
    for (size_t i = 1; i + 1 < m_motion.frames(); ++i)
        if (is_joined(i - 1, i + 1) && is_odd(i, bends[i], limit))
            tell(i, "oddframe",
                 format("{} is not between those of frames {} and {}, which are alike", m_name,
                        m_frames[i - 1]->number, m_frames[i + 1]->number));
}

// Two frames whose places were exchanged: by the other order the way is shorter.
bool MotionSearch::is_exchanged(size_t i) const {
    constexpr double moves = 0.005, shorter = 0.8, longest = 1.6;
    const double here = m_motion.step(i);
    return m_motion.usual() > moves && is_joined(i - 1, i + 2) &&
           m_motion.apart(i - 1, i + 1) < shorter * m_motion.step(i - 1) &&
           m_motion.apart(i, i + 2) < shorter * m_motion.step(i + 1) &&
           here < longest * m_motion.usual() && m_motion.apart(i - 1, i + 2) > here;
}

// Where it happens often, the camera shakes.
void MotionSearch::find_order() {
    constexpr size_t often = 10;
    std::vector<size_t> found;
    for (size_t i = 1; i + 2 < m_motion.frames(); ++i)
        if (is_exchanged(i))
            found.push_back(i);
    if (found.size() > std::max<size_t>(1, m_motion.frames() / often))
        return;
    for (const size_t i : found) {
        tell(i, "order",
             format("by {} frames {} and {} are in the wrong order", m_name, m_frames[i]->number,
                    m_frames[i + 1]->number));
        m_told.insert({i - 1, i + 1, i + 2});
    }
}

// Steps to frames that are held, as on twos, are none.
void MotionSearch::find_ends() {
    constexpr double unusual = 5, still = 0.01;
    constexpr size_t near = 3;
    const size_t last = m_motion.frames() - 1;
    std::vector<double> steps;
    for (size_t i = 0; i < last; ++i)
        if (!m_frames[i + 1]->held)
            steps.push_back(m_motion.step(i));
    // The others: the nearest first.
    const auto is_cut_off = [&](double step, std::vector<double> others) {
        const double usual = median(others);
        others.resize(std::min<size_t>(others.size(), near));
        return step > unusual * std::max({median(others), still, usual});
    };
    if (is_joined(0, 1) && is_cut_off(steps.front(), {steps.begin() + 1, steps.end()}))
        tell(0, "cutatend",
             format("by {} it is of another camera than the frames that follow", m_name));
    if (is_joined(last - 1, last) && is_cut_off(steps.back(), {steps.rbegin() + 1, steps.rend()}))
        tell(last, "cutatend",
             format("by {} it is of another camera than the frames before it", m_name));
}

// In a motion that is steady otherwise.
void MotionSearch::find_skips() {
    constexpr double moves = 0.005, least = 1.5, most = 3, steady = 1.3;
    for (size_t i = 2; i + 3 < m_motion.frames(); ++i) {
        const size_t first = i < 3 ? 0 : i - 3, end = std::min(i + 4, m_motion.steps().size());
        std::vector<double> beside(m_motion.steps().begin() + std::ptrdiff_t(first),
                                   m_motion.steps().begin() + std::ptrdiff_t(end));
        beside.erase(beside.begin() + std::ptrdiff_t(i - first));
        const auto [low, high] = std::minmax_element(beside.begin(), beside.end());
        const double here = m_motion.step(i);
        if (m_motion.usual() > moves && is_joined(first, end) && here > least * *high &&
            here < most * *high && *high < steady * *low) {
            tell(i + 1, "skip",
                 format("by {} the motion from frame {} to it is {:.2g} times that of the other "
                        "frames: one may be left out",
                        m_name, m_frames[i]->number, here / median(beside)));
        }
    }
}

// Some cells that change once and never else, where nothing moves.
void MotionSearch::find_pops() {
    constexpr double unusual = 6, visible = 0.05, still = 0.02, most = 0.5;
    constexpr size_t few = 2;
    const size_t steps = m_motion.steps().size();
    std::vector<std::vector<double>> changes(steps, std::vector<double>(kCells));
    for (size_t i = 0; i < steps; ++i)
        for (size_t cell = 0; cell < kCells; ++cell)
            changes[i][cell] = m_motion.apart(i, i + 1, cell);
    // The largest and the second largest change of each cell.
    std::vector<std::pair<double, double>> largest(kCells);
    for (const std::vector<double>& change : changes)
        for (size_t cell = 0; cell < kCells; ++cell) {
            auto& [first, second] = largest[cell];
            second = std::max(second, std::min(first, change[cell]));
            first = std::max(first, change[cell]);
        }
    for (size_t i = 0; i < steps; ++i) {
        size_t count = 0;
        bool moves = false;
        for (size_t cell = 0; cell < kCells; ++cell) {
            const auto& [first, second] = largest[cell];
            const double others = changes[i][cell] == first ? second : first;
            moves = moves || others >= still;
            count += changes[i][cell] > std::max(unusual * others, visible);
        }
        if (!moves && count >= few && double(count) < most * double(kCells) && is_joined(i, i + 1))
            tell(i + 1, "pop",
                 format("by {} a part of the picture is another from here on, where nothing else "
                        "moves",
                        m_name));
    }
}

} // namespace

void find_odd_motion(QcShot& shot) {
    const Frames frames = shot.pictures();
    if (frames.size() < kEnoughFrames)
        return;
    std::set<size_t> told;
    for (const QcGuide& like : frames.front()->facts.guides) {
        if (!std::all_of(frames.begin(), frames.end(), [&](const QcFrame* frame) {
                return find_guide(frame->facts, like) != nullptr;
            }))
            continue;
        const Motion motion(frames, like);
        if (!motion.is_plain())
            MotionSearch(shot, frames, motion, like, told).find();
    }
}

} // namespace tonetool::sequence
