// The colour spaces of LDR-FLIP in lanes. Included once per target.
#if defined(TONETOOL_KERNELS_HUNT_LAB_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_HUNT_LAB_INL_H_
#undef TONETOOL_KERNELS_HUNT_LAB_INL_H_
#else
#define TONETOOL_KERNELS_HUNT_LAB_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/color-inl.h"
#include "kernels/fast_math-inl.h"
#include "kernels/flip_constants.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Linear RGB to XYZ relative to white, and back.
Matrix ToRelativeXyz() {
    Matrix out;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out.m[i][j] = float(kRgbToXyz[i][j] / kWhite[i]);
    return out;
}

Matrix FromRelativeXyz() {
    Matrix out;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out.m[i][j] = float(kXyzToRgb[i][j] * kWhite[j]);
    return out;
}

// CIELAB f(t). E is as steep as h^0.7 at h = 0: f is kept to more than float precision, so that
// its differences are limited by t alone.
HWY_INLINE Split<V> LabF(V t) {
    const V knee = hn::Set(d, float(kLabKnee));
    const Split<V> root = CubeRoot(d, hn::Max(t, knee));
    const auto above = hn::Gt(t, knee);
    const V line = hn::MulAdd(t, hn::Set(d, float(kLabSlope)),
                              hn::Set(d, float(kLabOffset - double(float(kLabOffset)))));
    return {hn::IfThenElse(above, root.high, hn::Set(d, float(kLabOffset))),
            hn::IfThenElse(above, root.low, line)};
}

struct Lab {
    Split<V> l;
    V a, b;
};

HWY_INLINE V Difference(const Split<V>& p, const Split<V>& q) {
    return hn::Add(hn::Sub(p.high, q.high), hn::Sub(p.low, q.low));
}

// f(p) - f(q), given p - q to its own precision: by (p - q) / (f(p)^2 + f(p) f(q) + f(q)^2) where
// both are cube roots.
HWY_INLINE V LabStep(V p, V q, V p_minus_q, const Split<V>& fp, const Split<V>& fq) {
    const V a = hn::Add(fp.high, fp.low), b = hn::Add(fq.high, fq.low);
    const V sum = hn::MulAdd(a, hn::Add(a, b), hn::Mul(b, b));
    return hn::IfThenElse(hn::Gt(hn::Min(p, q), hn::Set(d, float(kLabKnee))),
                          hn::Div(p_minus_q, sum), Difference(fp, fq));
}

// Filtered opponent colour to Hunt-adjusted Lab. The clamp of RGB is applied as a correction of
// XYZ, which is exactly nothing for colours inside the gamut.
HWY_INLINE Lab HuntLab(const Matrix& to_xyz, const Matrix& to_rgb, V y, V xy, V yz) {
    const Color rgb = to_rgb(Color{hn::Add(y, xy), y, hn::Sub(y, yz)});
    const Color moved =
        to_xyz(Color{hn::Sub(Clamp01(rgb.c0), rgb.c0), hn::Sub(Clamp01(rgb.c1), rgb.c1),
                     hn::Sub(Clamp01(rgb.c2), rgb.c2)});
    y = hn::Add(y, moved.c1);
    xy = hn::Add(xy, hn::Sub(moved.c0, moved.c1));
    yz = hn::Add(yz, hn::Sub(moved.c1, moved.c2));
    const V x = hn::Add(y, xy), z = hn::Sub(y, yz);
    const Split<V> fx = LabF(x), fy = LabF(y), fz = LabF(z);
    const V scale = hn::Set(d, 116.0f);
    // Exact: `high` has 8 bits, 116 has 5.
    const Split<V> l = {hn::Sub(hn::Mul(scale, fy.high), hn::Set(d, 16.0f)),
                        hn::Mul(scale, fy.low)};
    const V light = hn::Add(l.high, l.low);
    return {l, hn::Mul(hn::Mul(light, hn::Set(d, 5.0f)), LabStep(x, y, xy, fx, fy)),
            hn::Mul(hn::Mul(light, hn::Set(d, 2.0f)), LabStep(y, z, yz, fy, fz))};
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
