// SPDX-License-Identifier: BSD-3-Clause
// Weights of the cross bilateral filter in lanes. Included once per target.
#if defined(TONETOOL_KERNELS_GUIDED_WEIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_GUIDED_WEIGHT_INL_H_
#undef TONETOOL_KERNELS_GUIDED_WEIGHT_INL_H_
#else
#define TONETOOL_KERNELS_GUIDED_WEIGHT_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/color-inl.h"
#include "kernels/guided_rows.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Where the background is, and on the other side what no pixel may be a neighbour of: so far that
/// weights are 0, and the squares of these distances are floats.
constexpr float kFarAway = 3e18f;

/// Neighbours that are weighed side by side, since each weight is a long chain of dependent steps.
constexpr int kTogether = HWY_MAX_BYTES == 64 ? 4 : 2;
using Together = V[kTogether];

/// Polynomials have the least relative error for their degree.
template <size_t kTerms>
HWY_INLINE void Polynomials(const float (&c)[kTerms], const Together& x, Together& p) {
    for (int i = 0; i < kTogether; ++i)
        p[i] = hn::MulAdd(hn::Set(d, c[0]), x[i], hn::Set(d, c[1]));
    for (size_t k = 2; k < kTerms; ++k)
        for (int i = 0; i < kTogether; ++i)
            p[i] = hn::MulAdd(p[i], x[i], hn::Set(d, c[k]));
}

#if HWY_TARGET == HWY_AVX3
/// 2^x for x < 127, exactly 0 for x as low as kFarAway makes it; relative error below 2.8e-6. The
/// instructions for this have no name in Highway.
HWY_INLINE void Weights2(Together& x) {
    constexpr int kAboveFloor = 1; // of a number, to no binary places
    Together share, p;
    for (int i = 0; i < kTogether; ++i)
        share[i] = V{_mm512_reduce_ps(x[i].raw, kAboveFloor)};
    Polynomials({0.013534167912794f, 0.052011460619440f, 0.24144275688264f, 0.69300383447386f,
                 1.0000025933704f},
                share, p);
    for (int i = 0; i < kTogether; ++i)
        x[i] = V{_mm512_scalef_ps(p[i].raw, x[i].raw)}; // p 2^floor(x)
}
#else
/// 2^x for x < 127, exactly 0 below kLeastLog2Weight; relative error below 2.8e-6.
HWY_INLINE void Weights2(Together& x) {
    const hn::RebindToSigned<D> di;
    // Added to it, x is rounded to a whole number, which with 127, the bias of exponents, is the
    // lowest bits of the sum. -127 gives the bits of 0.
    const V large = hn::Set(d, 12582912.0f + 127.0f);
    Together sum, p;
    for (V& v : x)
        v = hn::Max(v, hn::Set(d, -127.0f));
    for (int i = 0; i < kTogether; ++i)
        sum[i] = hn::Add(x[i], large);
    for (int i = 0; i < kTogether; ++i)
        x[i] = hn::Sub(x[i], hn::Sub(sum[i], large));
    Polynomials({0.009570101908854097f, 0.055917860321131746f, 0.24024744827851016f,
                 0.6931218147368339f, 0.999999261445985f},
                x, p);
    for (int i = 0; i < kTogether; ++i)
        x[i] = hn::Mul(p[i], hn::BitCast(d, hn::ShiftLeft<23>(hn::BitCast(di, sum[i]))));
}
#endif

using Int = hn::RebindToSigned<D>;
using Pairs = hn::Vec<Int>;

/// Two numbers to a word, of at most 8191 each.
HWY_INLINE Pairs PairUp(V low, V high) {
    const Int di;
    const Pairs mask = hn::Set(di, 0xffff);
    return hn::Or(hn::And(hn::NearestInt(low), mask), hn::ShiftLeft<16>(hn::NearestInt(high)));
}

/// `sum` and the squares of both differences.
HWY_INLINE Pairs AddSquares(Pairs a, Pairs b, Pairs sum) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
    // Here it adds neighbours to their own word, which it does not promise everywhere.
    const Int di;
    const hn::Repartition<int16_t, D> halves;
    Pairs unused = hn::Zero(di);
    const auto away = hn::Sub(hn::BitCast(halves, a), hn::BitCast(halves, b));
    return hn::ReorderWidenMulAccumulate(di, away, away, sum, unused);
#else
    const Pairs high = hn::Sub(hn::ShiftRight<16>(a), hn::ShiftRight<16>(b));
    const Pairs low =
        hn::Sub(hn::ShiftRight<16>(hn::ShiftLeft<16>(a)), hn::ShiftRight<16>(hn::ShiftLeft<16>(b)));
    return hn::Add(sum, hn::Add(hn::Mul(high, high), hn::Mul(low, low)));
#endif
}

