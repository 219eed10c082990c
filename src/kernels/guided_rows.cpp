// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/guided_rows.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/guided_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "kernels/color-inl.h"
#include "kernels/guided_weight-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Bytes = hn::Rebind<uint8_t, D>;
using Mask = hn::Mask<D>;

// Pixels from a place on, a vector of them.
struct WholeVector {
    ptrdiff_t at;
    HWY_INLINE V operator()(const float* plane) const { return hn::LoadU(d, plane + at); }
    HWY_INLINE Mask IsSet(const uint8_t* plane) const {
        const hn::RebindToSigned<D> di;
        return hn::RebindMask(
            d, hn::Ne(hn::PromoteTo(di, hn::LoadU(Bytes(), plane + at)), hn::Zero(di)));
    }
};

// As many as are left; the others are 0.
struct Rest {
    ptrdiff_t at, count;
    HWY_INLINE V operator()(const float* plane) const {
        alignas(64) float buffer[hn::MaxLanes(d)] = {};
        std::copy_n(plane + at, count, buffer);
        return hn::Load(d, buffer);
    }
    HWY_INLINE Mask IsSet(const uint8_t* plane) const {
        alignas(64) uint8_t buffer[hn::MaxLanes(d)] = {};
        std::copy_n(plane + at, count, buffer);
        return WholeVector{0}.IsSet(buffer);
    }
};

template <class Load>
struct Prepare {
    const GuidePlanes& image;
    const GuidedLayout& layout;
    const GuidedScales& scales;
    Load load;
    float* to;

    HWY_INLINE void Store(int plane, V v) const { hn::StoreU(v, d, to + plane * layout.pitch); }

    static HWY_INLINE V FiniteOrZero(V v) { return hn::IfThenElseZero(hn::IsFinite(v), v); }

    HWY_INLINE Color Load3(const float* const (&planes)[3]) const {
        return {load(planes[0]), load(planes[1]), load(planes[2])};
    }

    HWY_INLINE Mask Near(V v) const {
        return hn::Le(hn::Abs(v), hn::Set(d, kFarthestPosition)); // false for NaN
    }

    // The value, 0 where there is none.
    HWY_INLINE Mask StoreValue() const {
        const V v = load(image.value);
        Mask valid = hn::And(hn::Ge(v, hn::Set(d, scales.least)), hn::IsFinite(v));
        if (image.range)
            valid = hn::And(valid, hn::IsFinite(load(image.range)));
        Store(0, hn::IfThenElseZero(valid, hn::Min(v, hn::Set(d, kLargestGuidedValue))));
        return valid;
    }

