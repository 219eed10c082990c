// SPDX-License-Identifier: BSD-3-Clause
// The faults that a single image shows: black, constant, NaN, Inf, negative, alpha; black and
// hidden ones are judged by the frames around them.
#include <OpenImageIO/strutil.h>
#include <cmath>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

QcDetail detail_of(const QcLayer& layer, const QcCount& count, double value) {
    QcDetail detail{layer.name, {}, value, {}};
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

// Ids are bits, which need not be numbers.
void find_bad_values(const QcShot& shot, QcFrame& frame, const QcLayer& layer) {
    if (layer.kind == "id")
        return;
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

double share_of(int64_t pixels, int64_t all) {
    return all > 0 ? double(pixels) / double(all) : 0;
}

// The share of the frame that is lit, but hidden by its alpha.
double hidden_share(const QcFrame& frame) {
    return double(frame.facts.picture.unseen.pixels) / pixels_of(frame.facts);
}

double light_of(const QcFrame& frame) {
    return std::abs(picture_layer(frame.facts).mean);
}

bool is_black(const QcShot& shot, const QcFrame& frame) {
    return frame.blank && picture_layer(frame.facts).max <= shot.threshold("black");
}

// Whether light goes out by steps up to these black frames at an end of the shot.
bool is_fade(const std::vector<QcFrame*>& frames, size_t first, size_t last, double usual) {
    constexpr double faded = 0.6;
    const size_t count = frames.size();
    const auto falls = [&](size_t near, size_t far) {
        return light_of(*frames[near]) < faded * usual &&
               light_of(*frames[far]) > light_of(*frames[near]);
    };
    const bool out = last + 1 == count && first >= 2 && falls(first - 1, first - 2);
    const bool in = first == 0 && last + 2 < count && falls(last + 1, last + 2);
    return out || in;
}

bool is_empty(const QcPicture& picture) {
    return has_alpha(picture) && picture.alpha_mean <= 0;
}

// How much of the picture the element has that is gone in these frames: the larger alpha of the
// frames beside them.
double alpha_beside(const std::vector<QcFrame*>& frames, size_t first, size_t last) {
    double alpha = 0;
    if (first > 0)
        alpha = frames[first - 1]->facts.picture.alpha_mean;
    if (last + 1 < frames.size())
        alpha = std::max(alpha, frames[last + 1]->facts.picture.alpha_mean);
    return alpha;
}

// An element that is not in the picture yet has no alpha. It comes in from a border or grows: one
// that fills the picture in the next frame was not rendered, nor was one that is in no frame.
std::optional<Severity> severity_of_empty(const std::vector<QcFrame*>& frames, size_t first,
                                          size_t last) {
    constexpr double fills = 0.5, large = 0.1;
    const bool nowhere = first == 0 && last + 1 == frames.size();
    const double beside = alpha_beside(frames, first, last);
    if (nowhere || beside >= fills)
        return std::nullopt;
    return beside >= large ? Severity::Warning : Severity::Info;
}

// Without any alpha nobody knows whether there was to be something.
std::optional<Severity> severity_of_black(const QcPicture& picture) {
    return has_alpha(picture) ? std::nullopt : std::optional(Severity::Warning);
}

} // namespace

bool has_picture(const QcFacts& facts) {
    return &picture_layer(facts) != &no_layer();
}

double pixels_of(const QcFacts& facts) {
    const std::array<int, 4>& window = facts.parts.front().data;
    return double(window[2]) * window[3];
}

bool has_alpha(const QcPicture& picture) {
    return picture.alpha_mean != 0 || picture.alpha_clear != 0;
}

// Non-finite pixels have no known value, so an image that has some is neither black nor constant.
bool is_blank(const QcFacts& facts, const FaultLimits& limits) {
    if (!has_picture(facts))
        return false;
    const QcLayer& picture = picture_layer(facts);
    const bool finite = picture.nan.pixels + picture.inf.pixels == 0;
    return finite && (picture.constant || picture.max <= limits.threshold("black"));
}

void find_blank(QcShot& shot) {
    const std::vector<QcFrame*> frames = shot.measured();
    std::vector<double> lights;
    for (const QcFrame* frame : frames)
        if (!frame->blank)
            lights.push_back(light_of(*frame));
    const double usual = median(std::move(lights));
    for (size_t first = 0; first < frames.size(); ++first) {
        QcFrame& frame = *frames[first];
        if (frame.blank && !is_black(shot, frame)) {
            const QcLayer& picture = picture_layer(frame.facts);
            shot.add(frame, "constant",
                     format("the picture is one colour (largest component {:.4g})", picture.max),
                     {picture.name, {}, {}, {}});
        }
        size_t last = first;
        while (last < frames.size() && is_black(shot, *frames[last]))
            ++last;
        if (last == first)
            continue;
        const bool fade = is_fade(frames, first, last - 1, usual);
        const std::optional<Severity> empty = severity_of_empty(frames, first, last - 1);
        for (; first < last; ++first) {
            const QcFacts& facts = frames[first]->facts;
            const QcLayer& picture = picture_layer(facts);
            const std::optional<Severity> milder = fade ? std::optional(Severity::Info)
                                                   : is_empty(facts.picture)
                                                       ? empty
                                                       : severity_of_black(facts.picture);
            shot.add(*frames[first], "black",
                     fade ? "the picture is black at the end of a fade" : "the picture is black",
                     {picture.name, {}, picture.max, milder});
        }
        --first;
    }
}

// Alpha that hides most of one frame is lost; where it does so in all frames, they are made like
// that.
void find_hidden(QcShot& shot) {
    constexpr double much = 0.5, little = 0.25;
    const std::vector<QcFrame*> frames = shot.measured();
    std::vector<double> shares;
    for (const QcFrame* frame : frames)
        shares.push_back(hidden_share(*frame));
    const double usual = median(shares);
    for (size_t i = 0; i < frames.size(); ++i) {
        const QcPicture& picture = frames[i]->facts.picture;
        const double share = share_of(picture.unseen.pixels, picture.lit);
        const bool odd = shares[i] > much && usual < little;
        if (!odd && share <= shot.threshold("alphaempty"))
            continue;
        QcDetail detail = detail_of(picture_layer(frames[i]->facts), picture.unseen, share);
        if (!odd)
            detail.milder = Severity::Warning;
        shot.add(*frames[i], "alphaempty",
                 format("alpha is 0 in {} of the {} lit pixels{}, which nobody sees where alpha is "
                        "heeded",
                        picture.unseen.pixels, picture.lit, odd ? ", unlike in other frames" : ""),
                 detail);
        if (odd)
            mark_change(frames, i, i);
    }
}

void find_picture_faults(const QcShot& shot, QcFrame& frame) {
    for (const QcLayer& layer : frame.facts.layers)
        find_bad_values(shot, frame, layer);
    find_alpha(shot, frame, frame.facts.picture.alpha_low, "below 0");
    find_alpha(shot, frame, frame.facts.picture.alpha_high, "above 1");
}

} // namespace tonetool::sequence
