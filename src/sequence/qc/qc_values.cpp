// SPDX-License-Identifier: BSD-3-Clause
// Pictures whose values repeat exactly: enlarged ones, and those that went through few bits.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <functional>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// Each run of frames of which it is true is told once, at its first.
void each_run(const std::vector<QcFrame*>& frames,
              const std::function<bool(const QcFacts& facts)>& is_odd,
              const std::function<void(QcFrame& frame, const std::string& which)>& tell) {
    for (size_t first = 0; first < frames.size(); ++first) {
        size_t end = first;
        while (end < frames.size() && is_odd(frames[end]->facts))
            ++end;
        if (end == first)
            continue;
        tell(*frames[first],
             end == first + 1 ? std::string()
                              : frames_text(frames[first]->number, frames[end - 1]->number) + ": ");
        first = end;
    }
}

// Flat graphics have pairs in even and in odd columns.
bool is_enlarged(const QcFacts& facts) {
    constexpr double all = 0.9, few = 0.5;
    const auto& [even, odd] = facts.picture.pairs;
    return std::max(even, odd) > all && std::min(even, odd) < few;
}

// Pixels of whole numbers have few values by their nature.
bool has_floats(const QcFacts& facts) {
    return std::all_of(facts.channels.begin(), facts.channels.end(), [](const auto& channel) {
        return channel.second == "half" || channel.second == "float" || channel.second == "double";
    });
}

} // namespace

void find_enlarged(QcShot& shot) {
    each_run(shot.pictures(), is_enlarged, [&](QcFrame& frame, const std::string& which) {
        const QcPicture& picture = frame.facts.picture;
        shot.add(frame, "proxy",
                 format("{}the picture was enlarged, each pixel is there twice: {:.0f} % of the "
                        "{} columns equal the next",
                        which, 100 * std::max(picture.pairs[0], picture.pairs[1]),
                        picture.pairs[0] > picture.pairs[1] ? "even" : "odd"),
                 {picture.layer, {}, {}, {}});
    });
}

void find_bands(QcShot& shot) {
    constexpr int64_t enough = 5000;
    const double least = std::min(shot.threshold("bands"), 1000.0); // more are not counted
    const auto is_odd = [&](const QcFacts& facts) {
        const QcPicture& picture = facts.picture;
        return picture.greens > enough && double(picture.distinct) < least && has_floats(facts);
    };
    each_run(shot.pictures(), is_odd, [&](QcFrame& frame, const std::string& which) {
        const QcPicture& picture = frame.facts.picture;
        shot.add(frame, "bands",
                 format("{}{} pixels have only {} different values of green", which, picture.greens,
                        picture.distinct),
                 {picture.layer, {}, double(picture.distinct), {}});
    });
}

} // namespace tonetool::sequence
