// SPDX-License-Identifier: BSD-3-Clause
// Symmetric convolution in SIMD lanes, several outputs at a time. Included once per target.
#if defined(TONETOOL_KERNELS_SYMMETRIC_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_SYMMETRIC_FILTER_INL_H_
#undef TONETOOL_KERNELS_SYMMETRIC_FILTER_INL_H_
#else
#define TONETOOL_KERNELS_SYMMETRIC_FILTER_INL_H_
#endif

#include <hwy/highway.h>
#include <type_traits>

#include "kernels/color-inl.h"
#include "kernels/flip_rows.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// With 16 registers few are left beside eight sums.
constexpr bool kManyRegisters = HWY_MAX_BYTES == 64 || HWY_ARCH_ARM_A64;

// Where a vector is a register: not where arrays or single floats stand in for them.
#if HWY_ARCH_X86 && HWY_COMPILER_GCC_ACTUAL && (HWY_TARGET & (HWY_SCALAR | HWY_EMU128)) == 0
// Left alone, GCC loads a vector once more for each of its uses,
HWY_INLINE V InRegister(V v) {
    asm("" : "+v"(v.raw));
    return v;
}
// and keeps what it has loaded for later steps, for which few registers are too few.
HWY_INLINE void ForgetLoads() {
    if constexpr (!kManyRegisters)
        asm volatile("" : : : "memory");
}
#else
HWY_INLINE V InRegister(V v) {
    return v;
}
HWY_INLINE void ForgetLoads() {}
#endif

// A row in strips: At(i) is i columns from the first output.
struct AlongRow {
    const float* HWY_RESTRICT at;
    HWY_INLINE V At(ptrdiff_t i) const { return hn::Load(d, at + i * ptrdiff_t(hn::Lanes(d))); }
};

// Rows by their addresses: At(i) is i rows from the first output, at one place of each.
struct DownRows {
    const float* const* HWY_RESTRICT rows;
    ptrdiff_t place;
    HWY_INLINE V At(ptrdiff_t i) const { return hn::Load(d, rows[i] + place); }
};

// One vector for each of the outputs that are filtered at a time. Not arrays, which compilers like
// to keep in memory.
struct Four {
    static constexpr int kCount = 4;
    V v0, v1, v2, v3;

    template <class Source>
    static HWY_INLINE Four At(const Source& in, ptrdiff_t i) {
        return {in.At(i), in.At(i + 1), in.At(i + 2), in.At(i + 3)};
    }
    template <int j>
    HWY_INLINE V At() const {
        if constexpr (j == 0)
            return v0;
        else if constexpr (j == 1)
            return v1;
        else if constexpr (j == 2)
            return v2;
        else
            return v3;
    }
    HWY_INLINE void PushFront(V v) { *this = {v, v0, v1, v2}; }
    HWY_INLINE void PushBack(V v) { *this = {v1, v2, v3, v}; }
};

struct Eight {
    static constexpr int kCount = 8;
    Four low, high;

    template <class Source>
    static HWY_INLINE Eight At(const Source& in, ptrdiff_t i) {
        return {Four::At(in, i), Four::At(in, i + Four::kCount)};
    }
    HWY_INLINE void PushFront(V v) {
        high.PushFront(low.v3);
        low.PushFront(v);
    }
    HWY_INLINE void PushBack(V v) {
        low.PushBack(high.v0);
        high.PushBack(v);
    }
};

// A sum waits for its last product, so that eight sums keep the multipliers busy: four outputs of
// two filters, or eight of one. With few registers four must do: a core finds the next four in
// time.
using RowOutputs = std::conditional_t<kManyRegisters, Eight, Four>;

HWY_INLINE Four Add(const Four& a, const Four& b) {
    return {hn::Add(a.v0, b.v0), hn::Add(a.v1, b.v1), hn::Add(a.v2, b.v2), hn::Add(a.v3, b.v3)};
}
HWY_INLINE Eight Add(const Eight& a, const Eight& b) {
    return {Add(a.low, b.low), Add(a.high, b.high)};
}
HWY_INLINE Four Mul(V tap, const Four& a) {
    return {hn::Mul(tap, a.v0), hn::Mul(tap, a.v1), hn::Mul(tap, a.v2), hn::Mul(tap, a.v3)};
}
HWY_INLINE Eight Mul(V tap, const Eight& a) {
    return {Mul(tap, a.low), Mul(tap, a.high)};
}
HWY_INLINE Four MulAdd(V tap, const Four& a, const Four& sum) {
    return {hn::MulAdd(tap, a.v0, sum.v0), hn::MulAdd(tap, a.v1, sum.v1),
            hn::MulAdd(tap, a.v2, sum.v2), hn::MulAdd(tap, a.v3, sum.v3)};
}
HWY_INLINE Eight MulAdd(V tap, const Eight& a, const Eight& sum) {
    return {MulAdd(tap, a.low, sum.low), MulAdd(tap, a.high, sum.high)};
}

