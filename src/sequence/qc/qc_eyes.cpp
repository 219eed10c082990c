// SPDX-License-Identifier: BSD-3-Clause
// The views of a frame, as of a stereo pair, compared with each other: sameeyes, oneeye.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <set>

#include "sequence/qc/qc_shot.h"
#include "text/printable.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

QcFrame* find_frame(QcShot& shot, int number) {
    const auto found =
        std::find_if(shot.frames.begin(), shot.frames.end(), [&](const QcFrame& frame) {
            return frame.number == number && frame.measured;
        });
    return found == shot.frames.end() ? nullptr : &*found;
}

// A layer is told once. One of few pixels may be hidden behind something in one eye.
void compare_layers(QcShot& shot, QcFrame& frame, const QcFrame& other, const std::string& view,
                    std::set<std::string>& told) {
    constexpr int64_t enough = 25;
    for (const QcLayer& layer : frame.facts.layers) {
        const QcLayer* same = find_layer(other.facts, layer.name);
        const bool finite = layer.nan.pixels + layer.inf.pixels == 0;
        if (same && finite && layer.lit == 0 && same->lit >= enough &&
            told.insert(layer.name).second)
            shot.add(frame, "oneeye",
                     format("{} is black, but not in view {}", layer_text(layer), printable(view)),
                     {layer.name, {}, {}, {}, {}});
    }
}

void compare_views(QcShot& shot, QcShot& others, const std::string& view) {
    std::set<std::string> here, there;
    for (QcFrame& frame : shot.frames) {
        QcFrame* other = frame.measured ? find_frame(others, frame.number) : nullptr;
        if (!other || frame.blank || other->blank)
            continue;
        if (has_picture(frame.facts) && frame.facts.picture.hash == other->facts.picture.hash)
            others.add(*other, "sameeyes",
                       format("the same pixels as view {}", printable(frame.result->view)));
        compare_layers(shot, frame, *other, view, here);
        compare_layers(others, *other, frame, frame.result->view, there);
    }
}

} // namespace

void find_eye_faults(std::map<std::string, QcShot>& views) {
    for (auto first = views.begin(); first != views.end(); ++first)
        for (auto second = std::next(first); second != views.end(); ++second)
            compare_views(first->second, second->second, second->first);
}

} // namespace tonetool::sequence
