// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/color_reader.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstring>
#include <mutex>

#include "imagebuf/color/tone_rows.h"
#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/ignored_pixels.h"
#include "imagebuf/pixels/parallel.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::ROI;

// Rows per task of an image in memory: worth a task, but small beside the image.
constexpr int kRowsInMemory = 64;
constexpr size_t kSmallStep = size_t(2) << 20;

// A hash of a pixel and its place; sums of these do not depend on the order.
uint64_t digest(size_t place, const double (&v)[3]) {
    uint64_t h = place + 0x9e3779b97f4a7c15u;
    for (double x : v) {
        uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof bits);
        h = (h ^ bits) * 0xbf58476d1ce4e5b9u;
        h ^= h >> 31;
    }
    return h;
}

uint64_t alpha_digest(size_t place, float alpha) {
    return alpha == 1 ? 0 : digest(place, {alpha, 0, 0});
}

// Two bits that say what a value is: see ColorPlanes::nonfinite.
unsigned kind(double v) {
    return std::isfinite(v) ? 0 : std::isnan(v) ? 3 : v > 0 ? 1 : 2;
}

// The finite ones of three values: two as they are, of three (beside an alpha) the others' hash.
uint64_t finite_ones(const double (&v)[3]) {
    uint32_t bits[3] = {};
    size_t count = 0;
    for (const double x : v)
        if (std::isfinite(x)) {
            const auto stored = float(x);
            std::memcpy(&bits[count++], &stored, sizeof stored);
        }
    const uint64_t packed = uint64_t(bits[0]) << 32 | bits[1];
    return count < 3 ? packed : digest(size_t(packed), {v[0], v[1], v[2]});
}

// Finite and not negative.
bool is_light(const float (&v)[3]) {
    return v[0] >= 0 && v[1] >= 0 && v[2] >= 0 && v[0] <= FLT_MAX && v[1] <= FLT_MAX &&
           v[2] <= FLT_MAX;
}

// Whether linear Rec.709 is what is stored.
bool keeps_values(const ColorSpace& space) {
    return space.is_rec709 && !space.encoded() && !space.straight && space.scale == 1 &&
           !space.convert;
}

void to_rec709(const ColorSpace& space, double alpha, double (&v)[3]) {
    if (space.encoded() || space.straight || space.scale != 1)
        for (double& x : v)
            x = space.light(x, alpha);
    if (space.is_rec709)
        return;
    const double in[3] = {v[0], v[1], v[2]};
    for (size_t p = 0; p < 3; ++p) {
        const auto& row = space.to_rec709[p];
        v[p] = row[0] * in[0] + row[1] * in[1] + row[2] * in[2];
    }
}

} // namespace

void ColorReader::open(const ImageBuf& image, const PixelOptions& options, ROI region,
                       bool want_alpha, int nthreads) {
    const OIIO::ImageSpec spec = deciding_spec(image);
    find_picture(spec, options, m_choice, m_space);
    m_region = region;
    m_window = OIIO::roi_intersection(image.roi(), region);
    m_alpha = want_alpha;
    m_nthreads = nthreads;
    std::vector<int> channels = {m_choice.r, m_choice.g, m_choice.b};
    if ((m_alpha || m_watch || m_space.straight) && m_choice.a >= 0)
        channels.push_back(m_choice.a);
    const std::vector<ChannelRun> runs = runs_of(channels);
    for (size_t i = 0; i < channels.size(); ++i)
        for (size_t run = 0; run < runs.size(); ++run)
            if (channels[i] >= runs[run].begin && channels[i] < runs[run].end)
                m_place[i] = {run, channels[i] - runs[run].begin, runs[run].count()};
    count_pixels();
    m_source.open(image, runs);
}

void ColorReader::count_pixels() {
    const auto count = [&](const ROI& part) {
        const int64_t pixels =
            part.width() > 0 && part.height() > 0 ? int64_t(part.width()) * part.height() : 0;
        return pixels - (m_ignored && pixels > 0 ? m_ignored->count(part) : 0);
    };
    m_counted = count(m_region);
    m_uncovered = m_counted - count(m_window);
}

size_t ColorReader::row_bytes() const {
    return size_t(m_region.width()) * (3 * sizeof(float) + 1 + (m_alpha ? sizeof(float) : 0));
}

size_t ColorReader::bytes_while_saving() const {
    return kSmallStep + m_source.decoder_bytes();
}

ColorPlanes ColorReader::planes() const {
    ColorPlanes out;
    out.region = m_region;
    out.begin = out.end = m_region.ybegin;
    out.choice = m_choice;
    out.ignored = m_ignored;
    out.counted = m_counted;
    out.uncovered_count = m_uncovered;
    return out;
}

