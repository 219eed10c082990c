// SPDX-License-Identifier: BSD-3-Clause
// Fireflies: lone bright pixels that are neither in their neighbourhood nor in other frames.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

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
// The distance, in cells of the thumbnail, that a lamp may move in a frame: 6 % of the width.
constexpr int kMoves = 2;

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
    const double x = double(spike.x - window[0]) / window[2] * QcPicture::kWide;
    const double y = double(spike.y - window[1]) / window[3] * QcPicture::kHigh;
    return {int(std::floor(x)), int(std::floor(y))};
}

// Nobody sees what is outside of the display window.
bool is_inside(const Cell& cell) {
    return cell.x >= 0 && cell.y >= 0 && cell.x < QcPicture::kWide && cell.y < QcPicture::kHigh;
}

bool is_at_border(const Cell& cell) {
    return cell.x < kMoves || cell.y < kMoves || cell.x >= QcPicture::kWide - kMoves ||
           cell.y >= QcPicture::kHigh - kMoves;
}

// A lamp or a glint is there in the next frame, too, not far away.
bool is_seen_in(const QcFacts& other, const QcSpot& spike) {
    const Cell cell = cell_of(other, spike);
    const int right = std::min(cell.x + kMoves, QcPicture::kWide - 1);
    const int bottom = std::min(cell.y + kMoves, QcPicture::kHigh - 1);
    double most = 0;
    for (int y = std::max(cell.y - kMoves, 0); y <= bottom; ++y) {
        for (int x = std::max(cell.x - kMoves, 0); x <= right; ++x) {
            const size_t at = size_t(y) * QcPicture::kWide + size_t(x);
            most = std::max(most, luminance_of(other.picture.peaks[at]));
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
    for (const QcSpot& spot : frame.facts.picture.spikes) {
        const Cell cell = cell_of(frame.facts, spot);
        const double around = std::max(spot.around, kFloor * usual_mean);
        const bool known =
            std::any_of(neighbours.begin(), neighbours.end(),
                        [&](const QcFrame* other) { return is_seen_in(other->facts, spot); });
        const bool unsure = neighbours.empty() || (neighbours.size() < 2 && is_at_border(cell));
        if (is_inside(cell) && !known && !unsure && around > 0)
            spikes.lone.push_back({&spot, spot.value / around});
    }
    std::stable_sort(spikes.lone.begin(), spikes.lone.end(),
                     [](const Lone& a, const Lone& b) { return a.ratio > b.ratio; });
    return spikes;
}

void judge_frame(QcShot& shot, const std::vector<Spikes>& all, size_t i) {
    std::vector<double> largest;
    for (size_t k = 0; k < all.size(); ++k)
        if (k != i)
            largest.push_back(all[k].largest());
    const std::vector<Lone>& lone = all[i].lone;
    const double limit = std::max(shot.threshold("firefly"),
                                  kNoise * std::max(all[i].noise(), median(std::move(largest))));
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
    for (size_t i = 0; i < all.size(); ++i)
        judge_frame(shot, all, i);
}

} // namespace tonetool::sequence
