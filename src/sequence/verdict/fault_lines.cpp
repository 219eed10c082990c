// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/fault_lines.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "text/printable.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// A frame of another moment differs in every layer.
constexpr size_t kMostDifferences = 4;

// Whether two frames have the same difference, however much of it.
bool is_same(const Fault& a, const Fault& b) {
    return a.command == b.command && a.code == b.code && a.layer == b.layer &&
           a.severity == b.severity && (a.value.has_value() || a.sentence == b.sentence);
}

const Fault* find_same(const FrameResult& frame, const Fault& fault) {
    const auto found = std::find_if(frame.faults.begin(), frame.faults.end(),
                                    [&](const Fault& other) { return is_same(other, fault); });
    return found == frame.faults.end() ? nullptr : &*found;
}

std::string line(const Fault& fault, const std::string& frames, const std::string& view) {
    std::string where = printable(frames + (frames.empty() || view.empty() ? "" : " ") + view);
    where += where.empty() ? "" : ": ";
    return format("{}: {}{} {}: {}\n", fault.command.empty() ? "qc" : fault.command, where,
                  severity_name(fault.severity), fault.code, printable(fault.sentence));
}

// Frames of one view.
class ViewFaults {
public:
    explicit ViewFaults(std::vector<const FrameResult*> frames) : m_frames(std::move(frames)) {}

    /// The line of a fault of frame i; empty if that of an earlier frame has told it.
    std::string line_of(size_t i, const Fault& fault) const {
        const std::string number = number_of(i);
        if (fault.command.empty())
            return line(fault, number, m_frames[i]->view);
        if (i > 0 && find_same(*m_frames[i - 1], fault))
            return "";
        size_t last = i, worst = i;
        const Fault* most = &fault;
        for (; last + 1 < m_frames.size(); ++last) {
            const Fault* next = find_same(*m_frames[last + 1], fault);
            if (!next)
                break;
            if (std::abs(next->value.value_or(0)) > std::abs(most->value.value_or(0))) {
                most = next;
                worst = last + 1;
            }
        }
        if (last == i)
            return line(fault, number, m_frames[i]->view);
        Fault told = *most;
        if (told.value)
            told.sentence = format("{} (frame {})", told.sentence, m_frames[worst]->frame);
        return line(
            told, case_of(i) + format("frames {} to {}", m_frames[i]->frame, m_frames[last]->frame),
            m_frames[i]->view);
    }

    /// Of a frame with more of them than a person reads.
    std::string rest_of(size_t i, size_t count) const {
        const std::string number = printable(number_of(i)), &view = m_frames[i]->view;
        return format("against: {}{}{}{}and {} more {}, which -v prints\n", number,
                      view.empty() ? "" : " ", printable(view), number.empty() ? "" : ": ", count,
                      count == 1 ? "difference" : "differences");
    }

private:
    // "case hair/long "; empty for frames without a name.
    std::string case_of(size_t i) const {
        const Item& item = m_frames[i]->item();
        return item.named() ? item_title({0, "", item.name, item.method}) + " " : "";
    }

    // A still has none. The view is told beside it.
    std::string number_of(size_t i) const {
        if (m_frames[i]->item().named())
            return item_title({m_frames[i]->frame, "", m_frames[i]->name, m_frames[i]->method});
        const bool still = m_frames.size() == 1 && m_frames[i]->frame == 0;
        return still ? std::string() : "frame " + std::to_string(m_frames[i]->frame);
    }

    std::vector<const FrameResult*> m_frames;
};

} // namespace

std::string faults_text(const ShotResult& shot, bool all) {
    std::map<Series, std::vector<const FrameResult*>> views;
    for (const FrameResult& frame : shot.frames)
        views[series_of(frame.item())].push_back(&frame);
    std::map<Series, ViewFaults> faults;
    for (auto& [view, frames] : views)
        faults.emplace(view, ViewFaults(std::move(frames)));
    std::map<Series, size_t> place;
    std::string text;
    for (const FrameResult& frame : shot.frames) {
        const Series series = series_of(frame.item());
        const ViewFaults& of_view = faults.at(series);
        const size_t i = place[series]++;
        size_t differences = 0;
        for (const Fault& fault : frame.faults) {
            const std::string line = of_view.line_of(i, fault);
            differences += !line.empty() && !fault.command.empty();
            if (all || fault.command.empty() || differences <= kMostDifferences)
                text += line;
        }
        if (!all && differences > kMostDifferences)
            text += of_view.rest_of(i, differences - kMostDifferences);
    }
    return text;
}

} // namespace tonetool::sequence
