// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/flip_tile.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstring>

namespace tonetool::kernels {
namespace {

constexpr int kColors = 3;

int round_up(int n, int step) {
    return (n + step - 1) / step * step;
}

StripShape make_strips(int lanes, int columns, int halo) {
    StripShape strips;
    strips.lanes = lanes;
    strips.halo = halo;
    const int needed = (columns + strips.lanes - 1) / strips.lanes;
    strips.strip = round_up(std::max(needed, halo), kStripStep);
    return strips;
}

bool same_floats(const float* a, const float* b, ptrdiff_t count) {
    return std::memcmp(a, b, size_t(count) * sizeof(float)) == 0;
}

// `count` pixels of a row from column x0 on, the border replicated.
void copy_columns(const float* in, int width, int x0, int count, float* out) {
    const int before = std::clamp(-x0, 0, count);
    const int inside = std::clamp(width - x0, before, count);
    std::fill(out, out + before, in[0]);
    std::copy(in + x0 + before, in + x0 + inside, out + before);
    std::fill(out + inside, out + count, in[width - 1]);
}

// Part of a row of an image that is soon read or written: rows of a tile lie too far from each
// other for a core to foresee the next one.
void prefetch(const float* row, int from, int to) {
    constexpr int line = 16;
    for (int x = from; x < to; x += line)
        hwy::Prefetch(row + x);
    hwy::Prefetch(row + to - 1);
}

// The number of columns before the tile: its halo, rounded up to whole vectors.
ptrdiff_t lead(const StripShape& strips) {
    return round_up(strips.halo, kMostLanes);
}

ptrdiff_t row_pitch(const StripShape& strips) {
    return lead(strips) + strips.columns() + strips.halo;
}

} // namespace

Planes::Planes(int count, ptrdiff_t pitch, int rows)
    : m_data(hwy::AllocateAligned<float>(size_t(count * pitch * rows))),
      m_pitch(pitch),
      m_size(pitch * rows) {
    std::fill_n(m_data.get(), count * m_size, 0.0f);
}

TileShape::TileShape(int lanes, int most_columns, int most_rows, int halo)
    : strips(make_strips(lanes, most_columns, halo)),
      width(most_columns),
      height(most_rows) {}

bool same_pixels(const ConstRgb& a, const ConstRgb& b, const Window& window, int halo) {
    const int x0 = std::max(window.x0 - halo, 0), y0 = std::max(window.y0 - halo, 0);
    const int x1 = std::min(window.x0 + window.width + halo, a.width);
    const int y1 = std::min(window.y0 + window.height + halo, a.height);
    for (int y = y0; y < y1; ++y)
        for (int c = 0; c < kColors; ++c)
            if (!same_floats(a.plane[c] + (y - a.first_row) * a.stride + x0,
                             b.plane[c] + (y - b.first_row) * b.stride + x0, x1 - x0))
                return false;
    return true;
}

FlipTile::FlipTile(const FlipRows& functions, const TileShape& shape, const LaneTaps& taps,
                   size_t tests, bool keep_each)
    : m_functions(functions),
      m_shape(shape),
      m_taps(taps, functions.lanes),
      m_keep_each(keep_each),
      m_slots(2 * shape.strips.halo + kRowBlock),
      m_tests(tests),
      m_row(1, row_pitch(shape.strips), 1),
      m_toned(kColors, shape.strips.pitch(), 1),
      m_columns(kColumnPlanes, shape.strips.wide_pitch(), kRowBlock),
      m_steps(1, shape.strips.wide_pitch(), 1),
      m_work(kWorkPlanes, shape.strips.columns(), 1),
      m_reference_features(kFeaturePlanes, shape.strips.columns(), kRowBlock),
      m_test_features(kFeaturePlanes, shape.strips.columns(), 1) {
    make(m_reference);
    for (Test& test : m_tests) {
        make(test);
        test.differing.resize(size_t(shape.padded_rows() + 1));
        test.shows.resize(size_t(m_slots));
        test.result =
            Planes(keep_each ? kResultPlanes : kLastError, shape.strips.columns(), shape.rows());
    }
}

size_t FlipTile::bytes(const TileShape& shape, size_t tests, bool keep_each) {
    const StripShape& s = shape.strips;
    const auto pitch = size_t(s.pitch()), wide = size_t(s.wide_pitch());
    const auto columns = size_t(s.columns()), rows = size_t(shape.rows());
    const size_t side = pitch * (kColors * size_t(shape.padded_rows()) +
                                 kOpponentPlanes * size_t(2 * s.halo + kRowBlock));
    const size_t result = columns * rows * size_t(keep_each ? kResultPlanes : kLastError);
    const size_t row =
        columns * (kWorkPlanes + kFeaturePlanes * (kRowBlock + 1)) + size_t(row_pitch(s));
    const size_t block = wide * (kColumnPlanes * kRowBlock + 1);
    const size_t toned = pitch * kColors;
    return sizeof(float) * (side * (1 + tests) + result * tests + row + toned + block);
}

void FlipTile::make(Side& side) const {
    side.rgb = Planes(kColors, m_shape.strips.pitch(), m_shape.padded_rows());
    side.ring = Planes(kOpponentPlanes, m_shape.strips.pitch(), m_slots);
    side.rows.resize(size_t(kOpponentPlanes * m_slots));
}

void FlipTile::load(const Window& tile, const ConstRgb& reference,
                    const std::vector<const ConstRgb*>& tests) {
    m_tile = tile;
    m_shape.width = tile.width;
    m_shape.height = tile.height;
    m_active = tests.size();
    load(m_reference, reference);
    for (size_t t = 0; t < m_active; ++t) {
        Test& test = m_tests[t];
        load(test, *tests[t]);
        find_differing_rows(test);
        for (ResultPlane p : {kError, kIndex})
            std::fill_n(test.result[p], m_shape.rows() * m_shape.strips.columns(), 0.0f);
    }
}

void FlipTile::load(Side& side, const ConstRgb& image) {
    const StripShape& strips = m_shape.strips;
    // No further than the halo of the last row: a scanline block need not hold more.
    const int last = std::min(m_tile.y0 + m_tile.height - 1 + strips.halo, image.height - 1);
    const auto source = [&](int c, int y) {
        const int row = std::clamp(m_tile.y0 - strips.halo + y, 0, last) - image.first_row;
        return image.plane[c] + row * image.stride;
    };
    for (int y = 0; y < m_shape.padded_rows(); ++y)
        for (int c = 0; c < kColors; ++c)
            pack_row(source(c, y), source(c, y + 1), image.width, side.rgb.row(c, y));
}

// A row of the image into strips, while the next one is on its way; then the outer columns, those
// on the left from the tile outwards.
void FlipTile::pack_row(const float* in, const float* next, int width, float* out) {
    const StripShape& strips = m_shape.strips;
    const ptrdiff_t before = lead(strips);
    copy_columns(in, width, m_tile.x0 - int(before), int(row_pitch(strips)), m_row[0]);
    prefetch(next, std::max(m_tile.x0 - strips.halo, 0),
             std::min(m_tile.x0 + int(strips.columns()) + strips.halo, width));
    const float* columns = m_row[0] + before;
    m_functions.transpose(columns, strips.lanes, strips.strip, out);
    float* outer = out + strips.columns();
    std::reverse_copy(columns - strips.halo, columns, outer);
    std::copy_n(columns + strips.columns(), strips.halo, outer + strips.halo);
}

void FlipTile::find_differing_rows(Test& test) const {
    test.differing[0] = 0;
    for (int y = 0; y < m_shape.padded_rows(); ++y) {
        bool same = true;
        for (int c = 0; c < kColors; ++c)
            same = same && same_floats(test.rgb.row(c, y), m_reference.rgb.row(c, y),
                                       m_shape.strips.pitch());
        test.differing[size_t(y + 1)] = test.differing[size_t(y)] + !same;
    }
}

// Whether all rows that the block at `y` depends on are equal in test and reference.
bool FlipTile::same_window(const Test& test, int y) const {
    return test.differing[size_t(y + m_slots)] == test.differing[size_t(y)];
}

bool FlipTile::same_behind_curve(const Test& test) const {
    return std::count(test.shows.begin(), test.shows.end(), 0) == m_slots;
}

void FlipTile::show_row(Side& side, int y, const Exposure& exposure) {
    // The first row has no row above, and its steps are not looked at.
    const int slot = y % m_slots, above = (y + m_slots - 1) % m_slots;
    const float* rgb[kColors];
    float* out[kColors];
    for (int c = 0; c < kColors; ++c) {
        rgb[c] = side.rgb.row(c, y);
        out[c] = side.ring.row(kY + c, slot);
    }
    ToneCurve curve = exposure.curve;
    float scale = exposure.scale;
    if (exposure.rows) {
        float* toned[kColors];
        for (int c = 0; c < kColors; ++c)
            toned[c] = m_toned[c];
        exposure.rows(rgb, toned, m_shape.strips.pitch(), scale);
        std::copy_n(toned, kColors, rgb);
        curve = {};
        scale = 1;
    }
    m_functions.to_opponent(rgb, m_shape.strips.pitch(), curve, scale, out,
                            side.ring.row(kY, above), side.ring.row(kStepY, above));
    side.next_row = y + 1;
}

// All rows that the block at `y` depends on; most are there from the block before.
void FlipTile::show_rows(int y, const Exposure& exposure) {
    for (int row = first_missing(m_reference, y); row < y + m_slots; ++row)
        show_row(m_reference, row, exposure);
}

// The first row that the block at `y` still lacks: rows are tone mapped from top to bottom.
int FlipTile::first_missing(const Side& side, int y) {
    return std::max(y, side.next_row);
}

void FlipTile::show_rows(Test& test, int y, const Exposure& exposure) {
    for (int row = first_missing(test, y); row < y + m_slots; ++row) {
        const int slot = row % m_slots;
        show_row(test, row, exposure);
        bool same = true;
        for (int p = kY; p <= kYz; ++p)
            same = same && same_floats(test.ring.row(p, slot), m_reference.ring.row(p, slot),
                                       m_shape.strips.pitch());
        test.shows[size_t(slot)] = !same;
    }
}

// Whether anything that the block at `y` depends on differs at this exposure. Where nothing does
// (the pixels are the same, or all that differ are clamped) the error is exactly 0.
bool FlipTile::differs(Test& test, int y, const Exposure& exposure) {
    if (same_window(test, y))
        return false;
    show_rows(y, exposure);
    show_rows(test, y, exposure);
    return !same_behind_curve(test);
}

void FlipTile::filter_columns(Side& side, int y) {
    const StripShape& strips = m_shape.strips;
    RowTable in[kOpponentPlanes];
    const int first = y % m_slots;
    for (int p = 0; p < kOpponentPlanes; ++p) {
        const float** rows = side.rows.data() + p * m_slots;
        for (int slot = 0; slot < m_slots; ++slot)
            rows[slot >= first ? slot - first : slot - first + m_slots] = side.ring.row(p, slot);
        in[p] = rows + strips.halo;
    }
    float* out[kColumnPlanes][kRowBlock];
    for (int p = 0; p < kColumnPlanes; ++p)
        for (int row = 0; row < kRowBlock; ++row)
            out[p][row] = m_columns.row(p, row);
    m_functions.filter_columns(in, m_taps, 0, strips.columns(), strips.wide_start(), out);
    m_functions.filter_columns(in, m_taps, strips.columns(), strips.outer(),
                               2 * strips.wide_start() + strips.columns(), out);
}

// A row of the columns, into a row of features.
void FlipTile::filter_row(int row, Planes& features, int to_row) {
    const StripShape& strips = m_shape.strips;
    float* columns[kColumnPlanes];
    const float* const_columns[kColumnPlanes];
    for (int p = 0; p < kColumnPlanes; ++p)
        const_columns[p] = columns[p] = m_columns.row(p, row);
    float* work[kWorkPlanes];
    for (int p = 0; p < kWorkPlanes; ++p)
        work[p] = m_work[p];
    float* to[kFeaturePlanes];
    for (int p = 0; p < kFeaturePlanes; ++p)
        to[p] = features.row(p, to_row);
    m_functions.fill_halo(strips, m_taps, columns, m_steps[0]);
    m_functions.filter_colors(strips, m_taps, const_columns, work);
    m_functions.filter_features(strips, m_taps, const_columns, m_steps[0], to[kEdge], to[kPoint]);
    m_functions.to_features(strips.columns(), work, to);
}

void FlipTile::filter_reference(int y) {
    filter_columns(m_reference, y);
    for (int row = 0; row < kRowBlock; ++row)
        filter_row(row, m_reference_features, row);
}

// Row by row, each compared while it is in the cache.
void FlipTile::compare_block(Test& test, int y, float n) {
    filter_columns(test, y);
    float* work[kWorkPlanes];
    for (int p = 0; p < kWorkPlanes; ++p)
        work[p] = m_work[p];
    for (int row = 0; row < kRowBlock; ++row) {
        filter_row(row, m_test_features, 0);
        const float* reference_row[kFeaturePlanes];
        const float* test_row[kFeaturePlanes];
        for (int p = 0; p < kFeaturePlanes; ++p) {
            reference_row[p] = m_reference_features.row(p, row);
            test_row[p] = m_test_features.row(p, 0);
        }
        m_functions.compare_row(reference_row, test_row, m_shape.strips.columns(), n, work,
                                test.result.row(kError, y + row), test.result.row(kIndex, y + row),
                                m_keep_each ? test.result.row(kLastError, y + row) : nullptr);
    }
}

void FlipTile::expose(const ToneCurve& curve, float scale, float n, const ToneRows& rows) {
    const Exposure exposure{curve, scale, rows};
    m_reference.next_row = 0;
    for (Test& test : m_tests)
        test.next_row = 0;
    for (int y = 0; y < m_shape.rows(); y += kRowBlock) {
        bool reference_filtered = false;
        for (size_t t = 0; t < m_active; ++t) {
            Test& test = m_tests[t];
            if (!differs(test, y, exposure)) {
                if (m_keep_each)
                    std::fill_n(test.result.row(kLastError, y),
                                kRowBlock * m_shape.strips.columns(), 0.0f);
                continue;
            }
            if (!reference_filtered)
                filter_reference(y);
            reference_filtered = true;
            compare_block(test, y, n);
        }
    }
}

void FlipTile::store(size_t test, ResultPlane plane, float* to, ptrdiff_t stride) {
    const StripShape& strips = m_shape.strips;
    for (int y = 0; y < m_shape.height; ++y) {
        if (y + 1 < m_shape.height)
            prefetch(to + (y + 1) * stride, 0, m_shape.width);
        m_functions.transpose(m_tests[test].result.row(plane, y), strips.strip, strips.lanes,
                              m_row[0]);
        std::copy_n(m_row[0], m_shape.width, to + y * stride);
    }
}

} // namespace tonetool::kernels
