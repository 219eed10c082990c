// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/flip_rows.h"

#include <algorithm>
#include <cmath>

#include "kernels/flip_constants.h"
#include "kernels/whole_vectors.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/flip_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/flip_error-inl.h"
#include "kernels/hunt_lab-inl.h"
#include "kernels/symmetric_filter-inl.h"
#include "kernels/tone_curve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

ptrdiff_t LaneCount() {
    return ptrdiff_t(hn::Lanes(d));
}

#if HWY_TARGET == HWY_SCALAR
void Transpose(const float* HWY_RESTRICT in, ptrdiff_t rows, ptrdiff_t columns,
               float* HWY_RESTRICT out) {
    for (ptrdiff_t y = 0; y < rows; ++y)
        for (ptrdiff_t x = 0; x < columns; ++x)
            out[x * rows + y] = in[y * columns + x];
}
#else
// Transposes squares of 4 x 4: the numbers of lanes and of vectors in a strip are multiples of 4.
void Transpose(const float* HWY_RESTRICT in, ptrdiff_t rows, ptrdiff_t columns,
               float* HWY_RESTRICT out) {
    const hn::Full128<float> four;
    for (ptrdiff_t x = 0; x < columns; x += 4)
        for (ptrdiff_t y = 0; y < rows; y += 4) {
            const float* HWY_RESTRICT from = in + y * columns + x;
            float* HWY_RESTRICT to = out + x * rows + y;
            const auto a = hn::LoadU(four, from), b = hn::LoadU(four, from + columns);
            const auto c = hn::LoadU(four, from + 2 * columns);
            const auto e = hn::LoadU(four, from + 3 * columns);
            const auto ac = hn::InterleaveLower(four, a, c), be = hn::InterleaveLower(four, b, e);
            const auto ac_up = hn::InterleaveUpper(four, a, c);
            const auto be_up = hn::InterleaveUpper(four, b, e);
            hn::StoreU(hn::InterleaveLower(four, ac, be), four, to);
            hn::StoreU(hn::InterleaveUpper(four, ac, be), four, to + rows);
            hn::StoreU(hn::InterleaveLower(four, ac_up, be_up), four, to + 2 * rows);
            hn::StoreU(hn::InterleaveUpper(four, ac_up, be_up), four, to + 3 * rows);
        }
}
#endif

void ToneMap(const float* const rgb[3], float* const out[3], ptrdiff_t count,
             const ToneCurve& curve, float scale) {
    float* r = out[0];
    float* g = out[1];
    float* b = out[2];
    WithCurve(rgb, count, curve, scale, [r, g, b](ptrdiff_t i, const Color& c) HWY_ATTR {
        hn::StoreU(c.c0, d, r + i);
        hn::StoreU(c.c1, d, g + i);
        hn::StoreU(c.c2, d, b + i);
    });
}

void ToOpponent(const float* const rgb[3], ptrdiff_t count, const ToneCurve& curve, float scale,
                float* const out[3], const float* y_above, float* step_above) {
    const ToOpponentPlanes to_opponent;
    float* HWY_RESTRICT y = out[0];
    float* HWY_RESTRICT xy = out[1];
    float* HWY_RESTRICT yz = out[2];
    WithCurve(rgb, count, curve, scale, [=, &to_opponent](ptrdiff_t i, const Color& c) HWY_ATTR {
        const Color opponent = to_opponent(c);
        hn::Store(opponent.c0, d, y + i);
        hn::Store(opponent.c1, d, xy + i);
        hn::Store(opponent.c2, d, yz + i);
        hn::Store(hn::Sub(opponent.c0, hn::Load(d, y_above + i)), d, step_above + i);
    });
}

static_assert(Four::kCount == kRowBlock, "a block of rows is filtered at once");

HWY_INLINE void StoreRows(const Four& v, float* const (&rows)[kRowBlock], ptrdiff_t at) {
    hn::Store(v.v0, d, rows[0] + at);
    hn::Store(v.v1, d, rows[1] + at);
    hn::Store(v.v2, d, rows[2] + at);
    hn::Store(v.v3, d, rows[3] + at);
}

