// SPDX-License-Identifier: BSD-3-Clause
// Lane arithmetic for positive numbers: cube root, log2, exp2. Included once per target.
#if defined(TONETOOL_KERNELS_FAST_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_FAST_MATH_INL_H_
#undef TONETOOL_KERNELS_FAST_MATH_INL_H_
#else
#define TONETOOL_KERNELS_FAST_MATH_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A number as an unevaluated sum: `high` has at most 8 significant bits.
template <class V>
struct Split {
    V high, low;
};

/// A root high (1 + rest), |rest| < 0.13; `high` has at most 8 significant bits.
template <class V>
struct Root {
    V high, rest;
};

/// Cube root of x in [1e-30, 1e30], exact to 1e-9 relative. `high` has so few bits that its cube is
/// exact in float, and so is the remainder x - high^3; the rest of the root is a series in that
/// remainder.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Root<V> CubeRoot(D tag, V x) {
    const hn::RebindToSigned<D> di;
    // A third of the exponent as the first guess (3 % off), a Halley step cubes the error.
    const V third = hn::Mul(hn::ConvertTo(tag, hn::BitCast(di, x)), hn::Set(tag, 1.0f / 3.0f));
    V y = hn::BitCast(tag, hn::ConvertTo(di, hn::Add(third, hn::Set(tag, 709921077.0f))));
    const V cube = hn::Mul(hn::Mul(y, y), y);
    const V two = hn::Set(tag, 2.0f);
    y = hn::Mul(y, hn::Div(hn::MulAdd(two, x, cube), hn::MulAdd(two, cube, x)));
    const auto rounded = hn::Add(hn::BitCast(di, y), hn::Set(di, 0x8000));
    const V high = hn::BitCast(tag, hn::And(rounded, hn::Set(di, int32_t(0xffff0000))));
    const V high_cube = hn::Mul(hn::Mul(high, high), high);
    const V u = hn::Div(hn::Sub(x, high_cube), high_cube);
    // (1 + u)^(1/3) - 1, |u| < 0.012
    V p = hn::Set(tag, -10.0f / 243.0f);
    p = hn::MulAdd(p, u, hn::Set(tag, 5.0f / 81.0f));
    p = hn::MulAdd(p, u, hn::Set(tag, -1.0f / 9.0f));
    p = hn::MulAdd(p, u, hn::Set(tag, 1.0f / 3.0f));
    return {high, hn::Mul(p, u)};
}

/// Cube roots of about the middles of equal parts of the binades from 2^-7 to 2, rounded to 8 bits,
/// and one over their cubes: of the roots at the middle those for which float has it best.
template <int kParts>
struct CubeRootTable {
    static constexpr int kEntries = 8 * kParts;
    alignas(64) float root[kEntries];
    alignas(64) float inverse[kEntries];

    constexpr CubeRootTable() : root(), inverse() {
        for (int i = 0; i < kEntries; ++i) {
            const double binade = double(1 << (i / kParts)) / 128;
            const double middle = binade * (1 + (i % kParts + 0.5) / kParts);
            double exact = 1;
            for (int step = 0; step < 20; ++step)
                exact -= (exact - middle / (exact * exact)) / 3;
            const double ulp = (exact < 0.25  ? 0.125
                                : exact < 0.5 ? 0.25
                                : exact < 1   ? 0.5
                                              : 1) /
                               128;
            const int nearest = (int(2 * exact / ulp) + 1) / 2;
            double least = 1;
            for (int n = nearest - kParts; n <= nearest + kParts; ++n) {
                const double rounded = n * ulp, cube = rounded * rounded * rounded;
                const double off = double(float(1 / cube)) * cube - 1;
                if ((off < 0 ? -off : off) >= least)
                    continue;
                least = off < 0 ? -off : off;
                root[i] = float(rounded);
                inverse[i] = float(1 / cube);
            }
        }
    }
};

/// Cube root of x in [2^-7, 2), exact to 3e-8 relative, half an ulp: without a division where
/// vectors are so long that a register holds the table.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Root<V> CubeRootOfShare(D tag, V x) {
#if HWY_MAX_BYTES == 64 || HWY_MAX_BYTES == 32
    constexpr int kParts = HWY_MAX_BYTES / 32;
    static constexpr CubeRootTable<kParts> table{};
    const hn::RebindToSigned<D> di;
    // The lower bits of the exponent and, for two parts, the upper one of the mantissa.
    const auto entry = hn::ShiftRight<24 - kParts>(hn::BitCast(di, x));
    const auto index =
        hn::IndicesFromVec(tag, hn::And(entry, hn::Set(di, int32_t(table.kEntries - 1))));
    const V high = hn::TableLookupLanes(hn::Load(tag, table.root), index);
    const V inverse = hn::TableLookupLanes(hn::Load(tag, table.inverse), index);
    const V u = hn::MulSub(x, inverse, hn::Set(tag, 1.0f));
    // ((1 + u)^(1/3) - 1) / u
    V p;
    if constexpr (kParts == 2) { // |u| < 0.236
        p = hn::Set(tag, -0.025972509447540586f);
        p = hn::MulAdd(p, u, hn::Set(tag, 0.03204941722245045f));
        p = hn::MulAdd(p, u, hn::Set(tag, -0.041042016726833525f));
        p = hn::MulAdd(p, u, hn::Set(tag, 0.06167821872593176f));
        p = hn::MulAdd(p, u, hn::Set(tag, -0.11111249215489369f));
        p = hn::MulAdd(p, u, hn::Set(tag, 0.3333336517884711f));
    } else { // |u| < 0.348
        p = hn::Set(tag, -0.02052951817463687f);
        p = hn::MulAdd(p, u, hn::Set(tag, 0.02316682970339488f));
        p = hn::MulAdd(p, u, hn::Set(tag, -0.0228815164355381f));
        p = hn::MulAdd(p, u, hn::Set(tag, 0.029793029138391113f));
        p = hn::MulAdd(p, u, hn::Set(tag, -0.04118169869964628f));
        p = hn::MulAdd(p, u, hn::Set(tag, 0.061741063336224686f));
        p = hn::MulAdd(p, u, hn::Set(tag, -0.11111063767513228f));
        p = hn::MulAdd(p, u, hn::Set(tag, 0.3333332279612339f));
    }
    return {high, hn::Mul(p, u)};
