// Symmetric filters in lanes, several outputs at a time. Included once per target.
#if defined(TONETOOL_KERNELS_FOLD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_FOLD_INL_H_
#undef TONETOOL_KERNELS_FOLD_INL_H_
#else
#define TONETOOL_KERNELS_FOLD_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/color-inl.h"
#include "kernels/flip_rows.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Outputs of one filter at a time. A sum waits for its last product, so that eight sums (of four
// outputs and two filters, or of two planes) keep the multipliers busy; four do where a core finds
// the next four in time.
constexpr int kOutputs = 4;

// One vector for each of the outputs. Not an array, which compilers like to keep in memory.
struct Four {
    V v0, v1, v2, v3;
};

HWY_INLINE Four ZeroFour() {
    const V zero = hn::Zero(d);
    return {zero, zero, zero, zero};
}
HWY_INLINE Four Add(const Four& a, const Four& b) {
    return {hn::Add(a.v0, b.v0), hn::Add(a.v1, b.v1), hn::Add(a.v2, b.v2), hn::Add(a.v3, b.v3)};
}
HWY_INLINE Four Sub(const Four& a, const Four& b) {
    return {hn::Sub(a.v0, b.v0), hn::Sub(a.v1, b.v1), hn::Sub(a.v2, b.v2), hn::Sub(a.v3, b.v3)};
}
HWY_INLINE Four MulAdd(V tap, const Four& a, const Four& sum) {
    return {hn::MulAdd(tap, a.v0, sum.v0), hn::MulAdd(tap, a.v1, sum.v1),
            hn::MulAdd(tap, a.v2, sum.v2), hn::MulAdd(tap, a.v3, sum.v3)};
}

// Neighbouring outputs share their inputs: held in registers, each step towards the centre loads
// one new vector instead of four. Both sides of a window take eight registers: of 16 this leaves
// enough for four sums, but for eight one side only.
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

template <class Source>
HWY_INLINE Four FourAt(const Source& in, ptrdiff_t i) {
    return {in.At(i), in.At(i + 1), in.At(i + 2), in.At(i + 3)};
}

// The vectors at +above and at -below of the outputs, both distances counting down.
template <class Source, bool kHoldDown>
struct Window {
    Source in;
    ptrdiff_t above, below;
    Four up;

    HWY_INLINE Window(const Source& source, ptrdiff_t distance_up, ptrdiff_t distance_down)
        : in(source),
          above(distance_up),
          below(distance_down),
          up(FourAt(source, distance_up)) {}
    HWY_INLINE const Four& Up() const { return up; }
    HWY_INLINE Four Down() const { return FourAt(in, -below); }
    HWY_INLINE void Close() {
        --above;
        --below;
        up = {in.At(above), up.v0, up.v1, up.v2};
    }
};

template <class Source>
struct Window<Source, true> : Window<Source, false> {
    using Base = Window<Source, false>;
    Four down;

