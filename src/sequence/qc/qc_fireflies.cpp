// SPDX-License-Identifier: BSD-3-Clause
// Fireflies: lone bright pixels that are neither in their neighbourhood nor in other frames; and
// hot pixels, which are in all frames, whatever moves.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sequence/qc/qc_thumbnails.h"

namespace tonetool::sequence {

namespace {

// The neighbourhood counts as at least this share of the image's mean luminance.
constexpr double kFloor = 0.05;
// In a frame with more candidates than these, the next largest is the level of its noise.
constexpr size_t kFew = 9;
// The factor by which noise alone may exceed that level, or the usual largest candidate of a shot.
constexpr double kNoise = 4;
// The factor by which a small lamp may change as it moves over the pixels.
constexpr double kSameLight = 4;
// The distance that a lamp may move in a frame where no layer tells it, in cells of the peaks: 6 %
// of the width.
constexpr int kMoves = 4;
constexpr int kWide = QcPicture::kPeaksWide, kHigh = QcPicture::kPeaksHigh;

// A candidate that no neighbouring frame has.
struct Lone {
    const QcSpot* spot;
    double ratio; ///< to its neighbourhood
};

struct Spikes {
    QcFrame* frame;
    std::vector<Lone> lone; ///< the largest ratio first
    double largest() const { return lone.empty() ? 0 : lone.front().ratio; }
    double noise() const { return lone.size() > kFew ? lone[kFew].ratio : 0; }
};

double luminance_of(int cell) {
    return cell > QcPicture::kDark ? std::exp2(cell / 1000.0) : 0;
}

double peak_of(int cell) {
    return cell > QcPicture::kPeakDark ? std::exp2(cell / 8.0) : 0;
}

double mean_luminance(const QcFacts& facts) {
    double sum = 0;
    for (int cell : facts.picture.thumbnail)
        sum += luminance_of(cell);
    return sum / double(facts.picture.thumbnail.size());
}

struct Cell {
    int x, y;
};

Cell cell_of(const QcFacts& facts, const QcSpot& spike) {
    const std::array<int, 4>& window = facts.parts.front().display;
    const double x = double(spike.x - window[0]) / window[2] * kWide;
    const double y = double(spike.y - window[1]) / window[3] * kHigh;
    return {int(std::floor(x)), int(std::floor(y))};
}

// Nobody sees what is outside of the display window.
bool is_inside(const Cell& cell) {
    return cell.x >= 0 && cell.y >= 0 && cell.x < kWide && cell.y < kHigh;
}

bool is_at_border(const Cell& cell, int reach) {
    return cell.x < reach || cell.y < reach || cell.x >= kWide - reach || cell.y >= kHigh - reach;
}

// How far a lamp may move to the next frame, in cells of the peaks: as far as most pixels do.
int reach_of(const QcFacts& facts) {
    constexpr double margin = 1.5;
    if (std::none_of(facts.layers.begin(), facts.layers.end(),
                     [](const QcLayer& layer) { return layer.kind == "motion"; }))
        return kMoves;
    const double width = facts.parts.front().display[2];
    const double cells = std::ceil(margin * facts.picture.speed / width * kWide);
    return 1 + int(std::min(cells, double(kWide)));
}

// A lamp or a glint is there in the next frame, too, not far away.
bool is_seen_in(const QcFacts& other, const QcSpot& spike, int reach) {
    const Cell cell = cell_of(other, spike);
    const int right = std::min(cell.x + reach, kWide - 1);
    const int bottom = std::min(cell.y + reach, kHigh - 1);
    double most = 0;
    for (int y = std::max(cell.y - reach, 0); y <= bottom; ++y) {
        for (int x = std::max(cell.x - reach, 0); x <= right; ++x) {
            const size_t at = size_t(y) * size_t(kWide) + size_t(x);
            most = std::max(most, peak_of(other.picture.peaks[at]));
        }
    }
    return most * kSameLight >= spike.value;
}

// The frames before and after, as far as they belong to the same take.
using Neighbours = std::vector<const QcFrame*>;

// Where there is no neighbour on one side, a lamp at the border of the image may just have entered
// or be about to leave.
Spikes spikes_of(QcFrame& frame, const Neighbours& neighbours, double usual_mean) {
    Spikes spikes{&frame, {}};
    const int reach = reach_of(frame.facts);
    for (const QcSpot& spot : frame.facts.picture.spikes) {
        const Cell cell = cell_of(frame.facts, spot);
        const double around = std::max(spot.around, kFloor * usual_mean);
        const bool known =
            std::any_of(neighbours.begin(), neighbours.end(), [&](const QcFrame* other) {
                return is_seen_in(other->facts, spot, reach);
            });
        const bool unsure =
            neighbours.empty() || (neighbours.size() < 2 && is_at_border(cell, reach));
        if (is_inside(cell) && !known && !unsure && around > 0)
            spikes.lone.push_back({&spot, spot.value / around});
    }
    std::stable_sort(spikes.lone.begin(), spikes.lone.end(),
                     [](const Lone& a, const Lone& b) { return a.ratio > b.ratio; });
    return spikes;
}

// How large, in units of its neighbourhood, a spike of each frame must be.
std::vector<double> limits_of(const QcShot& shot, const std::vector<Spikes>& all) {
    std::vector<double> sorted, limits;
    for (const Spikes& spikes : all)
        sorted.push_back(spikes.largest());
    std::sort(sorted.begin(), sorted.end());
    for (const Spikes& spikes : all)
        limits.push_back(
            std::max(shot.threshold("firefly"),
                     kNoise * std::max(spikes.noise(), median_without(sorted, spikes.largest()))));
    return limits;
}

void judge_frame(QcShot& shot, const std::vector<Spikes>& all, size_t i, double limit) {
    const std::vector<Lone>& lone = all[i].lone;
    const auto end =
        std::find_if(lone.begin(), lone.end(), [&](const Lone& at) { return at.ratio <= limit; });
    const auto count = end - lone.begin();
    if (count > 0) {
        const QcSpot& worst = *lone.front().spot;
        shot.add(
            *all[i].frame, "firefly",
            OIIO::Strutil::fmt::format(
                "{} {}, the worst at ({}, {}): {:.3g} where pixels around it are at most "
                "{:.3g}, and no neighbouring frame has it",
                count, count == 1 ? "firefly" : "fireflies", worst.x, worst.y, worst.value,
                worst.around),
            {all[i].frame->facts.picture.layer, Position{worst.x, worst.y}, lone.front().ratio});
        all[i].frame->changed = true;
        if (i + 1 < all.size())
            all[i + 1].frame->changed = true;
    }
}

// Fireflies of a fixed seed are at the same pixels in all frames.
void find_hot_pixels(QcShot& shot, const std::vector<QcFrame*>& frames, double usual_mean) {
    constexpr double mostly = 0.6;
    std::map<std::pair<int, int>, size_t> count; // by row, then column
    std::set<std::string> moments;
    for (const QcFrame* frame : frames) {
        moments.insert(moment_of(frame->facts));
        for (const QcSpot& spot : frame->facts.picture.spikes)
            if (spot.value >
                shot.threshold("hotpixel") * std::max(spot.around, kFloor * usual_mean))
                ++count[{spot.y, spot.x}];
    }
    const bool moves = 2 * moments.size() > frames.size();
    size_t hot = 0;
    Position first;
    for (const auto& [at, times] : count) {
        if (double(times) <= mostly * double(frames.size()))
            continue;
        if (hot++ == 0)
            first = {at.second, at.first};
    }
    if (frames.size() >= kEnoughFrames && moves && hot > 0) {
        shot.add(*frames.front(), "hotpixel",
                 OIIO::Strutil::fmt::format(
                     "{} {} lone and bright in most frames, the first at ({}, {}), though the "
                     "camera or the scene moves",
                     hot, hot == 1 ? "pixel is" : "pixels are", first.x, first.y),
                 {frames.front()->facts.picture.layer, first, {}, {}});
    }
}

} // namespace

// A single image cannot tell fireflies: a lamp is a lone bright pixel, too.
void find_fireflies(QcShot& shot) {
    const std::vector<QcFrame*> frames = shot.pictures();
    const std::vector<Thumbnail> thumbnails = thumbnails_of(frames);
    const double step = usual_step_of(thumbnails);
    std::vector<double> means;
    for (const QcFrame* frame : frames)
        means.push_back(mean_luminance(frame->facts));
    const double usual_mean = median(std::move(means));
    std::vector<Spikes> all;
    for (size_t i = 0; i < frames.size(); ++i) {
        Neighbours neighbours;
        if (i > 0 && !is_cut(thumbnails[i - 1], thumbnails[i], step))
            neighbours.push_back(frames[i - 1]);
        if (i + 1 < frames.size() && !is_cut(thumbnails[i], thumbnails[i + 1], step))
            neighbours.push_back(frames[i + 1]);
        all.push_back(spikes_of(*frames[i], neighbours, usual_mean));
    }
    const std::vector<double> limits = limits_of(shot, all);
    size_t sparks = 0;
    for (size_t i = 0; i < all.size(); ++i)
        sparks += all[i].largest() > limits[i];
    for (size_t i = 0; i < all.size() && sparks <= std::max<size_t>(2, all.size() / 4); ++i)
        judge_frame(shot, all, i, limits[i]);
    find_hot_pixels(shot, frames, usual_mean);
}

} // namespace tonetool::sequence