#else
    return CubeRoot(tag, x);
#endif
}

/// log2 of a normal x > 0; absolute error below 3e-7 (1 + |log2 x|).
/// x = 2^e m with m in [sqrt(1/2), sqrt(2)); log2 m = 2/ln 2 artanh((m - 1) / (m + 1)).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Log2(D tag, V x) {
    const hn::RebindToSigned<D> di;
    const auto sqrt_half = hn::Set(di, 0x3f3504f3);
    const auto shifted = hn::Sub(hn::BitCast(di, x), sqrt_half);
    const auto exponent = hn::ShiftRight<23>(shifted);
    const V m = hn::BitCast(tag, hn::Sub(hn::BitCast(di, x), hn::ShiftLeft<23>(exponent)));
    const V one = hn::Set(tag, 1.0f);
    const V s = hn::Div(hn::Sub(m, one), hn::Add(m, one));
    const V s2 = hn::Mul(s, s);
    constexpr double c = 2.885390081777927; // 2 / ln 2
    V p = hn::Set(tag, float(c / 9));
    p = hn::MulAdd(p, s2, hn::Set(tag, float(c / 7)));
    p = hn::MulAdd(p, s2, hn::Set(tag, float(c / 5)));
    p = hn::MulAdd(p, s2, hn::Set(tag, float(c / 3)));
    p = hn::MulAdd(p, s2, hn::Set(tag, float(c)));
    return hn::MulAdd(p, s, hn::ConvertTo(tag, exponent));
}

/// log2(1 + x) for x >= 0; relative error below 5e-7, also where 1 + x rounds to 1: what the sum
/// lost is added to its logarithm.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Log2OfOnePlus(D tag, V x) {
    const V one = hn::Set(tag, 1.0f);
    const V sum = hn::Add(one, x);
    const V lost = hn::Sub(hn::Min(one, x), hn::Sub(sum, hn::Max(one, x)));
    return hn::MulAdd(hn::Div(lost, sum), hn::Set(tag, 1.4426950408889634f), Log2(tag, sum));
}

/// (2^f - 1) / f for |f| <= 1/2: Taylor series of e^(f ln 2).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2Series(D tag, V f) {
    V p = hn::Set(tag, 1.525273380405984e-5f);
    p = hn::MulAdd(p, f, hn::Set(tag, 1.540353039338161e-4f));
    p = hn::MulAdd(p, f, hn::Set(tag, 1.333355814642844e-3f));
    p = hn::MulAdd(p, f, hn::Set(tag, 9.618129107628477e-3f));
    p = hn::MulAdd(p, f, hn::Set(tag, 5.550410866482158e-2f));
    p = hn::MulAdd(p, f, hn::Set(tag, 2.402265069591007e-1f));
    return hn::MulAdd(p, f, hn::Set(tag, 6.931471805599453e-1f));
}

/// 2^whole for whole numbers in [-126, 127].
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2OfWhole(D tag, V whole) {
    const hn::RebindToSigned<D> di;
    const auto bits = hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127));
    return hn::BitCast(tag, hn::ShiftLeft<23>(bits));
}

/// 2^x for x in [-126, 127]; relative error below 3e-7.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2(D tag, V x) {
    const V whole = hn::Round(x);
    const V f = hn::Sub(x, whole);
    const V p = hn::MulAdd(Exp2Series(tag, f), f, hn::Set(tag, 1.0f));
    return hn::Mul(p, Exp2OfWhole(tag, whole));
}

/// 2^x - 1 for x in [-126, 127]; relative error below 5e-7, also near 0.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2LessOne(D tag, V x) {
    const V whole = hn::Round(x);
    const V f = hn::Sub(x, whole);
    const V power = Exp2OfWhole(tag, whole);
    return hn::MulAdd(hn::Mul(Exp2Series(tag, f), f), power, hn::Sub(power, hn::Set(tag, 1.0f)));
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