void FilterColumns(const RowTable (&in)[kOpponentPlanes], const TapVectors& taps, ptrdiff_t from,
                   ptrdiff_t count, ptrdiff_t to, float* const (&out)[kColumnPlanes][kRowBlock]) {
    const ptrdiff_t end = from + count, shift = to - from;
    for (ptrdiff_t x = from; x < end; x += LaneCount()) {
        const TwoFours v = EvenTwo(DownRows{in[kY], x}, taps[kTapsY], taps[kTapsG]);
        StoreRows(v.first, out[kColumnY], x + shift);
        StoreRows(v.second, out[kColumnG], x + shift);
    }
    for (ptrdiff_t x = from; x < end; x += LaneCount()) {
        const TwoFours v = EvenTwo(DownRows{in[kYz], x}, taps[kTapsCz1], taps[kTapsCz2]);
        StoreRows(v.first, out[kColumnCz1], x + shift);
        StoreRows(v.second, out[kColumnCz2], x + shift);
    }
    for (ptrdiff_t x = from; x < end; x += LaneCount()) {
        const TwoFours v = Detectors(DownRows{in[kStepY], x}, taps[kTapsD1], taps[kTapsD2]);
        StoreRows(v.first, out[kColumnD1], x + shift);
        StoreRows(v.second, out[kColumnD2], x + shift);
    }
    // Two vectors at a time; the last one, if odd, twice.
    for (ptrdiff_t x = from; x < end; x += 2 * LaneCount()) {
        const ptrdiff_t next = std::min(x + LaneCount(), end - LaneCount());
        const TwoFours v = EvenPair(DownRows{in[kXy], x}, DownRows{in[kXy], next}, taps[kTapsCx]);
        StoreRows(v.first, out[kColumnCx], x + shift);
        StoreRows(v.second, out[kColumnCx], next + shift);
    }
}

// Fills the halo of a wide row, `radius` vectors on each side: they are copies of the neighbouring
// strip's vectors, at the two ends of the row with the outer columns.
void FillHaloOfRow(const StripShape& shape, float* row, const TapList& taps) {
    const ptrdiff_t lanes = LaneCount(), reach = taps.count - 1;
    float* HWY_RESTRICT first = row + shape.wide_start();
    float* HWY_RESTRICT end = first + shape.columns();
    const float* HWY_RESTRICT left = end + shape.wide_start();
    const float* HWY_RESTRICT right = left + shape.halo;
    const auto lowest = hn::FirstN(d, 1), all_but_highest = hn::FirstN(d, size_t(lanes - 1));
    for (ptrdiff_t k = 1; k <= reach; ++k) {
        const V before = hn::LoadU(d, end - k * lanes - 1);
        hn::Store(hn::IfThenElse(lowest, hn::Set(d, left[k - 1]), before), d, first - k * lanes);
    }
    for (ptrdiff_t k = 0; k < reach; ++k) {
        const V after = hn::LoadU(d, first + k * lanes + 1);
        hn::Store(hn::IfThenElse(all_but_highest, after, hn::Set(d, right[k])), d, end + k * lanes);
    }
}

HWY_INLINE void StoreAlong(const Four& v, float* at) {
    hn::Store(v.v0, d, at);
    hn::Store(v.v1, d, at + LaneCount());
    hn::Store(v.v2, d, at + 2 * LaneCount());
    hn::Store(v.v3, d, at + 3 * LaneCount());
}
HWY_INLINE void StoreAlong(const Eight& v, float* at) {
    StoreAlong(v.low, at);
    StoreAlong(v.high, at + Four::kCount * LaneCount());
}

static_assert(kStripStep % RowOutputs::kCount == 0, "no output beyond a strip");

