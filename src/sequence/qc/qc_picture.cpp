// SPDX-License-Identifier: BSD-3-Clause
// The faults that a single image shows: black, constant, NaN, Inf, negative, alpha.
#include <OpenImageIO/strutil.h>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

QcDetail detail_of(const QcLayer& layer, const QcCount& count, double value) {
    QcDetail detail{layer.name, {}, value};
    if (!count.first.empty())
        detail.position = Position{count.first.front().x, count.first.front().y};
    return detail;
}

// "3 pixels, the first at (4, 5), (6, 7)".
std::string places(const QcCount& count) {
    std::string text =
        format("{} {}", count.pixels, count.pixels == 1 ? "pixel, at" : "pixels, the first at");
    for (const QcSpot& spot : count.first)
        text += format("{} ({}, {})", &spot == count.first.data() ? "" : ",", spot.x, spot.y);
    return text;
}

void find_bad_values(const QcShot& shot, QcFrame& frame, const QcLayer& layer) {
    const double nan = double(layer.nan.pixels), inf = double(layer.inf.pixels);
    if (nan > shot.threshold("nan")) {
        shot.add(frame, "nan", layer_text(layer) + " is not a number in " + places(layer.nan),
                 detail_of(layer, layer.nan, nan));
    }
    if (inf > shot.threshold("inf") && layer.kind != "depth") {
        shot.add(frame, "inf", layer_text(layer) + " is infinite in " + places(layer.inf),
                 detail_of(layer, layer.inf, inf));
    }
    const bool light = layer.kind == "picture" || layer.kind == "light";
    if (light && layer.negative.pixels > 0 && -layer.min > shot.threshold("negative")) {
        shot.add(frame, "negative",
                 format("{} is negative, down to {:.3g}, in {}", layer_text(layer), layer.min,
                        places(layer.negative)),
                 detail_of(layer, layer.negative, -layer.min));
    }
}

void find_alpha(const QcShot& shot, QcFrame& frame, const QcCount& count, const char* what) {
    if (count.pixels > 0 && double(count.pixels) > shot.threshold("alpha")) {
        shot.add(frame, "alpha",
                 format("alpha is {} ({:.4g} first) in {}", what, count.first.front().value,
                        places(count)),
                 detail_of(picture_layer(frame.facts), count, double(count.pixels)));
    }
}

void find_unseen(const QcShot& shot, QcFrame& frame) {
    const QcPicture& picture = frame.facts.picture;
    const double share = picture.lit > 0 ? double(picture.unseen.pixels) / double(picture.lit) : 0;
    if (share > shot.threshold("alphaempty")) {
        shot.add(frame, "alphaempty",
                 format("alpha is 0 in {} of the {} lit pixels, which nobody sees where alpha is "
                        "heeded",
                        picture.unseen.pixels, picture.lit),
                 detail_of(picture_layer(frame.facts), picture.unseen, share));
    }
}

} // namespace

bool has_picture(const QcFacts& facts) {
    return &picture_layer(facts) != &no_layer();
}

// Non-finite pixels have no known value, so an image that has some is neither black nor constant.
bool is_blank(const QcFacts& facts, const QcLimits& limits) {
    if (!has_picture(facts))
        return false;
    const QcLayer& picture = picture_layer(facts);
    const bool finite = picture.nan.pixels + picture.inf.pixels == 0;
    return finite && (picture.constant || picture.max <= limits.threshold("black"));
}

void find_picture_faults(const QcShot& shot, QcFrame& frame) {
    const QcLayer& picture = picture_layer(frame.facts);
    if (frame.blank && picture.max <= shot.threshold("black")) {
        shot.add(frame, "black", "the picture is black", {picture.name, {}, picture.max});
    } else if (frame.blank) {
        shot.add(frame, "constant",
                 format("the picture is one colour (largest component {:.4g})", picture.max),
                 {picture.name, {}, {}});
    }
    for (const QcLayer& layer : frame.facts.layers)
        find_bad_values(shot, frame, layer);
    find_alpha(shot, frame, frame.facts.picture.alpha_low, "below 0");
    find_alpha(shot, frame, frame.facts.picture.alpha_high, "above 1");
    find_unseen(shot, frame);
}

} // namespace tonetool::sequence