    HWY_INLINE Window(const Source& source, ptrdiff_t distance_up, ptrdiff_t distance_down)
        : Base(source, distance_up, distance_down),
          down(FourAt(source, -distance_down)) {}
    HWY_INLINE const Four& Down() const { return down; }
    HWY_INLINE void Close() {
        Base::Close();
        down = {down.v1, down.v2, down.v3, Base::in.At(kOutputs - 1 - Base::below)};
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

// Sums run from the outside in, so that the rounding of one is that of its last few terms. The
// additions of a step are written before the products that wait for them.

// An even filter.
template <class Source, bool kHoldDown>
struct EvenFilter {
    Window<Source, kHoldDown> window;
    Taps taps;
    Four sum = ZeroFour();

    HWY_INLINE EvenFilter(const Source& in, const TapList& list)
        : window(in, list.count - 1, list.count - 1),
          taps{list.vectors} {}
    HWY_INLINE Four Pairs() const { return Add(window.Up(), window.Down()); }
    HWY_INLINE V Tap() const { return taps[window.above]; }
    HWY_INLINE void AddPairs(const Four& pairs) {
        sum = MulAdd(Tap(), pairs, sum);
        window.Close();
    }
    HWY_INLINE void Step() { AddPairs(Pairs()); }
    HWY_INLINE Four WithCentre() const { return MulAdd(taps[0], window.Up(), sum); }
};

struct TwoFours {
    Four first, second;
};

template <class Source>
HWY_INLINE Four Even(const Source& in, const TapList& taps) {
    EvenFilter<Source, true> filter(in, taps);
    Run(filter, filter.window.above);
    return filter.WithCentre();
}

// Two even filters of one length, each on its plane.
template <class Source>
struct PairOfFilters {
    EvenFilter<Source, true> first, second;

    HWY_INLINE void Step() {
        const Four a = first.Pairs(), b = second.Pairs();
        first.AddPairs(a);
        second.AddPairs(b);
    }
};

template <class Source>
HWY_INLINE TwoFours EvenPair(const Source& in_first, const TapList& first, const Source& in_second,
                             const TapList& second) {
    if constexpr (!kManyRegisters)
        return {Even(in_first, first), Even(in_second, second)};
    PairOfFilters<Source> filters{{in_first, first}, {in_second, second}};
    Run(filters, filters.first.window.above);
    return {filters.first.WithCentre(), filters.second.WithCentre()};
}

// Two even filters on one plane.
template <class Source>
struct TwoFilters {
    EvenFilter<Source, kManyRegisters> second;
    Taps first_taps;
    Four first_sum = ZeroFour();

    HWY_INLINE void Step() {
        const V tap = first_taps[second.window.above];
        if constexpr (kManyRegisters) {
            const Four pairs = second.Pairs();
            first_sum = MulAdd(tap, pairs, first_sum);
            second.AddPairs(pairs);
        } else {
            const V second_tap = second.Tap();
            AddPair(0, second.window.up.v0, tap, second_tap, first_sum.v0, second.sum.v0);
            AddPair(1, second.window.up.v1, tap, second_tap, first_sum.v1, second.sum.v1);
            AddPair(2, second.window.up.v2, tap, second_tap, first_sum.v2, second.sum.v2);
            AddPair(3, second.window.up.v3, tap, second_tap, first_sum.v3, second.sum.v3);
            second.window.Close();
            ForgetLoads();
        }
    }
    HWY_INLINE void AddPair(ptrdiff_t j, V up, V tap, V second_tap, V& one, V& two) const {
        const V pair = hn::Add(up, second.window.in.At(j - second.window.below));
        one = hn::MulAdd(tap, pair, one);
        two = hn::MulAdd(second_tap, pair, two);
    }
};

// The second filter may be longer.
template <class Source>
HWY_INLINE TwoFours EvenTwo(const Source& in, const TapList& first, const TapList& second) {
    TwoFilters<Source> filters{{in, second}, {first.vectors}};
    const ptrdiff_t both = first.count - 1;
    while (filters.second.window.above > both)
        filters.second.Step();
    Run(filters, both);
    return {MulAdd(filters.first_taps[0], filters.second.window.Up(), filters.first_sum),
            filters.second.WithCentre()};
}

// Both detectors on the steps of a plane.
template <class Source>
struct DetectorFilters {
    Window<Source, kManyRegisters> window;
    Taps first_taps, second_taps;
    Four first = ZeroFour(), second = ZeroFour();

    HWY_INLINE void AddPairs() {
        const V tap = first_taps[window.above], second_tap = second_taps[window.above];
        if constexpr (kManyRegisters) {
            const Four sums = Add(window.Up(), window.Down());
            const Four differences = Sub(window.Up(), window.Down());
            first = MulAdd(tap, sums, first);
            second = MulAdd(second_tap, differences, second);
        } else {
            AddPair(0, window.up.v0, tap, second_tap, first.v0, second.v0);
            AddPair(1, window.up.v1, tap, second_tap, first.v1, second.v1);
            AddPair(2, window.up.v2, tap, second_tap, first.v2, second.v2);
            AddPair(3, window.up.v3, tap, second_tap, first.v3, second.v3);
            ForgetLoads();
        }
    }
    HWY_INLINE void AddPair(ptrdiff_t j, V up, V tap, V second_tap, V& one, V& two) const {
        const V down = window.in.At(j - window.below);
        one = hn::MulAdd(tap, hn::Add(up, down), one);
        two = hn::MulAdd(second_tap, hn::Sub(up, down), two);
    }
    HWY_INLINE void Step() {
        AddPairs();
        window.Close();
    }
};

template <class Source>
HWY_INLINE TwoFours Detectors(const Source& steps, const TapList& first, const TapList& second) {
    DetectorFilters<Source> filters{
        {steps, first.count - 1, first.count}, {first.vectors}, {second.vectors}};
    Run(filters, filters.window.above);
    filters.AddPairs();
    return {filters.first, filters.second};
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