// An even filter along a row of columns.
void FilterRow(const StripShape& shape, const float* row, const TapList& taps, float* out) {
    const float* first = row + shape.wide_start();
    for (ptrdiff_t x = 0; x < shape.columns(); x += RowOutputs::kCount * LaneCount())
        StoreAlong(Even<RowOutputs>(AlongRow{first + x}, taps), out + x);
}

// The steps of a wide row to the next column.
void StepsOfRow(const StripShape& shape, const float* row, float* steps, const TapList& taps) {
    const ptrdiff_t reach = (taps.count - 1) * LaneCount();
    const ptrdiff_t end = shape.wide_start() + shape.columns() + reach - LaneCount();
    for (ptrdiff_t x = shape.wide_start() - reach; x < end; x += LaneCount())
        hn::Store(hn::Sub(hn::Load(d, row + x + LaneCount()), hn::Load(d, row + x)), d, steps + x);
}

void FillHalo(const StripShape& shape, const TapVectors& taps,
              float* const (&columns)[kColumnPlanes], float* steps) {
    FillHaloOfRow(shape, columns[kColumnY], taps[kTapsY]);
    FillHaloOfRow(shape, columns[kColumnCx], taps[kTapsCx]);
    FillHaloOfRow(shape, columns[kColumnCz1], taps[kTapsCz1]);
    FillHaloOfRow(shape, columns[kColumnCz2], taps[kTapsCz2]);
    for (ColumnPlane p : {kColumnG, kColumnD1, kColumnD2})
        FillHaloOfRow(shape, columns[p], taps[kTapsG]);
    StepsOfRow(shape, columns[kColumnG], steps, taps[kTapsG]);
}

void FilterColors(const StripShape& shape, const TapVectors& taps,
                  const float* const (&columns)[kColumnPlanes], float* const (&out)[kWorkPlanes]) {
    FilterRow(shape, columns[kColumnY], taps[kTapsY], out[kFilteredY]);
    FilterRow(shape, columns[kColumnCx], taps[kTapsCx], out[kFilteredCx]);
    const float* first = columns[kColumnCz1] + shape.wide_start();
    const float* second = columns[kColumnCz2] + shape.wide_start();
    for (ptrdiff_t x = 0; x < shape.columns(); x += RowOutputs::kCount * LaneCount()) {
        const RowOutputs wide = Even<RowOutputs>(AlongRow{first + x}, taps[kTapsCz1]);
        const RowOutputs narrow = Even<RowOutputs>(AlongRow{second + x}, taps[kTapsCz2]);
        StoreAlong(Add(wide, narrow), out[kFilteredCz] + x);
    }
}

HWY_INLINE Four SquaredLengths(const Four& a, const Four& b) {
    return {SquaredLength(a.v0, b.v0), SquaredLength(a.v1, b.v1), SquaredLength(a.v2, b.v2),
            SquaredLength(a.v3, b.v3)};
}

void FilterFeatures(const StripShape& shape, const TapVectors& taps,
                    const float* const (&columns)[kColumnPlanes], const float* steps, float* edge,
                    float* point) {
    FilterRow(shape, columns[kColumnD1], taps[kTapsG], edge);
    FilterRow(shape, columns[kColumnD2], taps[kTapsG], point);
    const float* first = steps + shape.wide_start();
    for (ptrdiff_t x = 0; x < shape.columns(); x += Four::kCount * LaneCount()) {
        const TwoFours v = Detectors(AlongRow{first + x}, taps[kTapsD1], taps[kTapsD2]);
        StoreAlong(SquaredLengths(v.first, Four::At(AlongRow{edge + x}, 0)), edge + x);
        StoreAlong(SquaredLengths(v.second, Four::At(AlongRow{point + x}, 0)), point + x);
    }
}

// The loops of ToFeatures are short: what one pixel waits for, a core fills with its neighbours.
// The roots of the features stand where no other division or root is.

