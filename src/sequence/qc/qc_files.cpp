// SPDX-License-Identifier: BSD-3-Clause
// Files beside the frames that look like frames and are none: strayfile.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <map>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// "a, b and 3 more".
std::string some_of(const std::vector<std::string>& names) {
    constexpr size_t most = 3;
    const std::vector<std::string> first(
        names.begin(), names.begin() + std::ptrdiff_t(std::min(most, names.size())));
    const std::string text = OIIO::Strutil::join(first, ", ");
    return names.size() > most ? format("{} and {} more", text, names.size() - most) : text;
}

// Frames before the first or after the last of the shot. A part of a long shot leaves most of it
// out, which is meant.
void tell_beyond(QcShot& shot, QcFrame& frame, int first, int last, size_t checked) {
    const bool meant = 2 * size_t(last - first + 1) > checked;
    shot.add(frame, "strayfile",
             format("the folder has {} of the same name, which {} not checked",
                    frames_text(first, last), first == last ? "was" : "were"),
             {"", {}, {}, meant ? std::optional(Severity::Info) : std::nullopt, {}});
}

// A frame with other padding than the rest: 01013 among 1012 and 1014, not 10000 after 9999.
void find_padding(QcShot& shot, const std::vector<QcFrame*>& frames) {
    std::map<int, size_t> count;
    for (const QcFrame* frame : frames)
        ++count[frame->strays.digits];
    const auto most =
        std::max_element(count.begin(), count.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    for (QcFrame* frame : frames) {
        const int digits = frame->strays.digits, usual = most->first;
        const int natural = int(std::to_string(frame->number).size());
        if (digits != usual && usual > 0 && digits > 0 && !(digits == natural && natural > usual))
            shot.add(*frame, "strayfile",
                     format("its number has {} digits, those of the other frames have {}", digits,
                            usual));
    }
}

} // namespace

void find_stray_files(QcShot& shot) {
    const std::vector<QcFrame*> frames = shot.measured();
    if (frames.empty())
        return;
    find_padding(shot, frames);
    for (QcFrame* frame : frames) {
        const std::vector<std::string>& names = frame->strays.names;
        if (!names.empty()) {
            shot.add(*frame, "strayfile",
                     format("beside it {} {}, which {} no frame of the sequence",
                            names.size() == 1 ? "is" : "are", some_of(names),
                            names.size() == 1 ? "is" : "are"));
        }
    }
    if (frames.size() < 2)
        return;
    QcFrame &first = *frames.front(), &last = *frames.back();
    const auto has_others = [](const QcFrame& frame) {
        return frame.strays.first != frame.strays.last;
    };
    if (has_others(first) && first.strays.first < first.number)
        tell_beyond(shot, first, first.strays.first, first.number - 1, frames.size());
    if (has_others(last) && last.strays.last > last.number)
        tell_beyond(shot, last, last.number + 1, last.strays.last, frames.size());
}

} // namespace tonetool::sequence
