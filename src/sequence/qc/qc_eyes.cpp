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

// The layers that are black in all frames of a view, and those that are lit in one.
struct Lights {
    std::map<std::string, QcLayer> black;
    std::set<std::string> lit;
};

// A layer of few pixels may be hidden behind something in one eye.
Lights lights_of(QcShot& shot) {
    constexpr int64_t enough = 25;
    std::map<std::string, QcLayer> all;
    Lights lights;
    for (const QcFrame* frame : shot.measured()) {
        for (const QcLayer& layer : frame->facts.layers) {
            all.emplace(layer.name, layer);
            if (layer.lit >= enough)
                lights.lit.insert(layer.name);
            if (layer.lit > 0 || layer.nan.pixels + layer.inf.pixels > 0)
                all[layer.name].lit = 1;
        }
    }
    for (const auto& [name, layer] : all)
        if (layer.lit == 0)
            lights.black.emplace(name, layer);
    return lights;
}

// What is black in some frames alone is another fault.
void compare_layers(QcShot& shot, QcShot& others, const std::string& view) {
    const Lights here = lights_of(shot), there = lights_of(others);
    for (const auto& [name, layer] : here.black)
        if (there.lit.count(name) > 0)
            shot.add(*shot.measured().front(), "oneeye",
                     format("{} is black, but not in view {}", layer_text(layer), printable(view)),
                     {name, {}, {}, {}, {}});
}

// The objects that a frame of this view shows well, and that of the other view not at all. Small
// ones may be hidden in one eye for a while: only what no frame of the other has counts. Told once.
void compare_objects(QcShot& shot, QcShot& others, const std::string& view) {
    constexpr double kLarge = 0.005; // of the picture
    std::set<uint32_t> told;
    for (QcFrame* frame : shot.measured()) {
        const QcObjects& here = frame->facts.picture.objects;
        const QcFrame* same = find_frame(others, frame->number);
        for (const QcObject& object : here.inside) {
            const auto knows = [&](const QcFrame* other) {
                const QcObjects& there = other->facts.picture.objects;
                return there.layer != here.layer || there.knows(object.id);
            };
            const std::vector<QcFrame*> all = others.measured();
            const bool large = double(object.pixels) >= kLarge * pixels_of(frame->facts);
            const bool gone = large && same
                                  ? !knows(same)
                                  : !all.empty() && std::none_of(all.begin(), all.end(), knows);
            if (told.count(object.id) > 0 || !gone)
                continue;
            told.insert(object.id);
            shot.add(*frame, "oneeye",
                     format("object <{:08x}> of {} ({} pixels) is not in view {}", object.id,
                            printable(here.layer), object.pixels, printable(view)),
                     {here.layer, {}, {}, {}, {}});
        }
    }
}

void compare_views(QcShot& shot, const std::string& name, QcShot& others, const std::string& view) {
    for (QcFrame& frame : shot.frames) {
        QcFrame* other = frame.measured ? find_frame(others, frame.number) : nullptr;
        if (other && !frame.blank && !other->blank && has_picture(frame.facts) &&
            frame.facts.picture.hash == other->facts.picture.hash)
            others.add(*other, "sameeyes", format("the same pixels as view {}", printable(name)));
    }
    compare_layers(shot, others, view);
    compare_layers(others, shot, name);
    compare_objects(shot, others, view);
    compare_objects(others, shot, name);
}

} // namespace

void find_eye_faults(std::map<std::string, QcShot>& views) {
    for (auto first = views.begin(); first != views.end(); ++first)
        for (auto second = std::next(first); second != views.end(); ++second)
            compare_views(first->second, first->first, second->second, second->first);
}

} // namespace tonetool::sequence