// Filtered colours into the gamut.
void ClampColors(ptrdiff_t count, float* const (&work)[kWorkPlanes]) {
    const ToOpponentPlanes to_opponent;
    const FromOpponentPlanes to_rgb;
    float* HWY_RESTRICT y = work[kFilteredY];
    float* HWY_RESTRICT xy = work[kFilteredCx];
    float* HWY_RESTRICT yz = work[kFilteredCz];
    for (ptrdiff_t i = 0; i < count; i += LaneCount()) {
        const Color c = {hn::Load(d, y + i), hn::Load(d, xy + i), hn::Load(d, yz + i)};
        const Color beyond = BeyondGamut(to_rgb, c);
        if (AllZero(beyond))
            continue;
        const Color moved = to_opponent(beyond);
        hn::Store(hn::Add(c.c0, moved.c0), d, y + i);
        hn::Store(hn::Add(c.c1, moved.c1), d, xy + i);
        hn::Store(hn::Add(c.c2, moved.c2), d, yz + i);
    }
}

struct Plus {
    HWY_INLINE V operator()(V a, V b) const { return hn::Add(a, b); }
};
struct Minus {
    HWY_INLINE V operator()(V a, V b) const { return hn::Sub(a, b); }
};

// f(x) or f(z) of a row, from y and a step; and the roots of another row.
template <class Sign>
void LabFAndRoot(ptrdiff_t count, const float* HWY_RESTRICT y, const float* HWY_RESTRICT step,
                 const Sign& sign, float* HWY_RESTRICT f, float* HWY_RESTRICT squares) {
    for (ptrdiff_t i = 0; i < count; i += LaneCount()) {
        const V t = sign(hn::Load(d, y + i), hn::Load(d, step + i));
        hn::Store(LabF(t), d, f + i);
        hn::Store(hn::Sqrt(hn::Load(d, squares + i)), d, squares + i);
    }
}

void SplitLabF(ptrdiff_t count, const float* HWY_RESTRICT t, float* HWY_RESTRICT high,
               float* HWY_RESTRICT low) {
    for (ptrdiff_t i = 0; i < count; i += LaneCount()) {
        const Split<V> parts = SplitLabF(hn::Load(d, t + i));
        hn::Store(parts.high, d, high + i);
        hn::Store(parts.low, d, low + i);
    }
}

// Hunt's a and b from f(x), f(z) and the two parts of f(y). Those are compared in place of L, which
// is 116 (f(y) - 4/29): no factor is left that a comparison of the differences could not take over.
void LightAndHues(ptrdiff_t count, const float* const (&work)[kWorkPlanes],
                  float* const (&out)[kFeaturePlanes]) {
    const float* HWY_RESTRICT y = work[kFilteredY];
    const float* HWY_RESTRICT xy = work[kFilteredCx];
    const float* HWY_RESTRICT yz = work[kFilteredCz];
    const float* HWY_RESTRICT fx = work[kWorkFx];
    const float* HWY_RESTRICT fz = work[kWorkFz];
    const float* HWY_RESTRICT high = out[kLHigh];
    const float* HWY_RESTRICT low = out[kLLow];
    float* HWY_RESTRICT a = out[kA];
    float* HWY_RESTRICT b = out[kB];
    const V offset = hn::Set(d, float(kLabOffset)), knee = hn::Set(d, float(kLabKnee));
    for (ptrdiff_t i = 0; i < count; i += LaneCount()) {
        const V here = hn::Load(d, y + i);
        const V fy_high = hn::Load(d, high + i), fy_low = hn::Load(d, low + i);
        const V light = hn::Add(hn::Sub(fy_high, offset), fy_low), fy = hn::Add(fy_high, fy_low);
        const V x_less_y = hn::Load(d, xy + i), y_less_z = hn::Load(d, yz + i);
        const V f_x = hn::Load(d, fx + i), f_z = hn::Load(d, fz + i);
        const V x = hn::Add(here, x_less_y), z = hn::Sub(here, y_less_z);
        V x_step = RootStep(x_less_y, f_x, fy), z_step = RootStep(y_less_z, fy, f_z);
        if (!hn::AllTrue(d, hn::Gt(hn::Min(here, hn::Min(x, z)), knee))) {
            x_step = LabStep(x, here, x_less_y, f_x, fy);
            z_step = LabStep(here, z, y_less_z, fy, f_z);
        }
        hn::Store(hn::Mul(light, x_step), d, a + i);
        hn::Store(hn::Mul(light, z_step), d, b + i);
    }
}

