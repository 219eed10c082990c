// SPDX-License-Identifier: BSD-3-Clause
// Pictures whose values repeat exactly: enlarged ones, those that went through few bits, clamped
// ones, and albedos of one colour.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <functional>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// Each run of frames of which it is true is told once, at its first, and explains what changes with
// it.
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
        if (first > 0 || end < frames.size())
            mark_change(frames, first, end - 1);
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

// A clamp of each channel leaves pixels at 1 that are not white; others are there by chance.
void find_clamped(QcShot& shot) {
    constexpr double chance = 8;
    constexpr int64_t enough = 10;
    const auto at_one = [&](const QcFacts& facts) {
        const double pixels = double(facts.picture.at_one);
        return facts.picture.at_one >= enough &&
               pixels > std::max(shot.threshold("clip") * pixels_of(facts),
                                 chance * double(facts.picture.beside_one) / 2);
    };
    const auto is_odd = [&](const QcFacts& facts) {
        return at_one(facts) || facts.picture.at_largest_half >= enough;
    };
    each_run(shot.pictures(), is_odd, [&](QcFrame& frame, const std::string& which) {
        const QcPicture& picture = frame.facts.picture;
        const bool one = at_one(frame.facts);
        const double share = double(picture.at_one) / pixels_of(frame.facts);
        shot.add(frame, "clip",
                 one ? format("{}in {:.3g} % of the pixels one channel is exactly 1 and another is "
                              "not: the picture was clamped",
                              which, 100 * share)
                     : format("{}{} pixels are at 65504, the largest half float: they were clamped",
                              which, picture.at_largest_half),
                 {picture.layer, {}, one ? std::optional(share) : std::nullopt, {}});
    });
}

void find_magenta(QcShot& shot) {
    const auto is_odd = [&](const QcFacts& facts) {
        return facts.picture.magenta > shot.threshold("magenta");
    };
    each_run(shot.measured(), is_odd, [&](QcFrame& frame, const std::string& which) {
        const double share = frame.facts.picture.magenta;
        shot.add(frame, "magenta",
                 format("{}{:.3g} % of the albedo is pure magenta, as where a texture was not "
                        "found",
                        which, 100 * share),
                 {"", {}, share, {}});
    });
}

} // namespace tonetool::sequence
