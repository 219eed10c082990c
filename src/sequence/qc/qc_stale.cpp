// SPDX-License-Identifier: BSD-3-Clause
// Rectangles of pixels that are those of another frame: stalebucket.
//
// Two frames that have the same fingerprints at some places show the same pixels there. That is so
// in a still part of the picture under a fixed seed, too, but there the frames beside have them as
// well.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;
using Frames = std::vector<QcFrame*>;

constexpr size_t kWide = size_t(QcPicture::kPeaksWide), kHigh = size_t(QcPicture::kPeaksHigh);

// Two frames, the earlier first, and the points that they share.
using Pair = std::pair<size_t, size_t>;
using Shared = std::map<Pair, std::vector<size_t>>;

// The frames that have one fingerprint at a point, without those beside which another has it too:
// frames that follow each other are left only where they are two.
std::vector<size_t> lone_frames(const std::vector<size_t>& frames) {
    std::vector<size_t> lone;
    for (size_t first = 0; first < frames.size();) {
        size_t last = first;
        while (last + 1 < frames.size() && frames[last + 1] == frames[last] + 1)
            ++last;
        if (first == last || (last == first + 1 && frames.size() == 2))
            lone.insert(lone.end(), frames.begin() + std::ptrdiff_t(first),
                        frames.begin() + std::ptrdiff_t(last) + 1);
        first = last + 1;
    }
    return lone;
}

void add_shared(Shared& shared, size_t point, const std::vector<size_t>& frames) {
    constexpr size_t often = 8; // something that comes and goes
    const std::vector<size_t> lone = lone_frames(frames);
    for (size_t a = 0; lone.size() <= often && a < lone.size(); ++a)
        for (size_t b = a + 1; b < lone.size(); ++b)
            shared[{lone[a], lone[b]}].push_back(point);
}

// The frames of each fingerprint that more than one has. `counts` has a 0 for each fingerprint.
std::map<uint16_t, std::vector<size_t>> repeated(const uint16_t* codes, size_t count,
                                                 std::vector<uint32_t>& counts) {
    for (size_t i = 0; i < count; ++i)
        ++counts[codes[i]];
    std::map<uint16_t, std::vector<size_t>> frames_of;
    for (size_t i = 0; i < count; ++i)
        if (codes[i] > 0 && counts[codes[i]] > 1)
            frames_of[codes[i]].push_back(i);
    for (size_t i = 0; i < count; ++i)
        counts[codes[i]] = 0;
    return frames_of;
}

// Points beside each other are looked at together: the facts of each frame lie elsewhere.
Shared shared_points(const Frames& frames) {
    constexpr size_t together = kWide;
    Shared shared;
    const size_t count = frames.size();
    std::vector<uint16_t> codes(together * count);
    std::vector<uint32_t> counts(65536);
    for (size_t first = 0; first < kWide * kHigh; first += together) {
        for (size_t i = 0; i < count; ++i)
            for (size_t k = 0; k < together; ++k)
                codes[k * count + i] = frames[i]->facts.picture.fingerprints[first + k];
        for (size_t k = 0; k < together; ++k)
            for (const auto& [code, with] : repeated(&codes[k * count], count, counts))
                add_shared(shared, first + k, with);
    }
    return shared;
}

struct Block {
    size_t x0 = kWide, y0 = kHigh, x1 = 0, y1 = 0; ///< the last column and row are in it
};

Block block_of(const std::vector<size_t>& points) {
    Block block;
    for (const size_t point : points) {
        block.x0 = std::min(block.x0, point % kWide);
        block.x1 = std::max(block.x1, point % kWide);
        block.y0 = std::min(block.y0, point / kWide);
        block.y1 = std::max(block.y1, point / kWide);
    }
    return block;
}

// Points are sorted.
bool has_point(const std::vector<size_t>& points, size_t x, size_t y) {
    return x < kWide && y < kHigh &&
           std::binary_search(points.begin(), points.end(), y * kWide + x);
}

// Without the points that no other is beside, where they are so few: of each 30 pairs of frames one
// has such a point by chance.
void drop_chance(std::vector<size_t>& points) {
    constexpr size_t few = 2;
    std::vector<size_t> joined;
    for (const size_t point : points) {
        const size_t x = point % kWide, y = point / kWide;
        bool beside = false;
        for (size_t j = y - (y > 0); j <= y + 1; ++j)
            for (size_t i = x - (x > 0); i <= x + 1; ++i)
                beside = beside || ((i != x || j != y) && has_point(points, i, j));
        if (beside)
            joined.push_back(point);
    }
    if (points.size() - joined.size() <= few)
        points = std::move(joined);
}