void ToFeatures(ptrdiff_t count, float* const (&work)[kWorkPlanes],
                float* const (&out)[kFeaturePlanes]) {
    ClampColors(count, work);
    const float* y = work[kFilteredY];
    LabFAndRoot(count, y, work[kFilteredCx], Plus(), work[kWorkFx], out[kEdge]);
    LabFAndRoot(count, y, work[kFilteredCz], Minus(), work[kWorkFz], out[kPoint]);
    SplitLabF(count, y, out[kLHigh], out[kLLow]);
    LightAndHues(count, work, out);
}

void CompareRow(const float* const (&r)[kFeaturePlanes], const float* const (&t)[kFeaturePlanes],
                ptrdiff_t count, float n, float* const (&work)[kWorkPlanes], float* best,
                float* index, float* error) {
    float* HWY_RESTRICT color = work[0];
    float* HWY_RESTRICT feature = work[1];
    for (ptrdiff_t x = 0; x < count; x += LaneCount()) {
        hn::Store(ColorDistance(r, t, x), d, color + x);
        hn::Store(FeatureDistance(r, t, x), d, feature + x);
    }
    for (ptrdiff_t x = 0; x < count; x += LaneCount()) {
        const V power = PowerOf(hn::Load(d, feature + x));
        hn::Store(hn::Mul(power, Log2ColorError(hn::Load(d, color + x))), d, feature + x);
    }
    for (ptrdiff_t x = 0; x < count; x += LaneCount()) {
        const V same = hn::Load(d, color + x);
        const V e =
            hn::IfThenZeroElse(hn::Eq(same, hn::Zero(d)), Exp2(d, hn::Load(d, feature + x)));
        const V old = hn::Load(d, best + x);
        const auto larger = hn::Gt(e, old);
        hn::Store(hn::IfThenElse(larger, e, old), d, best + x);
        hn::Store(hn::IfThenElse(larger, hn::Set(d, n), hn::Load(d, index + x)), d, index + x);
        if (error)
            hn::Store(e, d, error + x);
    }
}

const FlipRows& Rows() {
    static const FlipRows rows = {int(LaneCount()), hwy::TargetName(HWY_TARGET),
                                  Transpose,        ToneMap,
                                  ToOpponent,       FilterColumns,
                                  FillHalo,         FilterColors,
                                  FilterFeatures,   ToFeatures,
                                  CompareRow};
    return rows;
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(Rows);

TapVectors::TapVectors(const LaneTaps& taps, int lanes) {
    const std::vector<float>* lists[kTapPlanes] = {&taps.y, &taps.cx, &taps.cz1, &taps.cz2,
                                                   &taps.g, &taps.d1, &taps.d2};
    size_t all = 0;
    for (const auto* list : lists)
        all += list->size() * size_t(lanes);
    m_data = hwy::AllocateAligned<float>(all);
    float* at = m_data.get();
    for (size_t p = 0; p < kTapPlanes; ++p) {
        m_lists[p] = {at, ptrdiff_t(lists[p]->size())};
        for (float tap : *lists[p])
            at = std::fill_n(at, lanes, tap);
    }
}

const FlipRows& flip_rows() {
    return HWY_DYNAMIC_DISPATCH(Rows)();
}

void tone_map_pixels(const float* const in[3], float* const out[3], ptrdiff_t count,
                     const ToneCurve& curve, float scale) {
    const FlipRows& rows = flip_rows();
    in_whole_vectors(in, out, count, rows.lanes,
                     [&](const float* const from[3], float* const to[3], ptrdiff_t n) {
                         rows.tone_map(from, to, n, curve, scale);
                     });
}

} // namespace tonetool::kernels
#endif