// The vectors at +above and at -below of the outputs, both distances counting down. Neighbouring
// outputs share their inputs: held in registers, each step towards the centre loads one new vector
// of a side instead of four or eight.
template <class Source, class Outputs>
struct Window {
    Source in;
    ptrdiff_t above, below;
    Outputs up;

    HWY_INLINE Window(const Source& source, ptrdiff_t distance_up, ptrdiff_t distance_down)
        : in(source),
          above(distance_up),
          below(distance_down),
          up(Outputs::At(source, distance_up)) {}
    // The input below the output `j`.
    template <int j>
    HWY_INLINE V Down() const {
        return in.At(j - below);
    }
    HWY_INLINE void Close() {
        --above;
        --below;
        up.PushFront(in.At(above));
    }
};

// Both sides in registers.
template <class Source, class Outputs>
struct HeldWindow : Window<Source, Outputs> {
    using Base = Window<Source, Outputs>;
    Outputs down;

    HWY_INLINE HeldWindow(const Source& source, ptrdiff_t distance_up, ptrdiff_t distance_down)
        : Base(source, distance_up, distance_down),
          down(Outputs::At(source, -distance_down)) {}
    template <int j>
    HWY_INLINE V Down() const {
        return down.template At<j>();
    }
    HWY_INLINE void Close() {
        Base::Close();
        down.PushBack(Base::template Down<Outputs::kCount - 1>());
    }
};

// The taps of a filter. They lie in memory as vectors: to spread one over the lanes costs more than
// to load it.
struct Taps {
    const float* HWY_RESTRICT vectors;
    HWY_INLINE V operator[](ptrdiff_t i) const {
        return InRegister(hn::Load(d, vectors + i * ptrdiff_t(hn::Lanes(d))));
    }
};

// Steps a filter from its outermost taps to the centre, `count` times. Four at a time: then no
// vector of a window moves to another register.
template <class Filter>
HWY_INLINE void Run(Filter& filter, ptrdiff_t count) {
    for (; count >= 4; count -= 4) {
        filter.Step();
        filter.Step();
        filter.Step();
        filter.Step();
    }
    if (count >= 2) {
        filter.Step();
        filter.Step();
        count -= 2;
    }
    if (count > 0)
        filter.Step();
}

// Sums run from the outside in, so that the rounding of one is that of its last few terms. They
// begin with a product: added to nothing it would have a third operand, and some cores read that
// where stores read theirs. The additions of a step are written before the products that wait for
// them.

// An even filter of two taps or more.
template <class Outputs, class Source>
struct EvenFilter {
    HeldWindow<Source, Outputs> window;
    Taps taps;
    Outputs sum;

    HWY_INLINE EvenFilter(const Source& in, const TapList& list)
        : window(in, list.count - 1, list.count - 1),
          taps{list.vectors},
          sum(Mul(taps[window.above], Pairs())) {
        window.Close();
    }
    HWY_INLINE Outputs Pairs() const { return Add(window.up, window.down); }
    HWY_INLINE void AddPairs(const Outputs& pairs) {
        sum = MulAdd(taps[window.above], pairs, sum);
        window.Close();
    }
    HWY_INLINE void Step() { AddPairs(Pairs()); }
    HWY_INLINE Outputs WithCentre() const { return MulAdd(taps[0], window.up, sum); }
};

template <class Outputs, class Source>
HWY_INLINE Outputs Even(const Source& in, const TapList& taps) {
    EvenFilter<Outputs, Source> filter(in, taps);
    Run(filter, filter.window.above);
    return filter.WithCentre();
}

struct TwoFours {
    Four first, second;
};

// An even filter at two places.
template <class Source>
struct PairOfFilters {
    EvenFilter<Four, Source> first, second;

    HWY_INLINE void Step() {
        const Four a = first.Pairs(), b = second.Pairs();
        first.AddPairs(a);
        second.AddPairs(b);
    }
};

template <class Source>
HWY_INLINE TwoFours EvenPair(const Source& in_first, const Source& in_second, const TapList& taps) {
    if constexpr (!kManyRegisters)
        return {Even<Four>(in_first, taps), Even<Four>(in_second, taps)};
    PairOfFilters<Source> filters{{in_first, taps}, {in_second, taps}};
    Run(filters, filters.first.window.above);
    return {filters.first.WithCentre(), filters.second.WithCentre()};
}

