// Lone bright pixels that neither their surroundings nor other frames have.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "sequence/qc_shot.h"

namespace tonetool::sequence {

namespace {

// Surroundings below this share of the picture's mean luminance count as having so much.
constexpr double kFloor = 0.05;
// Of more spikes than these in a frame the next gives the level of its noise.
constexpr size_t kFew = 9;
// How far noise alone may go beyond that level, or beyond the usual largest spike of a shot.
constexpr double kNoise = 4;
// How the light of a small lamp may change as it moves over the pixels.
constexpr double kSameLight = 4;

// A spike that no neighbouring frame has.
struct Lone {
    const QcSpot* spot;
    double ratio; ///< to its surroundings
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
    for (int cell : facts.picture.thumbnail) {
        sum += luminance_of(cell);
    }
    return sum / double(facts.picture.thumbnail.size());
}

// A lamp or a glint is there in the next frame, too, not far away: in the same cell of the
// thumbnail or one beside it.
bool is_seen_in(const QcFacts& other, const QcSpot& spike) {
    const std::array<int, 4>& window = other.parts.front().display;
    const int cell_x = int(int64_t(spike.x - window[0]) * QcPicture::kWide / window[2]);
    const int cell_y = int(int64_t(spike.y - window[1]) * QcPicture::kHigh / window[3]);
    double most = 0;
    for (int y = std::max(cell_y - 1, 0); y <= std::min(cell_y + 1, QcPicture::kHigh - 1); ++y) {
        for (int x = std::max(cell_x - 1, 0); x <= std::min(cell_x + 1, QcPicture::kWide - 1);
             ++x) {
            most =
                std::max(most, luminance_of(other.picture.peaks[size_t(y * QcPicture::kWide + x)]));
        }
    }
    return most * kSameLight >= spike.value;
}

Spikes spikes_of(const std::vector<QcFrame*>& frames, size_t i, double usual_mean) {
    Spikes spikes{frames[i], {}};
    for (const QcSpot& spot : frames[i]->facts.picture.spikes) {
        const double around = std::max(spot.around, kFloor * usual_mean);
        const bool known = (i > 0 && is_seen_in(frames[i - 1]->facts, spot)) ||
                           (i + 1 < frames.size() && is_seen_in(frames[i + 1]->facts, spot));
        if (!known && around > 0) {
            spikes.lone.push_back({&spot, spot.value / around});
        }
    }
    std::stable_sort(spikes.lone.begin(), spikes.lone.end(),
                     [](const Lone& a, const Lone& b) { return a.ratio > b.ratio; });
    return spikes;
}

void judge_frame(QcShot& shot, const std::vector<Spikes>& all, size_t i) {
    std::vector<double> largest;
    for (size_t k = 0; k < all.size(); ++k) {
        if (k != i) {
            largest.push_back(all[k].largest());
        }
    }
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

// A picture alone cannot tell: a lamp is a lone bright pixel, too.
void find_fireflies(QcShot& shot) {
    const std::vector<QcFrame*> frames = shot.pictures();
    if (frames.size() < 2) {
        return;
    }
    std::vector<double> means;
    for (const QcFrame* frame : frames) {
        means.push_back(mean_luminance(frame->facts));
    }
    const double usual_mean = median(std::move(means));
    std::vector<Spikes> all;
    for (size_t i = 0; i < frames.size(); ++i) {
        all.push_back(spikes_of(frames, i, usual_mean));
    }
    for (size_t i = 0; i < all.size(); ++i) {
        judge_frame(shot, all, i);
    }
}

} // namespace tonetool::sequence
