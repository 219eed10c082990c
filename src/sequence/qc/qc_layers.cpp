// SPDX-License-Identifier: BSD-3-Clause
// Layers that turn black or are missing, and light groups that do not add up to the beauty.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <set>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// A layer with fewer non-black pixels may be black in the next frame by chance or motion; a layer
// that fades is below this share of its usual light before it is black.
constexpr int64_t kEnoughPixels = 25;
constexpr double kNotFaded = 0.4;

struct LayerFrame {
    QcFrame* frame;
    const QcLayer* layer;
};

bool is_black(const QcLayer& layer) {
    const bool finite = layer.nan.pixels + layer.inf.pixels == 0;
    return finite && layer.lit == 0;
}

double light_of(const QcLayer& layer) {
    return std::abs(layer.mean);
}

// Whether the layer is so bright that it could not fade to black within one frame.
bool is_steady(const LayerFrame& at, double usual) {
    return at.layer->lit >= kEnoughPixels && light_of(*at.layer) >= kNotFaded * usual;
}

void add_black_run(QcShot& shot, const std::vector<LayerFrame>& frames, size_t first, size_t last,
                   double usual) {
    const bool before = first > 0 && is_steady(frames[first - 1], usual);
    const bool after = last + 1 < frames.size() && is_steady(frames[last + 1], usual);
    if (!before && !after)
        return;
    const LayerFrame& at = frames[first];
    // A light may go out for good, an object may leave, motion may stop.
    constexpr size_t brief = 3;
    const bool motion = at.layer->kind == "motion" || at.layer->kind == "id";
    std::optional<Severity> milder;
    if (!before || !after || last - first + 1 > brief || motion)
        milder = Severity::Warning;
    at.frame->changed = true;
    if (last + 1 < frames.size())
        frames[last + 1].frame->changed = true;
    const int neighbour = before ? frames[first - 1].frame->number : frames[last + 1].frame->number;
    shot.add(*at.frame, "blacklayer",
             format("{} is black in {}, but not in frame {}", layer_text(*at.layer),
                    frames_text(at.frame->number, frames[last].frame->number), neighbour),
             {at.layer->name, {}, {}, milder});
}

void find_black(QcShot& shot, const std::vector<LayerFrame>& frames) {
    std::vector<double> lights;
    for (const LayerFrame& at : frames)
        if (!is_black(*at.layer))
            lights.push_back(light_of(*at.layer));
    const double usual = median(lights);
    for (size_t first = 0; first < frames.size(); ++first) {
        size_t last = first;
        if (!is_black(*frames[first].layer))
            continue;
        while (last + 1 < frames.size() && is_black(*frames[last + 1].layer))
            ++last;
        if (!lights.empty())
            add_black_run(shot, frames, first, last, usual);
        first = last;
    }
}

void find_missing(QcShot& shot, const std::string& name, const QcLayer& like) {
    const std::vector<QcFrame*> frames = shot.measured();
    size_t there = 0;
    for (const QcFrame* frame : frames)
        there += find_layer(frame->facts, name) != nullptr;
    // If only a few frames have the layer, it is not missing in the others: "channels" reports the
    // few.
    if (2 * there < frames.size())
        return;
    for (size_t first = 0; first < frames.size(); ++first) {
        size_t last = first;
        if (find_layer(frames[first]->facts, name))
            continue;
        while (last + 1 < frames.size() && !find_layer(frames[last + 1]->facts, name))
            ++last;
        shot.add(*frames[first], "missinglayer",
                 format("{} is not there in {}, but in {} other frames", layer_text(like),
                        frames_text(frames[first]->number, frames[last]->number), there),
                 {name, {}, {}});
        mark_change(frames, first, last);
        first = last;
    }
}

double difference_of(const QcFrame& frame) {
    return frame.facts.picture.group_difference;
}

void add_group_fault(QcShot& shot, QcFrame& frame, const std::string& more) {
    const QcPicture& picture = frame.facts.picture;
    shot.add(frame, "lightsum",
             format("the {} light groups do not add up to the picture: their light is {:.4g} of "
                    "it, and pixels are off by {:.3g} of its light, most at ({}, {}){}",
                    picture.groups, picture.group_sum, picture.group_difference,
                    picture.group_worst.x, picture.group_worst.y, more),
             {picture.layer, Position{picture.group_worst.x, picture.group_worst.y},
              picture.group_difference});
}

} // namespace

void find_lost_layers(QcShot& shot) {
    // A copy of the first frame's layer: messages call the layer so in all frames.
    std::map<std::string, QcLayer> layers;
    for (const QcFrame* frame : shot.measured())
        for (const QcLayer& layer : frame->facts.layers)
            layers.emplace(layer.name, layer);
    for (const auto& [name, like] : layers) {
        std::vector<LayerFrame> frames;
        for (QcFrame* frame : shot.filled())
            if (const QcLayer* layer = find_layer(frame->facts, name))
                frames.push_back({frame, layer});
        find_black(shot, frames);
        find_missing(shot, name, like);
    }
}

// The difference is above the threshold, or ten times that of the other frames, which is rounding.
// Groups that never add up are reported once; frames that lack a group are reported as such.
void find_group_faults(QcShot& shot) {
    constexpr double times = 10, rounding = 0.002;
    int groups = 1;
    for (const QcFrame* frame : shot.pictures())
        groups = std::max(groups, frame->facts.picture.groups);
    std::vector<QcFrame*> frames;
    std::vector<double> differences;
    for (QcFrame* frame : shot.pictures()) {
        if (frame->facts.picture.groups == groups) {
            frames.push_back(frame);
            differences.push_back(difference_of(*frame));
        }
    }
    const double limit = shot.threshold("lightsum"), usual = median(differences);
    if (usual > limit) {
        add_group_fault(shot, *frames.front(),
                        format(" (and so in most of {} frames)", frames.size()));
        return;
    }
    const bool alone = frames.size() < 3;
    for (QcFrame* frame : frames) {
        const bool odd = !alone && difference_of(*frame) > std::max(rounding, times * usual);
        if (difference_of(*frame) > limit || odd)
            add_group_fault(shot, *frame, "");
    }
}

} // namespace tonetool::sequence