    HWY_INLINE void StorePosition(Mask valid) const {
        Mask surface = hn::Eq(hn::Zero(d), hn::Zero(d));
        if (image.background)
            surface = hn::Not(load.IsSet(image.background));
        Color p{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        if (layout.position) {
            p = Load3(image.position);
            surface = hn::And(surface, hn::And(Near(p.c0), hn::And(Near(p.c1), Near(p.c2))));
            Store(2, hn::IfThenElseZero(hn::And(valid, surface), p.c1));
            Store(3, hn::IfThenElseZero(hn::And(valid, surface), p.c2));
        }
        const V kind = hn::IfThenElse(surface, p.c0, hn::Set(d, kFarAway));
        Store(1, hn::IfThenElse(valid, kind, hn::Set(d, -kFarAway)));
    }

    HWY_INLINE Color Normal(Mask surface, float scale) const {
        Color n = Load3(image.normal);
        V sum = hn::Mul(n.c0, n.c0);
        sum = hn::MulAdd(n.c1, n.c1, sum);
        sum = hn::MulAdd(n.c2, n.c2, sum);
        // Also false for NaN, and where squares are beyond floats.
        const Mask some = hn::And(
            surface, hn::And(hn::Gt(sum, hn::Set(d, 1e-30f)), hn::Lt(sum, hn::Set(d, 1e30f))));
        const V length = hn::Div(hn::Set(d, scale), hn::Sqrt(sum));
        return {hn::IfThenElseZero(some, hn::Mul(n.c0, length)),
                hn::IfThenElseZero(some, hn::Mul(n.c1, length)),
                hn::IfThenElseZero(some, hn::Mul(n.c2, length))};
    }

    HWY_INLINE Color Albedo(Mask surface, float scale) const {
        const V factor = hn::Set(d, scale);
        const Color a = Load3(image.albedo);
        return {hn::Mul(hn::IfThenElseZero(surface, FiniteOrZero(a.c0)), factor),
                hn::Mul(hn::IfThenElseZero(surface, FiniteOrZero(a.c1)), factor),
                hn::Mul(hn::IfThenElseZero(surface, FiniteOrZero(a.c2)), factor)};
    }

    HWY_INLINE void Store3(int plane, const Color& c) const {
        Store(plane, c.c0);
        Store(plane + 1, c.c1);
        Store(plane + 2, c.c2);
    }

    HWY_INLINE void StorePair(int plane, V low, V high) const {
        Store(plane, hn::BitCast(d, PairUp(low, high)));
    }

    static HWY_INLINE Color Within(const Color& c, float most) {
        const V high = hn::Set(d, most), low = hn::Set(d, -most);
        return {hn::Min(hn::Max(c.c0, low), high), hn::Min(hn::Max(c.c1, low), high),
                hn::Min(hn::Max(c.c2, low), high)};
    }

    HWY_INLINE void StorePairs(Mask surface) const {
        const Color zero{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
        const Color a =
            image.albedo[0] ? Within(Albedo(surface, scales.albedo), scales.albedo) : zero;
        const Color n = image.normal[0] ? Normal(surface, scales.normal) : a;
        const int first = layout.first_pair();
        StorePair(first, n.c0, n.c1);
        if (layout.pairs == 2)
            return StorePair(first + 1, n.c2, zero.c2);
        StorePair(first + 1, n.c2, a.c0);
        StorePair(first + 2, a.c1, a.c2);
    }

    HWY_INLINE void StorePlain(Mask surface) const {
        int plane = layout.first_plain();
        if (layout.angle) {
            Store3(layout.first_angle(), Normal(surface, 1));
        } else if (image.normal[0]) {
            Store3(plane, Normal(surface, scales.normal));
            plane += 3;
        }
        if (image.albedo[0])
            Store3(plane, Albedo(surface, scales.albedo));
    }

    // Where the position was stored before: where there is a surface, but for pixels that count for
    // nothing anyway.
    HWY_INLINE Mask StoredSurface() const {
        const V kind = hn::LoadU(d, to + layout.pitch);
        return hn::Lt(hn::Abs(kind), hn::Set(d, kFarAway / 2));
    }

    HWY_INLINE void Values() const { StorePosition(StoreValue()); }

    HWY_INLINE void Surfaces() const {
        if (layout.pairs > 0)
            StorePairs(StoredSurface());
        else
            StorePlain(StoredSurface());
    }

    HWY_INLINE void RangeAndNearness() const {
        if (image.range && !layout.range_of_value)
            Store(layout.range(),
                  hn::Mul(FiniteOrZero(load(image.range)), hn::Set(d, scales.range)));
        const V given = image.footprint ? load(image.footprint) : hn::Set(d, scales.footprint);
        const V least = hn::Set(d, kLeastFootprint), most = hn::Set(d, kMostFootprint);
        const V f = hn::IfThenElse(hn::Gt(given, least), hn::Min(given, most), least);
        Store(layout.nearness(), hn::Div(hn::Set(d, scales.nearness), hn::Mul(f, f)));
    }
};

// The planes of an image often lie at equal distances from whole pages, so that a cache holds lines
// of few of them at once: a few planes at a time.
template <class Load>
HWY_INLINE void PrepareSome(const Prepare<Load>& first, int step) {
    step == 0 ? first.Values() : step == 1 ? first.Surfaces() : first.RangeAndNearness();
}

void PrepareRow(const GuidePlanes& image, const GuidedLayout& layout, const GuidedScales& scales,
                ptrdiff_t from, ptrdiff_t count, float* to) {
    const auto lanes = ptrdiff_t(hn::Lanes(d));
    for (int step = 0; step < 3; ++step) {
        ptrdiff_t i = 0;
        for (; i + lanes <= count; i += lanes)
            PrepareSome(Prepare<WholeVector>{image, layout, scales, {from + i}, to + i}, step);
        if (i < count)
            PrepareSome(Prepare<Rest>{image, layout, scales, {from + i, count - i}, to + i}, step);
    }
}

// Asks for the lines of memory of a part of a row.
void Fetch(const GuidePlanes& image, ptrdiff_t from, ptrdiff_t count) {
    constexpr ptrdiff_t kLine = 16; // floats
    const float* const planes[] = {image.value,       image.position[0], image.position[1],
                                   image.position[2], image.normal[0],   image.normal[1],
                                   image.normal[2],   image.albedo[0],   image.albedo[1],
                                   image.albedo[2],   image.range,       image.footprint};
    for (const float* plane : planes)
        if (plane)
            for (ptrdiff_t i = 0; i < count + kLine; i += kLine)
                hwy::Prefetch(plane + from + std::min(i, count - 1));
}

void PrepareOutside(const GuidedLayout& layout, ptrdiff_t count, float* to) {
    for (int p = 0; p < layout.planes(); ++p)
        std::fill_n(to + p * layout.pitch, count, p == 1 ? -kFarAway : 0.0f);
}

// Offsets that are looked at for all vectors of a run, while the lines of memory that these share
// are close.
constexpr ptrdiff_t kBatch = 8;

struct Batch {
    const float* at[kBatch];
    float start[kBatch];

    // Where there are no more of them, the last one again, weighing nothing.
    HWY_INLINE Batch(const GuidedRun& run, ptrdiff_t first, float offset) {
        const ptrdiff_t count = std::min(kBatch, run.count - first);
        for (ptrdiff_t i = 0; i < kBatch; ++i) {
            const Tap& tap = run.taps[first + std::min(i, count - 1)];
            at[i] = run.rows[tap.dy] + run.column + tap.dx;
            start[i] = i < count ? tap.log2_weight - offset : -kFarAway;
        }
    }
};

struct WeightedRun {
    alignas(64) float values[kGuidedRun] = {}, weights[kGuidedRun] = {};

    HWY_INLINE void Add(ptrdiff_t x, V value, V weight) {
        hn::Store(hn::Add(hn::Load(d, values + x), value), d, values + x);
        hn::Store(hn::Add(hn::Load(d, weights + x), weight), d, weights + x);
    }
};

template <class Terms>
HWY_INLINE void AddBatch(const Terms& terms, const Batch& batch, ptrdiff_t x, ptrdiff_t pitch,
                         WeightedRun& sums) {
    V value = hn::Zero(d), weight = hn::Zero(d);
    for (ptrdiff_t i = 0; i < kBatch; i += kTogether) {
        Together w;
        terms.Weigh(batch.at + i, x, pitch, batch.start + i, w);
        for (int k = 0; k < kTogether; ++k) {
            weight = hn::Add(weight, w[k]);
            value = hn::MulAdd(w[k], hn::LoadU(d, batch.at[i + k] + x), value);
        }
    }
    sums.Add(x, value, weight);
}

// Sums are added up in three stages: long series of additions in float would lose digits.
constexpr ptrdiff_t kBlock = 16 * kBatch;

template <class Terms>
void FilterRun(const GuidedLayout& layout, const GuidedScales& scales, const GuidedRun& run,
               float* HWY_RESTRICT out) {
    const auto lanes = ptrdiff_t(hn::Lanes(d));
    const float* const row = run.rows[0] + run.column;
    WeightedRun all;
    for (ptrdiff_t block = 0; block < run.count; block += kBlock) {
        WeightedRun sums;
        for (ptrdiff_t i = block; i < std::min(block + kBlock, run.count); i += kBatch) {
            const Batch batch(run, i, Terms::kAngle ? scales.angle : 0.0f);
            for (ptrdiff_t x = 0; x < kGuidedRun; x += lanes)
                AddBatch(Terms(layout, scales, row + x), batch, x, run.pitch, sums);
        }
        for (ptrdiff_t x = 0; x < kGuidedRun; x += lanes)
            all.Add(x, hn::Load(d, sums.values + x), hn::Load(d, sums.weights + x));
    }
    for (ptrdiff_t x = 0; x < kGuidedRun; x += lanes) {
        const V weight = hn::Load(d, all.weights + x);
        const V mean = hn::Div(hn::Load(d, all.values + x), weight);
        hn::StoreU(hn::IfThenElse(hn::Gt(weight, hn::Zero(d)), mean, hn::LoadU(d, row + x)), d,
                   out + x);
    }
}

// Sums of what the neighbours differ by from the pixel itself: a variance that is far less than the
// square of the mean keeps its digits.
struct MomentsOfRun {
    alignas(64) float first[kGuidedRun] = {}, second[kGuidedRun] = {}, weights[kGuidedRun] = {};

    HWY_INLINE void Add(ptrdiff_t x, V one, V two, V weight) {
        hn::Store(hn::Add(hn::Load(d, first + x), one), d, first + x);
        hn::Store(hn::Add(hn::Load(d, second + x), two), d, second + x);
        hn::Store(hn::Add(hn::Load(d, weights + x), weight), d, weights + x);
    }
};

template <class Terms>
HWY_INLINE void AddMoments(const Terms& terms, const Batch& batch, ptrdiff_t x, ptrdiff_t pitch,
                           MomentsOfRun& sums) {
    V first = hn::Zero(d), second = hn::Zero(d), weight = hn::Zero(d);
    for (ptrdiff_t i = 0; i < kBatch; i += kTogether) {
        Together w;
        terms.Weigh(batch.at + i, x, pitch, batch.start + i, w);
        for (int k = 0; k < kTogether; ++k) {
            const V away = hn::Sub(hn::LoadU(d, batch.at[i + k] + x), terms.value);
            const V share = hn::Mul(w[k], away);
            weight = hn::Add(weight, w[k]);
            first = hn::Add(first, share);
            second = hn::MulAdd(share, away, second);
        }
    }
    sums.Add(x, first, second, weight);
}

template <class Terms>
void MomentsRun(const GuidedLayout& layout, const GuidedScales& scales, const GuidedRun& run,
                float* HWY_RESTRICT mean, float* HWY_RESTRICT variance) {
    const auto lanes = ptrdiff_t(hn::Lanes(d));
    const float* const row = run.rows[0] + run.column;
    MomentsOfRun all;
    for (ptrdiff_t block = 0; block < run.count; block += kBlock) {
        MomentsOfRun sums;
        for (ptrdiff_t i = block; i < std::min(block + kBlock, run.count); i += kBatch) {
            const Batch batch(run, i, Terms::kAngle ? scales.angle : 0.0f);
            for (ptrdiff_t x = 0; x < kGuidedRun; x += lanes)
                AddMoments(Terms(layout, scales, row + x), batch, x, run.pitch, sums);
        }
        for (ptrdiff_t x = 0; x < kGuidedRun; x += lanes)
            all.Add(x, hn::Load(d, sums.first + x), hn::Load(d, sums.second + x),
                    hn::Load(d, sums.weights + x));
    }
    for (ptrdiff_t x = 0; x < kGuidedRun; x += lanes) {
        const V weight = hn::Load(d, all.weights + x);
        const auto some = hn::Gt(weight, hn::Zero(d));
        const V away = hn::IfThenElseZero(some, hn::Div(hn::Load(d, all.first + x), weight));
        const V square = hn::IfThenElseZero(some, hn::Div(hn::Load(d, all.second + x), weight));
        const V v = hn::NegMulAdd(away, away, square);
        hn::StoreU(hn::Add(hn::LoadU(d, row + x), away), d, mean + x);
        hn::StoreU(hn::IfThenElseZero(hn::Ge(v, hn::Set(d, kLeastVariance)), v), d, variance + x);
    }
}

// What is made of a run, by the terms that its layout has.
struct MeansTask {
    static constexpr bool kRange = true;
    const GuidedLayout& layout;
    const GuidedScales& scales;
    const GuidedRun& run;
    float* out;

    template <class Terms>
    void Do() const {
        FilterRun<Terms>(layout, scales, run, out);
    }
};

struct MomentsTask {
    static constexpr bool kRange = false;
    const GuidedLayout& layout;
    const GuidedScales& scales;
    const GuidedRun& run;
    float *mean, *variance;

    template <class Terms>
    void Do() const {
        MomentsRun<Terms>(layout, scales, run, mean, variance);
    }
};

template <bool kPosition, bool kAngle, bool kRangeOfValue, class Task>
void WithPlain(const Task& task) {
    if constexpr (Task::kRange)
        switch (task.layout.plain) {
        case 1:
            return task.template Do<Terms<kPosition, 1, 0, kAngle, kRangeOfValue>>();
        case 4:
            return task.template Do<Terms<kPosition, 4, 0, kAngle, kRangeOfValue>>();
        case 7:
            return task.template Do<Terms<kPosition, 7, 0, kAngle, kRangeOfValue>>();
        default:
            break;
        }
    switch (task.layout.plain) {
    case 0:
        return task.template Do<Terms<kPosition, 0, 0, kAngle, kRangeOfValue>>();
    case 3:
        return task.template Do<Terms<kPosition, 3, 0, kAngle, kRangeOfValue>>();
    default:
        return task.template Do<Terms<kPosition, 6, 0, kAngle, kRangeOfValue>>();
    }
}

// With packed pairs the range is the only other plane.
template <bool kPosition, int kPairs, class Task>
void WithPairs(const Task& task) {
    if constexpr (Task::kRange) {
        if (task.layout.range_of_value)
            return task.template Do<Terms<kPosition, 0, kPairs, false, true>>();
        if (task.layout.plain > 0)
            return task.template Do<Terms<kPosition, 1, kPairs, false, false>>();
    }
    task.template Do<Terms<kPosition, 0, kPairs, false, false>>();
}

template <bool kPosition, class Task>
void WithPosition(const Task& task) {
    if (task.layout.pairs == 3)
        return WithPairs<kPosition, 3>(task);
    if (task.layout.pairs == 2)
        return WithPairs<kPosition, 2>(task);
    if constexpr (Task::kRange) {
        if (task.layout.angle && task.layout.range_of_value)
            return WithPlain<kPosition, true, true>(task);
        if (task.layout.range_of_value)
            return WithPlain<kPosition, false, true>(task);
    }
    if (task.layout.angle)
        return WithPlain<kPosition, true, false>(task);
    WithPlain<kPosition, false, false>(task);
}

template <class Task>
void ByPosition(const Task& task) {
    if (task.layout.position)
        WithPosition<true>(task);
    else
        WithPosition<false>(task);
}

void Filter(const GuidedLayout& layout, const GuidedScales& scales, const GuidedRun& run,
            float* out) {
    ByPosition(MeansTask{layout, scales, run, out});
}

void Moments(const GuidedLayout& layout, const GuidedScales& scales, const GuidedRun& run,
             float* mean, float* variance) {
    ByPosition(MomentsTask{layout, scales, run, mean, variance});
}

const GuidedRows& GuidedTable() {
    static const GuidedRows table = {
        hwy::TargetName(HWY_TARGET), Fetch, PrepareRow, PrepareOutside, Filter, Moments};
    return table;
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {
namespace {

// From 0 to 1: sums of six squared differences are whole numbers of 32 bits.
constexpr double kSteps = 8191;

// log2 of exp(-x^2 / 2 sigma^2) is minus this times x^2.
double exponent(double sigma) {
    return 1 / (2 * sigma * sigma * std::log(2.0));
}

} // namespace

GuidedLayout::GuidedLayout(const GuidePlanes& image, const GuidedTerms& terms)
    : position(image.position[0] != nullptr),
      angle(image.normal[0] != nullptr && terms.normal_term == NormalTerm::Angle),
      range_of_value(image.range != nullptr && image.range == image.value) {
    const int both = (image.normal[0] && !angle ? 3 : 0) + (image.albedo[0] ? 3 : 0);
    if (terms.in_steps && !angle)
        pairs = (both + 1) / 2;
    plain = (pairs > 0 ? 0 : both) + (image.range && !range_of_value ? 1 : 0);
}

GuidedScales::GuidedScales(const GuidePlanes& image, const GuidedTerms& terms)
    : nearness(image.position[0] ? float(exponent(terms.position)) : 1.0f),
      footprint(float(terms.footprint)),
      normal(float(std::sqrt(exponent(terms.normal)))),
      albedo(float(std::sqrt(exponent(terms.albedo)))),
      range(float(std::sqrt(exponent(terms.range)))),
      angle(float(exponent(terms.normal))),
      range_of_value(float(exponent(terms.range))),
      least(terms.least),
      square_of_steps(0) {
    if (GuidedLayout(image, terms).pairs == 0)
        return;
    const double sigma = std::min(terms.normal, terms.albedo);
    normal = float(kSteps * sigma / terms.normal);
    albedo = float(kSteps * sigma / terms.albedo);
    square_of_steps = float(exponent(sigma) / (kSteps * kSteps));
}

HWY_EXPORT(GuidedTable);

const GuidedRows& guided_rows() {
    return HWY_DYNAMIC_DISPATCH(GuidedTable)();
}

} // namespace tonetool::kernels
#endif
