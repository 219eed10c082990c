// SPDX-License-Identifier: BSD-3-Clause
// The colour spaces of LDR-FLIP in SIMD lanes. Included once per target.
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

// RGB to the opponent planes of XYZ relative to white: y, x - y, y - z. White is (1, 0, 0), so that
// the weights of a row sum to 1 or to 0: two products with differences to green are enough, and a
// grey has x - y and y - z of exactly 0.
struct ToOpponentPlanes {
    float r[3], b[3];

    ToOpponentPlanes() {
        const auto relative = [](int row, int column) {
            return kRgbToXyz[row][column] / kWhite[row];
        };
        const auto weights = [&relative](int column, float(&out)[3]) {
            out[0] = float(relative(1, column));
            out[1] = float(relative(0, column) - relative(1, column));
            out[2] = float(relative(1, column) - relative(2, column));
        };
        weights(0, r);
        weights(2, b);
    }

    HWY_INLINE Color operator()(const Color& rgb) const {
        const V red = hn::Sub(rgb.c0, rgb.c1), blue = hn::Sub(rgb.c2, rgb.c1);
        return {hn::MulAdd(hn::Set(d, b[0]), blue, hn::MulAdd(hn::Set(d, r[0]), red, rgb.c1)),
                hn::MulAdd(hn::Set(d, b[1]), blue, hn::Mul(hn::Set(d, r[1]), red)),
                hn::MulAdd(hn::Set(d, b[2]), blue, hn::Mul(hn::Set(d, r[2]), red))};
    }
};

// And back: each of R, G, B is y plus products with the other two.
struct FromOpponentPlanes {
    float xy[3], yz[3];

    FromOpponentPlanes() {
        for (int i = 0; i < 3; ++i) {
            xy[i] = float(kXyzToRgb[i][0] * kWhite[0]);
            yz[i] = float(-kXyzToRgb[i][2] * kWhite[2]);
        }
    }

    HWY_INLINE Color operator()(V y, V x_y, V y_z) const {
        return {Row(0, y, x_y, y_z), Row(1, y, x_y, y_z), Row(2, y, x_y, y_z)};
    }
    HWY_INLINE V Row(int i, V y, V x_y, V y_z) const {
        return hn::MulAdd(hn::Set(d, yz[i]), y_z, hn::MulAdd(hn::Set(d, xy[i]), x_y, y));
    }
};

// CIELAB f(t). The line is the tangent of the root at the knee, and nowhere below it beyond.
HWY_INLINE V LabF(V t) {
    const V knee = hn::Set(d, float(kLabKnee));
    const V line = hn::MulAdd(t, hn::Set(d, float(kLabSlope)), hn::Set(d, float(kLabOffset)));
    const Root<V> root = CubeRootOfShare(d, hn::Max(t, knee));
    return hn::Min(hn::MulAdd(root.high, root.rest, root.high), line);
}

// The same as an unevaluated sum. E is as steep as h^0.7 at h = 0: f is kept to more than float
// precision, so that differences of L are limited by t alone.
HWY_INLINE Split<V> SplitLabF(V t) {
    const V knee = hn::Set(d, float(kLabKnee));
    const Root<V> root = CubeRootOfShare(d, hn::Max(t, knee));
    const auto above = hn::Gt(t, knee);
    const V line = hn::MulAdd(t, hn::Set(d, float(kLabSlope)),
                              hn::Set(d, float(kLabOffset - double(float(kLabOffset)))));
    return {hn::IfThenElse(above, root.high, hn::Set(d, float(kLabOffset))),
            hn::IfThenElse(above, hn::Mul(root.high, root.rest), line)};
}

// f(p) - f(q), given p - q to its own precision, where both are cube roots.
HWY_INLINE V RootStep(V p_minus_q, V fp, V fq) {
    return hn::Div(p_minus_q, hn::MulAdd(fp, hn::Add(fp, fq), hn::Mul(fq, fq)));
}

// The same wherever p and q are; by the slope where both lie on the line.
HWY_INLINE V LabStep(V p, V q, V p_minus_q, V fp, V fq) {
    const V knee = hn::Set(d, float(kLabKnee));
    const auto roots = hn::Gt(hn::Min(p, q), knee), line = hn::Le(hn::Max(p, q), knee);
    const V apart =
        hn::IfThenElse(line, hn::Mul(p_minus_q, hn::Set(d, float(kLabSlope))), hn::Sub(fp, fq));
    return hn::IfThenElse(roots, RootStep(p_minus_q, fp, fq), apart);
}

// The change that clamping RGB makes to a filtered opponent colour: exactly 0 inside the gamut.
HWY_INLINE Color BeyondGamut(const FromOpponentPlanes& to_rgb, const Color& c) {
    const Color rgb = to_rgb(c.c0, c.c1, c.c2);
    return {hn::Sub(Clamp01(rgb.c0), rgb.c0), hn::Sub(Clamp01(rgb.c1), rgb.c1),
            hn::Sub(Clamp01(rgb.c2), rgb.c2)};
}

HWY_INLINE bool AllZero(const Color& c) {
    return hn::AllTrue(d, hn::Eq(hn::Or(hn::Or(c.c0, c.c1), c.c2), hn::Zero(d)));
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
