// Lone bright pixels that neither their surroundings nor other frames have.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sequence/qc_shot.h"

namespace tonetool::sequence {

namespace {

// Surroundings below this share of the picture's mean luminance count as having so much.
constexpr double kFloor = 0.05;
// Of more spikes than these in a frame the next gives the level of its noise.
constexpr size_t kFew = 9;
// How far noise alone may go beyond that level, or beyond the usual largest spike of a shot.
constexpr double kNoise = 4;
// What moves between frames: a share of the width, and how its light may change.
constexpr double kMoves = 0.03, kSameLight = 8;
constexpr int kMovesAtLeast = 8;

struct Spikes {
    QcFrame* frame;
    std::vector<double> ratios; ///< as the spikes are listed
    double level = 0;           ///< of the frame's own noise
    double largest = 0;
};

double mean_luminance(const QcFacts& facts) {
    double sum = 0;
    for (int cell : facts.picture.thumbnail) {
        sum += cell > QcPicture::kDark ? std::exp2(cell / 1000.0) : 0;
    }
    return sum / double(facts.picture.thumbnail.size());
}

Spikes spikes_of(QcFrame& frame, double usual_mean) {
    Spikes spikes{&frame, {}, 0, 0};
    for (const QcSpot& spike : frame.facts.picture.spikes) {
        const double around = std::max(spike.around, kFloor * usual_mean);
        spikes.ratios.push_back(around > 0 ? spike.value / around : 0);
    }
    std::vector<double> sorted = spikes.ratios;
    std::sort(sorted.rbegin(), sorted.rend());
    spikes.largest = sorted.empty() ? 0 : sorted.front();
    spikes.level = sorted.size() > kFew ? sorted[kFew] : 0;
    return spikes;
}

// A lamp or a glint is there in the next frame, too, not far away.
bool is_seen_in(const QcFrame& other, const QcSpot& spike) {
    const double reach =
        std::max(kMoves * other.facts.parts.front().display[2], double(kMovesAtLeast));
    const auto& spots = other.facts.picture.spikes;
    return std::any_of(spots.begin(), spots.end(), [&](const QcSpot& spot) {
        return std::abs(spot.x - spike.x) <= reach && std::abs(spot.y - spike.y) <= reach &&
               spot.value * kSameLight >= spike.value;
    });
}

void judge_frame(QcShot& shot, const std::vector<Spikes>& all, size_t i) {
    std::vector<double> largest;
    for (size_t k = 0; k < all.size(); ++k) {
        if (k != i) {
            largest.push_back(all[k].largest);
        }
    }
    const double noise = kNoise * std::max(all[i].level, median(largest));
    const double limit = std::max(shot.threshold("firefly"), noise);
    const QcPicture& picture = all[i].frame->facts.picture;
    size_t count = 0, worst = 0;
    for (size_t k = 0; k < picture.spikes.size(); ++k) {
        const bool known = (i > 0 && is_seen_in(*all[i - 1].frame, picture.spikes[k])) ||
                           (i + 1 < all.size() && is_seen_in(*all[i + 1].frame, picture.spikes[k]));
        if (all[i].ratios[k] <= limit || known) {
            continue;
        }
        if (count++ == 0 || all[i].ratios[k] > all[i].ratios[worst]) {
            worst = k;
        }
    }
    if (count > 0) {
        const QcSpot& spike = picture.spikes[worst];
        shot.add(*all[i].frame, "firefly",
                 OIIO::Strutil::fmt::format(
                     "{} {}, the worst at ({}, {}): {:.3g} where pixels around it are at most "
                     "{:.3g}, and no neighbouring frame has it",
                     count, count == 1 ? "firefly" : "fireflies", spike.x, spike.y, spike.value,
                     spike.around),
                 {picture.layer, Position{spike.x, spike.y}, all[i].ratios[worst]});
    }
}

} // namespace

void find_fireflies(QcShot& shot) {
    std::vector<double> means;
    for (const QcFrame* frame : shot.pictures()) {
        means.push_back(mean_luminance(frame->facts));
    }
    const double usual_mean = median(means);
    std::vector<Spikes> all;
    for (QcFrame* frame : shot.pictures()) {
        all.push_back(spikes_of(*frame, usual_mean));
    }
    for (size_t i = 0; i < all.size(); ++i) {
        judge_frame(shot, all, i);
    }
}

} // namespace tonetool::sequence
