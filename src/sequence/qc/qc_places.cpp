// SPDX-License-Identifier: BSD-3-Clause
// Places in the picture that have one exact value: holes, and matte bars.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;
using Frames = std::vector<QcFrame*>;

bool same_place(const QcRectangle& a, const QcRectangle& b) {
    return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

// NaN is equal to NaN.
bool same_value(const QcRectangle& a, const QcRectangle& b) {
    return std::equal(a.color.begin(), a.color.end(), b.color.begin(), [](float one, float other) {
        return one == other || (std::isnan(one) && std::isnan(other));
    });
}

bool has_place(const QcFrame& frame, const QcRectangle& rectangle) {
    const std::vector<QcRectangle>& all = frame.facts.picture.rectangles;
    return std::any_of(all.begin(), all.end(),
                       [&](const QcRectangle& other) { return same_place(other, rectangle); });
}

bool has_value(const QcFrame& frame, const QcRectangle& rectangle) {
    const std::vector<QcRectangle>& all = frame.facts.picture.rectangles;
    return std::any_of(all.begin(), all.end(),
                       [&](const QcRectangle& other) { return same_value(other, rectangle); });
}

// The frames around frame k that have the rectangle, and all between them.
std::pair<size_t, size_t> run_of(const Frames& frames, size_t k, const QcRectangle& rectangle) {
    size_t first = k, last = k;
    while (first > 0 && has_place(*frames[first - 1], rectangle))
        --first;
    while (last + 1 < frames.size() && has_place(*frames[last + 1], rectangle))
        ++last;
    return {first, last};
}

// The nearest frames before and after that do not have the rectangle.
Frames frames_without(const Frames& frames, size_t k, const QcRectangle& rectangle) {
    const auto [first, last] = run_of(frames, k, rectangle);
    Frames near;
    if (first > 0 && same_windows(*frames[first - 1], *frames[k]))
        near.push_back(frames[first - 1]);
    if (last + 1 < frames.size() && same_windows(*frames[last + 1], *frames[k]))
        near.push_back(frames[last + 1]);
    return near;
}

// Lamps, signs and lit windows have exact values, too: other frames have them elsewhere, or again.
bool is_of_the_scene(const Frames& frames, size_t k, const QcRectangle& rectangle) {
    const auto elsewhere = [&](size_t at) {
        return at < frames.size() && has_value(*frames[at], rectangle) &&
               !has_place(*frames[at], rectangle);
    };
    if (elsewhere(k + 1) || (k > 0 && elsewhere(k - 1)))
        return true;
    if (!(*std::max_element(rectangle.color.begin(), rectangle.color.end()) > 0))
        return false;
    const auto [first, last] = run_of(frames, k, rectangle);
    for (size_t i = 0; i < frames.size(); ++i)
        if ((i < first || i > last) && has_value(*frames[i], rectangle))
            return true;
    return false;
}

struct Span {
    int first, last; ///< cells, parts of a border; the last is not in it
};

Span span_of(int begin, int size, int from, int length, int cells) {
    const double a = double(begin - from) / length * cells;
    const double b = double(begin + size - from) / length * cells;
    return {std::clamp(int(std::floor(a)), 0, cells), std::clamp(int(std::ceil(b)), 0, cells)};
}

// The share of the cells under the rectangle that are lit in this frame; 0 outside of the display
// window.
double lit_share(const QcFrame& frame, const QcRectangle& rectangle) {
    constexpr int lit = -13288; // 1e-4
    const std::array<int, 4>& window = frame.facts.parts.front().display;
    const Span x = span_of(rectangle.x, rectangle.width, window[0], window[2], QcPicture::kWide);
    const Span y = span_of(rectangle.y, rectangle.height, window[1], window[3], QcPicture::kHigh);
    int count = 0;
    for (int row = y.first; row < y.last; ++row)
        for (int column = x.first; column < x.last; ++column)
            count +=
                frame.facts.picture.thumbnail[size_t(row) * QcPicture::kWide + size_t(column)] >
                lit;
    const int all = (x.last - x.first) * (y.last - y.first);
    return all > 0 ? double(count) / all : 0;
}

// Whether the border of this frame is plain along the rectangle.
bool is_plain(const std::array<int, 32>& border, const Span& along) {
    int sum = 0;
    for (int part = along.first; part < along.last; ++part)
        sum += border[size_t(part)];
    return sum > 50 * (along.last - along.first);
}

// The rim of a set that grows or shrinks: it is in the other frame, too, up to the border.
bool is_rim(const QcFrame& other, const QcRectangle& r) {
    const std::array<int, 4>& window = other.facts.parts.front().data;
    const QcBorders& borders = other.facts.picture.borders;
    const Span x = span_of(r.x, r.width, window[0], window[2], 32);
    const Span y = span_of(r.y, r.height, window[1], window[3], 32);
    return (r.x == window[0] && is_plain(borders.left, y)) ||
           (r.x + r.width == window[0] + window[2] && is_plain(borders.right, y)) ||
           (r.y == window[1] && is_plain(borders.top, x)) ||
           (r.y + r.height == window[1] + window[3] && is_plain(borders.bottom, x));
}

bool is_hole(const Frames& frames, size_t k, const QcRectangle& rectangle) {
    constexpr double mostly = 0.9, matte = 0.01;
    const Frames near = frames_without(frames, k, rectangle);
    return !near.empty() && !is_of_the_scene(frames, k, rectangle) &&
           std::all_of(near.begin(), near.end(), [&](const QcFrame* other) {
               return lit_share(*other, rectangle) >= mostly &&
                      other->facts.picture.alpha_clear <= matte && !is_rim(*other, rectangle);
           });
}

std::string value_text(const QcRectangle& rectangle) {
    const auto& [r, g, b] = rectangle.color;
    return r == g && g == b ? format("{:.4g}", r) : format("{:.4g}, {:.4g}, {:.4g}", r, g, b);
}

void add_holes(QcShot& shot, const Frames& frames, size_t k) {
    std::vector<const QcRectangle*> holes;
    for (const QcRectangle& rectangle : frames[k]->facts.picture.rectangles)
        if (double(rectangle.width) * rectangle.height > shot.threshold("hole") &&
            is_hole(frames, k, rectangle))
            holes.push_back(&rectangle);
    if (holes.empty())
        return;
    const auto smaller = [](const QcRectangle* a, const QcRectangle* b) {
        return std::make_pair(!a->background, double(a->width) * a->height) <
               std::make_pair(!b->background, double(b->width) * b->height);
    };
    const QcRectangle& worst = **std::max_element(holes.begin(), holes.end(), smaller);
    const std::string more =
        holes.size() > 1 ? format(", and {} more", holes.size() - 1) : std::string();
    shot.add(*frames[k], "hole",
             format("{}x{} pixels at ({}, {}) are all {}, not as in the frames around{}{}",
                    worst.width, worst.height, worst.x, worst.y, value_text(worst),
                    worst.background ? "; nothing is behind them" : "", more),
             {picture_layer(frames[k]->facts).name, Position{worst.x, worst.y},
              double(worst.width) * worst.height,
              worst.background ? std::optional(Severity::Warning) : std::nullopt,
              std::array<int, 4>{worst.x, worst.y, worst.width, worst.height}});
    mark_change(frames, k, k);
}

// A rectangle of all frames that reaches from border to border.
void find_bars(QcShot& shot, const Frames& frames) {
    const QcFacts& facts = frames.front()->facts;
    const std::array<int, 4>& window = facts.parts.front().data;
    for (const QcRectangle& r : facts.picture.rectangles) {
        const bool across = r.width == window[2] || r.height == window[3];
        if (across && std::all_of(frames.begin(), frames.end(),
                                  [&](const QcFrame* frame) { return has_place(*frame, r); })) {
            shot.add(*frames.front(), "bars",
                     format("{}x{} pixels at ({}, {}) are all {} in all frames", r.width, r.height,
                            r.x, r.y, value_text(r)),
                     {picture_layer(facts).name,
                      Position{r.x, r.y},
                      {},
                      {},
                      std::array<int, 4>{r.x, r.y, r.width, r.height}});
        }
    }
}

} // namespace

void find_holes(QcShot& shot) {
    const Frames frames = shot.pictures();
    if (frames.size() < kEnoughFrames)
        return;
    find_bars(shot, frames);
    for (size_t k = 0; k < frames.size(); ++k)
        add_holes(shot, frames, k);
}

} // namespace tonetool::sequence