void ColorReader::read(int begin, int end, ColorPlanes& planes) {
    const int from = std::clamp(planes.end, begin, end);
    const size_t drop = begin > planes.begin ? planes.at(std::min(begin, planes.end)) : 0;
    const size_t kept = size_t(from - begin) * size_t(planes.width());
    const size_t n = size_t(end - begin) * size_t(planes.width());
    try {
        expect_memory(uint64_t(end - begin) * row_bytes());
    } catch (const TooLarge& failure) {
        throw Refusal(m_source.named(failure.what()));
    }
    const auto move_rows = [&](auto& array) {
        array.keep(drop, kept);
        array.resize(n);
    };
    const auto move_written = [&](auto& array) {
        move_rows(array);
        array.expect_all_written();
    };
    for (auto& p : planes.plane)
        move_written(p);
    move_written(planes.nonfinite);
    if (planes.counts.nonfinite > 0)
        move_rows(planes.beside);
    else
        (planes.beside = {}).resize(n);
    if (m_alpha)
        move_written(planes.alpha);
    planes.begin = begin;
    planes.end = end;
    fill(from, end, planes);
}

void ColorReader::fill(int begin, int end, ColorPlanes& planes) {
    if (m_source.from_file()) {
        fill_from_file(begin, end, planes);
        return;
    }
    std::mutex lock;
    const int tasks = (end - begin + kRowsInMemory - 1) / kRowsInMemory;
    make_parallel(m_nthreads)(tasks, [&](int64_t task) {
        const int first = begin + int(task) * kRowsInMemory;
        const int last = std::min(first + kRowsInMemory, end);
        Stage stage;
        ColorCounts counts;
        fetch(first, last, stage);
        for (int y = first; y < last; ++y)
            clean_row(y, stage, planes, counts);
        const std::lock_guard<std::mutex> hold(lock);
        planes.counts.add(counts);
    });
}

void ColorReader::fill_from_file(int begin, int end, ColorPlanes& planes) {
    std::mutex lock;
    for (int first = begin; first < end;) {
        const int rows = m_saving_memory ? m_source.rows_at_once(first, kSmallStep)
                                         : m_source.rows_at_once(first);
        const int last = std::min(first + rows, end);
        fetch(first, last, m_stage);
        make_parallel(m_nthreads)(last - first, [&](int64_t row) {
            ColorCounts counts;
            clean_row(first + int(row), m_stage, planes, counts);
            const std::lock_guard<std::mutex> hold(lock);
            planes.counts.add(counts);
        });
        first = last;
    }
    if (m_saving_memory)
        m_source.rest();
    if (m_saving_memory || end == m_region.yend)
        m_stage = {};
}

void ColorReader::fetch(int begin, int end, Stage& stage) {
    stage.begin = std::max(begin, m_window.ybegin);
    const int last = std::min(end, m_window.yend);
    stage.runs.resize(m_source.runs().size());
    for (size_t run = 0; run < stage.runs.size() && stage.begin < last; ++run) {
        const size_t row = size_t(m_source.width()) * size_t(m_source.runs()[run].count());
        stage.runs[run].resize(row * size_t(last - stage.begin));
        m_source.read(stage.begin, last, run, stage.runs[run].data());
    }
}

const float* ColorReader::staged(const Stage& stage, int y, size_t which) const {
    const Place& place = m_place[which];
    const size_t row = size_t(y - stage.begin) * size_t(m_source.width());
    const auto x = size_t(m_window.xbegin - m_source.left());
    return stage.runs[place.run].data() + (row + x) * size_t(place.stride) + place.channel;
}

void ColorReader::clean_row(int y, const Stage& stage, ColorPlanes& planes,
                            ColorCounts& counts) const {
    const size_t at = planes.at(y), width = size_t(planes.width());
    Row row{{},
            planes.alpha.empty() ? nullptr : planes.alpha.data() + at,
            planes.nonfinite.data() + at,
            planes.beside.data() + at,
            size_t(y - m_region.ybegin) * width};
    for (size_t p = 0; p < 3; ++p)
        row.plane[p] = planes.plane[p].data() + at;
    const bool inside = y >= m_window.ybegin && y < m_window.yend && m_window.width() > 0;
    const size_t from = inside ? size_t(m_window.xbegin - m_region.xbegin) : width;
    const size_t to = inside ? from + size_t(m_window.width()) : width;
    row.blacken(0, from);
    row.blacken(to, width);
    if (inside && m_ignored)
        clean_some(row, from, to, y, stage, counts);
    else if (inside)
        clean(row, from, to, y, stage, counts);
}

// What does not count is in no count, but where neighbours see it in the largest component: a curve
// must be sound for all that it is asked for.
void ColorReader::clean_some(const Row& row, size_t from, size_t to, int y, const Stage& stage,
                             ColorCounts& counts) const {
    const uint8_t* ignored = m_ignored->row(y);
    for (size_t begin = from; begin < to;) {
        const size_t end =
            size_t(std::find(ignored + begin, ignored + to, uint8_t(1 - ignored[begin])) - ignored);
        if (ignored[begin] == 0) {
            clean(row, begin, end, y, stage, counts);
        } else if (m_keep_ignored) {
            ColorCounts uncounted;
            clean(row, begin, end, y, stage, uncounted);
            counts.largest = std::max(counts.largest, uncounted.largest);
            std::fill(row.nonfinite + begin, row.nonfinite + end, uint8_t(0));
        } else {
            row.blacken(begin, end);
        }
        begin = end;
    }
}