// How two vectors at one distance enter the sums of two filters: of even ones,
struct BothEven {
    static HWY_INLINE void Begin(V up, V down, V tap, V second_tap, V& one, V& two) {
        const V pair = hn::Add(up, down);
        one = hn::Mul(tap, pair);
        two = hn::Mul(second_tap, pair);
    }
    static HWY_INLINE void Add(V up, V down, V tap, V second_tap, V& one, V& two) {
        const V pair = hn::Add(up, down);
        one = hn::MulAdd(tap, pair, one);
        two = hn::MulAdd(second_tap, pair, two);
    }
};
// or of the detectors on steps.
struct OddAndEven {
    static HWY_INLINE void Begin(V up, V down, V tap, V second_tap, V& one, V& two) {
        one = hn::Mul(tap, hn::Add(up, down));
        two = hn::Mul(second_tap, hn::Sub(up, down));
    }
    static HWY_INLINE void Add(V up, V down, V tap, V second_tap, V& one, V& two) {
        one = hn::MulAdd(tap, hn::Add(up, down), one);
        two = hn::MulAdd(second_tap, hn::Sub(up, down), two);
    }
};

// Two filters on one plane. With few registers the vectors below are loaded one by one.
template <class Source, class Pair>
struct TwoFilters {
    std::conditional_t<kManyRegisters, HeldWindow<Source, Four>, Window<Source, Four>> window;
    Taps first_taps, second_taps;
    Four first, second;

    HWY_INLINE TwoFilters(const Source& in, ptrdiff_t distance_up, ptrdiff_t distance_down,
                          const TapList& first_list, const TapList& second_list)
        : window(in, distance_up, distance_down),
          first_taps{first_list.vectors},
          second_taps{second_list.vectors} {}

    HWY_INLINE void BeginPairs() { Enter(Pair::Begin); }
    HWY_INLINE void AddPairs() { Enter(Pair::Add); }
    HWY_INLINE void Begin() {
        BeginPairs();
        window.Close();
    }
    HWY_INLINE void Step() {
        AddPairs();
        window.Close();
    }
    template <class Function>
    HWY_INLINE void Enter(const Function& enter) {
        const V tap = first_taps[window.above], second_tap = second_taps[window.above];
        enter(window.up.v0, window.template Down<0>(), tap, second_tap, first.v0, second.v0);
        enter(window.up.v1, window.template Down<1>(), tap, second_tap, first.v1, second.v1);
        enter(window.up.v2, window.template Down<2>(), tap, second_tap, first.v2, second.v2);
        enter(window.up.v3, window.template Down<3>(), tap, second_tap, first.v3, second.v3);
        ForgetLoads();
    }

    // Where the second filter is longer, its outermost taps are applied alone.
    HWY_INLINE Four Pairs() const {
        return {hn::Add(window.up.v0, window.template Down<0>()),
                hn::Add(window.up.v1, window.template Down<1>()),
                hn::Add(window.up.v2, window.template Down<2>()),
                hn::Add(window.up.v3, window.template Down<3>())};
    }
    HWY_INLINE void BeginSecond() {
        second = Mul(second_taps[window.above], Pairs());
        window.Close();
    }
    HWY_INLINE void StepOfSecond() {
        second = MulAdd(second_taps[window.above], Pairs(), second);
        window.Close();
    }
    HWY_INLINE void BeginFirst() {
        first = Mul(first_taps[window.above], Pairs());
        StepOfSecond();
    }
};

// Two even filters of two taps or more, the second one of as many as the first one at least.
template <class Source>
HWY_INLINE TwoFours EvenTwo(const Source& in, const TapList& first, const TapList& second) {
    TwoFilters<Source, BothEven> filters(in, second.count - 1, second.count - 1, first, second);
    if (second.count == first.count) {
        filters.Begin();
    } else {
        filters.BeginSecond();
        while (filters.window.above >= first.count)
            filters.StepOfSecond();
        filters.BeginFirst();
    }
    Run(filters, filters.window.above);
    return {MulAdd(filters.first_taps[0], filters.window.up, filters.first),
            MulAdd(filters.second_taps[0], filters.window.up, filters.second)};
}

// Both detectors on the steps of a plane.
template <class Source>
HWY_INLINE TwoFours Detectors(const Source& steps, const TapList& first, const TapList& second) {
    TwoFilters<Source, OddAndEven> filters(steps, first.count - 1, first.count, first, second);
    if (first.count == 1) {
        filters.BeginPairs();
    } else {
        filters.Begin();
        Run(filters, filters.window.above);
        filters.AddPairs();
    }
    return {filters.first, filters.second};
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
