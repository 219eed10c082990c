// SPDX-License-Identifier: BSD-3-Clause
// The FLIP error of two pixels from their colours and features, in SIMD lanes. Included once per
// target.
#if defined(TONETOOL_KERNELS_FLIP_ERROR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_FLIP_ERROR_INL_H_
#undef TONETOOL_KERNELS_FLIP_ERROR_INL_H_
#else
#define TONETOOL_KERNELS_FLIP_ERROR_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>

#include "kernels/color-inl.h"
#include "kernels/fast_math-inl.h"
#include "kernels/flip_constants.h"
#include "kernels/flip_rows.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE V SquaredLength(V a, V b) {
    return hn::MulAdd(a, a, hn::Mul(b, b));
}

// log2 of the colour difference of 116 h after the remap of q = (116 h)^0.7. Below 1e-30 all h are
// the same.
HWY_INLINE V Log2ColorError(V h) {
    constexpr double knee = kKneeShare * kLargestQ;
    const V log2_h = Log2(d, hn::Max(h, hn::Set(d, 1e-30f)));
    const V log2_q = hn::MulAdd(hn::Set(d, float(kColorExponent)), log2_h,
                                hn::Set(d, float(kColorExponent * std::log2(116.0))));
    const V low = hn::Add(log2_q, hn::Set(d, float(std::log2(kKneeError / knee))));
    const auto above = hn::Ge(log2_q, hn::Set(d, float(std::log2(knee))));
    if (hn::AllFalse(d, above))
        return low;
    constexpr double slope = (1.0 - kKneeError) / (kLargestQ - knee);
    const V high = hn::MulAdd(Exp2(d, log2_q), hn::Set(d, float(slope)),
                              hn::Set(d, float(kKneeError - slope * knee)));
    return hn::IfThenElse(above, Log2(d, high), low);
}

HWY_INLINE V Difference(const float* const (&r)[kFeaturePlanes],
                        const float* const (&t)[kFeaturePlanes], FeaturePlane plane, ptrdiff_t x) {
    return hn::Sub(hn::Load(d, r[plane] + x), hn::Load(d, t[plane] + x));
}

// HyAB over 116.
HWY_INLINE V ColorDistance(const float* const (&r)[kFeaturePlanes],
                           const float* const (&t)[kFeaturePlanes], ptrdiff_t x) {
    const V l = hn::Add(Difference(r, t, kLHigh, x), Difference(r, t, kLLow, x));
    const V a = Difference(r, t, kA, x), b = Difference(r, t, kB, x);
    // ((5 a)^2 + (2 b)^2) / 2^2
    const V square = hn::MulAdd(hn::Mul(hn::Set(d, 6.25f), a), a, hn::Mul(b, b));
    return hn::MulAdd(hn::Set(d, 2.0f), hn::Sqrt(square), hn::Abs(l));
}

HWY_INLINE V FeatureDistance(const float* const (&r)[kFeaturePlanes],
                             const float* const (&t)[kFeaturePlanes], ptrdiff_t x) {
    return hn::Max(hn::Abs(Difference(r, t, kEdge, x)), hn::Abs(Difference(r, t, kPoint, x)));
}

// Features raise the colour error to a power: E = color^(1 - feature) is worked out as a product of
// logarithms.
HWY_INLINE V PowerOf(V feature_distance) {
    const V one = hn::Set(d, 1.0f);
    const V feature = hn::Sqrt(hn::Mul(feature_distance, hn::Set(d, 0.70710678118654752f)));
    return hn::Sub(one, hn::Min(feature, one));
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