// How many squares of 2 x 2 points there are. By chance a square is shared once in 2^64.
size_t squares_in(const std::vector<size_t>& points) {
    return size_t(std::count_if(points.begin(), points.end(), [&](size_t point) {
        const size_t x = point % kWide, y = point / kWide;
        return has_point(points, x + 1, y) && has_point(points, x, y + 1) &&
               has_point(points, x + 1, y + 1);
    }));
}

// Whether these points, which two frames share, are a rectangle that was left from another frame.
bool is_bucket(const Frames& frames, const Pair& pair, const std::vector<size_t>& points) {
    constexpr double full = 0.9, most = 0.6;
    constexpr size_t enough = 2;
    if (points.empty())
        return false;
    const Block block = block_of(points);
    const size_t all = (block.x1 - block.x0 + 1) * (block.y1 - block.y0 + 1);
    if (double(points.size()) < full * double(all) || squares_in(points) < enough ||
        !same_windows(*frames[pair.first], *frames[pair.second]))
        return false;
    const std::vector<uint16_t>& a = frames[pair.first]->facts.picture.fingerprints;
    const std::vector<uint16_t>& b = frames[pair.second]->facts.picture.fingerprints;
    size_t same = 0;
    for (size_t i = 0; i < a.size(); ++i)
        same += a[i] > 0 && a[i] == b[i];
    return double(same) < most * double(a.size());
}

// How far the light at these points is off the way from the frame before to that after.
double bend_of(const Frames& frames, size_t k, const std::vector<size_t>& points) {
    const auto stops = [&](size_t i, size_t point) {
        return std::max(frames[i]->facts.picture.peaks[point] / 8.0, -13.0);
    };
    const size_t before = k > 0 ? k - 1 : 0, after = std::min(k + 1, frames.size() - 1);
    double sum = 0;
    for (const size_t point : points)
        sum += std::abs(stops(k, point) - (stops(before, point) + stops(after, point)) / 2);
    return sum / double(points.size());
}

// In pixels of the display window.
std::array<int, 4> rectangle_of(const QcFrame& frame, const Block& block) {
    const std::array<int, 4>& window = frame.facts.parts.front().display;
    const auto at = [](int from, int size, size_t cell, size_t cells) {
        return from + int(std::lround(double(size) * double(cell) / double(cells)));
    };
    const int x0 = at(window[0], window[2], block.x0, kWide);
    const int y0 = at(window[1], window[3], block.y0, kHigh);
    return {x0, y0, at(window[0], window[2], block.x1 + 1, kWide) - x0,
            at(window[1], window[3], block.y1 + 1, kHigh) - y0};
}

} // namespace

void find_stale_buckets(QcShot& shot) {
    const Frames frames = shot.pictures();
    if (frames.size() < kEnoughFrames)
        return;
    struct Stale {
        size_t other = 0;
        const std::vector<size_t>* points = nullptr;
    };
    std::map<size_t, Stale> found;
    Shared shared = shared_points(frames);
    for (auto& [pair, points] : shared) {
        drop_chance(points);
        if (!is_bucket(frames, pair, points))
            continue;
        const auto& [a, b] = pair;
        const bool is_first = bend_of(frames, a, points) >= bend_of(frames, b, points);
        Stale& stale = found[is_first ? a : b];
        if (!stale.points || stale.points->size() < points.size())
            stale = {is_first ? b : a, &points};
    }
    constexpr int least = 8; // pixels
    for (const auto& [k, stale] : found) {
        QcFrame& frame = *frames[k];
        const std::array<int, 4> at = rectangle_of(frame, block_of(*stale.points));
        if (at[2] < least || at[3] < least)
            continue; // the points of a tiny picture are the same few pixels
        shot.add(frame, "stalebucket",
                 format("about {}x{} pixels at ({}, {}) are those of frame {}", at[2], at[3], at[0],
                        at[1], frames[stale.other]->number),
                 {picture_layer(frame.facts).name, Position{at[0], at[1]}, {}, {}, at});
        mark_change(frames, k, k);
    }
}

} // namespace tonetool::sequence
