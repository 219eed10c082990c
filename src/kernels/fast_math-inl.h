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

/// A root high (1 + rest), |rest| < 0.07; `high` has at most 8 significant bits.
template <class V>
struct Root {
    V high, rest;
};

/// Cube root of x in [1e-30, 1e30], exact to 1e-9 relative. `high` is so short that its cube is
/// exact in float, hence also what is missing, x - high^3; the rest is a series in it.
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

/// Cube roots of the middles of the half binades from 2^-7 to 2, rounded to 8 bits so that their
/// cubes are exact in float; the cubes, and one over them.
struct CubeRootTable {
    alignas(64) float root[16];
    alignas(64) float cube[16];
    alignas(64) float inverse[16];
};

constexpr CubeRootTable MakeCubeRootTable() {
    CubeRootTable out{};
    for (int i = 0; i < 16; ++i) {
        const double binade = double(1 << (i / 2)) / 128;
        const double middle = binade * (1.25 + 0.5 * (i % 2));
        double root = 1;
        for (int step = 0; step < 20; ++step)
            root -= (root - middle / (root * root)) / 3;
        const double spacing = (root < 0.25 ? 0.125 : root < 0.5 ? 0.25 : root < 1 ? 0.5 : 1) / 128;
        root = double(int(root / spacing + 0.5)) * spacing;
        out.root[i] = float(root);
        out.cube[i] = float(root * root * root);
        out.inverse[i] = float(1 / (root * root * root));
    }
    return out;
}

inline constexpr CubeRootTable kCubeRootTable = MakeCubeRootTable();

/// Entry (bits >> 22) & 15 of a table of 16, in registers of 16 or of 8 lanes.
template <class D, class VI, class V = hn::Vec<D>>
HWY_INLINE V LookUpHalfBinade(D tag, const float* table, VI bits) {
    const hn::RebindToSigned<D> di;
    const auto index = hn::ShiftRight<22>(bits);
    if constexpr (HWY_MAX_BYTES == 64) {
        const auto lanes = hn::IndicesFromVec(tag, hn::And(index, hn::Set(di, 15)));
        return hn::TableLookupLanes(hn::Load(tag, table), lanes);
    } else {
        const auto lanes = hn::IndicesFromVec(tag, hn::And(index, hn::Set(di, 7)));
        const auto upper = hn::MaskFromVec(hn::BitCast(tag, hn::ShiftLeft<6>(bits)));
        return hn::IfThenElse(upper, hn::TableLookupLanes(hn::Load(tag, table + 8), lanes),
                              hn::TableLookupLanes(hn::Load(tag, table), lanes));
    }
}

/// Cube root of x in [2^-7, 2), exact to 2e-8 relative: without a division where a table of 16
/// fits into registers.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Root<V> CubeRootOfShare(D tag, V x) {
#if HWY_MAX_BYTES == 64 || HWY_MAX_BYTES == 32
    const hn::RebindToSigned<D> di;
    const auto bits = hn::BitCast(di, x);
    const V high = LookUpHalfBinade(tag, kCubeRootTable.root, bits);
    const V u = hn::Mul(hn::Sub(x, LookUpHalfBinade(tag, kCubeRootTable.cube, bits)),
                        LookUpHalfBinade(tag, kCubeRootTable.inverse, bits));
    // ((1 + u)^(1/3) - 1) / u, |u| < 0.204
    V p = hn::Set(tag, -0.025342489778950903f);
    p = hn::MulAdd(p, u, hn::Set(tag, 0.0315501658028984f));
    p = hn::MulAdd(p, u, hn::Set(tag, -0.04109181212208456f));
    p = hn::MulAdd(p, u, hn::Set(tag, 0.06170107902763325f));
    p = hn::MulAdd(p, u, hn::Set(tag, -0.11111165557487199f));
    p = hn::MulAdd(p, u, hn::Set(tag, 0.33333346374610767f));
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

/// 2^x for x in [-126, 127]; relative error below 3e-7. Taylor series of e^(f ln 2), |f| <= 1/2.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Exp2(D tag, V x) {
    const hn::RebindToSigned<D> di;
    const V whole = hn::Round(x);
    const V f = hn::Sub(x, whole);
    V p = hn::Set(tag, 1.525273380405984e-5f);
    p = hn::MulAdd(p, f, hn::Set(tag, 1.540353039338161e-4f));
    p = hn::MulAdd(p, f, hn::Set(tag, 1.333355814642844e-3f));
    p = hn::MulAdd(p, f, hn::Set(tag, 9.618129107628477e-3f));
    p = hn::MulAdd(p, f, hn::Set(tag, 5.550410866482158e-2f));
    p = hn::MulAdd(p, f, hn::Set(tag, 2.402265069591007e-1f));
    p = hn::MulAdd(p, f, hn::Set(tag, 6.931471805599453e-1f));
    p = hn::MulAdd(p, f, hn::Set(tag, 1.0f));
    const auto bits = hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127));
    return hn::Mul(p, hn::BitCast(tag, hn::ShiftLeft<23>(bits)));
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