// Through the configuration that knows the space; empty where none is asked.
std::vector<float> ColorReader::convert(const float* const (&in)[3], const size_t (&step)[3],
                                        size_t count) const {
    std::vector<float> packed;
    if (!m_space.convert)
        return packed;
    for (size_t x = 0; x < count; ++x)
        for (size_t p = 0; p < 3; ++p) {
            const float v = in[p][x * step[p]];
            packed.push_back(light_to_show(v));
        }
    m_space.convert(packed.data(), ptrdiff_t(count));
    return packed;
}

void ColorReader::clean(const Row& row, size_t from, size_t to, int y, const Stage& stage,
                        ColorCounts& counts) const {
    const size_t skip = from - size_t(m_window.xbegin - m_region.xbegin);
    const size_t step[3] = {size_t(m_place[0].stride), size_t(m_place[1].stride),
                            size_t(m_place[2].stride)};
    const float* in[3] = {staged(stage, y, 0) + skip * step[0],
                          staged(stage, y, 1) + skip * step[1],
                          staged(stage, y, 2) + skip * step[2]};
    const size_t alpha_step = size_t(m_place[3].stride);
    const float* alpha = alpha_step > 0 ? staged(stage, y, 3) + skip * alpha_step : nullptr;
    const std::vector<float> converted = convert(in, step, to - from);
    const bool as_stored = keeps_values(m_space) && !row.alpha;
    for (size_t x = from; x < to; ++x) {
        const float a = alpha ? alpha[(x - from) * alpha_step] : 1.0f;
        const float stored[3] = {in[0][(x - from) * step[0]], in[1][(x - from) * step[1]],
                                 in[2][(x - from) * step[2]]};
        if (as_stored && a == 1 && is_light(stored)) {
            row.nonfinite[x] = 0;
            for (size_t p = 0; p < 3; ++p) {
                row.plane[p][x] = stored[p];
                counts.largest = std::max(counts.largest, stored[p]);
            }
        } else {
            clean_pixel(row, x, stored, alpha ? &a : nullptr,
                        converted.empty() ? nullptr : converted.data() + 3 * (x - from), counts);
        }
    }
}

void ColorReader::clean_pixel(const Row& row, size_t x, const float (&stored)[3],
                              const float* alpha, const float* converted,
                              ColorCounts& counts) const {
    const float a = alpha ? *alpha : 1.0f;
    double v[3] = {stored[0], stored[1], stored[2]};
    unsigned kinds = kind(v[0]) | kind(v[1]) << 2 | kind(v[2]) << 4;
    if (row.alpha) {
        kinds |= m_any_alpha ? 0 : kind(a) << 6;
        row.alpha[x] = std::isfinite(a) ? a : 0;
    } else if (alpha && m_watch) {
        counts.alpha_digest += alpha_digest(row.place + x, a);
    }
    const bool finite = kinds == 0;
    row.nonfinite[x] = uint8_t(kinds);
    counts.nonfinite += !finite;
    if (!finite)
        row.beside[x] = finite_ones(v);
    const bool kept = finite || m_keep_infinities;
    for (size_t p = 0; kept && p < 3; ++p)
        v[p] = double(converted ? converted[p] : light_to_show(stored[p]));
    if (kept)
        to_rec709(m_space, double(a), v);
    if (finite && (v[0] < 0 || v[1] < 0 || v[2] < 0)) {
        ++counts.negative;
        counts.negative_digest += digest(row.place + x, v);
    }
    for (size_t p = 0; p < 3; ++p) {
        row.plane[p][x] = kept ? float(std::clamp(v[p], double(m_least), double(FLT_MAX))) : 0.0f;
        counts.largest = finite ? std::max(counts.largest, row.plane[p][x]) : counts.largest;
    }
}

// Pixels that the image does not cover.
void ColorReader::Row::blacken(size_t from, size_t to) const {
    for (float* p : plane)
        std::fill(p + from, p + to, 0.0f);
    std::fill(nonfinite + from, nonfinite + to, uint8_t(0));
    if (alpha)
        std::fill(alpha + from, alpha + to, 0.0f);
}

ColorPlanes read_planes(const ImageBuf& image, const PixelOptions& options, ROI region,
                        bool want_alpha, int nthreads) {
    ColorReader reader;
    reader.open(image, options, region, want_alpha, nthreads);
    ColorPlanes out = reader.planes();
    reader.read(region.ybegin, region.yend, out);
    return out;
}

} // namespace tonetool