/// One vector of pixels, against which others are weighed. Each combination of terms is a type, so
/// that the loop holds no branch.
template <bool kPosition, int kPlain, int kPairs, bool kAngle_, bool kRangeOfValue>
struct Terms {
    static constexpr bool kAngle = kAngle_;
    static constexpr int kWhere = kPosition ? 3 : 1, kFirstPlain = 1 + kWhere;
    static constexpr int kFirstPair = kFirstPlain + kPlain, kFirstAngle = kFirstPair + kPairs;
    static constexpr int kNearness = kFirstAngle + (kAngle ? 3 : 0);

    V value, where[kWhere], plain[kPlain + 1], angle[3], nearness, slope, range, steps;
    Pairs pair[kPairs + 1];

    HWY_INLINE Terms(const GuidedLayout& layout, const GuidedScales& scales, const float* at) {
        const auto load = [&](int p) HWY_ATTR { return hn::LoadU(d, at + p * layout.pitch); };
        value = load(0);
        for (int i = 0; i < kWhere; ++i)
            where[i] = load(1 + i);
        for (int i = 0; i < kPlain; ++i)
            plain[i] = load(kFirstPlain + i);
        for (int i = 0; i < kPairs; ++i)
            pair[i] = hn::BitCast(Int(), load(kFirstPair + i));
        if constexpr (kAngle)
            for (int i = 0; i < 3; ++i)
                angle[i] = load(kFirstAngle + i);
        nearness = load(kNearness);
        slope = hn::Set(d, scales.angle);
        range = hn::Set(d, scales.range_of_value);
        steps = hn::Set(d, scales.square_of_steps);
    }

    /// The weights of the pixels at `at`; `start` is log2 of the spatial ones.
    HWY_INLINE void Weigh(const float* const* at, ptrdiff_t x, ptrdiff_t pitch, const float* start,
                          Together& weights) const {
        Together square, away;
        for (int i = 0; i < kTogether; ++i) {
            away[i] = hn::Sub(where[0], hn::LoadU(d, at[i] + x + pitch));
            square[i] = hn::Mul(away[i], away[i]);
        }
        for (int p = 1; p < kWhere; ++p)
            for (int i = 0; i < kTogether; ++i) {
                away[i] = hn::Sub(where[p], hn::LoadU(d, at[i] + x + (1 + p) * pitch));
                square[i] = hn::MulAdd(away[i], away[i], square[i]);
            }
        for (int i = 0; i < kTogether; ++i)
            weights[i] = kPosition ? hn::NegMulAdd(square[i], nearness, hn::Set(d, start[i]))
                                   : hn::Sub(hn::Set(d, start[i]), square[i]);
        for (int p = 0; p < kPlain; ++p)
            for (int i = 0; i < kTogether; ++i) {
                away[i] = hn::Sub(plain[p], hn::LoadU(d, at[i] + x + (kFirstPlain + p) * pitch));
                weights[i] = hn::NegMulAdd(away[i], away[i], weights[i]);
            }
        if constexpr (kPairs > 0)
            TakePairs(at, x, pitch, weights);
        if constexpr (kAngle)
            AddAngles(at, x, pitch, weights);
        if constexpr (kRangeOfValue)
            for (int i = 0; i < kTogether; ++i) {
                away[i] = hn::Sub(value, hn::LoadU(d, at[i] + x));
                weights[i] = hn::NegMulAdd(hn::Mul(away[i], away[i]), range, weights[i]);
            }
        Weights2(weights);
    }

    HWY_INLINE void TakePairs(const float* const* at, ptrdiff_t x, ptrdiff_t pitch,
                              Together& weights) const {
        Pairs square[kTogether];
        for (Pairs& s : square)
            s = hn::Zero(Int());
        for (int p = 0; p < kPairs; ++p)
            for (int i = 0; i < kTogether; ++i) {
                const V other = hn::LoadU(d, at[i] + x + (kFirstPair + p) * pitch);
                square[i] = AddSquares(pair[p], hn::BitCast(Int(), other), square[i]);
            }
        for (int i = 0; i < kTogether; ++i)
            weights[i] = hn::NegMulAdd(hn::ConvertTo(d, square[i]), steps, weights[i]);
    }

    HWY_INLINE void AddAngles(const float* const* at, ptrdiff_t x, ptrdiff_t pitch,
                              Together& weights) const {
        for (int i = 0; i < kTogether; ++i) {
            const float* const n = at[i] + x + kFirstAngle * pitch;
            V cosine = hn::Mul(angle[0], hn::LoadU(d, n));
            cosine = hn::MulAdd(angle[1], hn::LoadU(d, n + pitch), cosine);
            cosine = hn::MulAdd(angle[2], hn::LoadU(d, n + 2 * pitch), cosine);
            weights[i] = hn::MulAdd(hn::Abs(cosine), slope, weights[i]);
        }
    }
};

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
