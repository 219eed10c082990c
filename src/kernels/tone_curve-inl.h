// SPDX-License-Identifier: BSD-3-Clause
// Tone curves in SIMD lanes. Included once per target.
#if defined(TONETOOL_KERNELS_TONE_CURVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_TONE_CURVE_INL_H_
#undef TONETOOL_KERNELS_TONE_CURVE_INL_H_
#else
#define TONETOOL_KERNELS_TONE_CURVE_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/color-inl.h"
#include "kernels/tone_curve.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE V Rational(const float (&k)[6], V x) {
    const V up = hn::MulAdd(hn::MulAdd(hn::Set(d, k[0]), x, hn::Set(d, k[1])), x, hn::Set(d, k[2]));
    const V down =
        hn::MulAdd(hn::MulAdd(hn::Set(d, k[3]), x, hn::Set(d, k[4])), x, hn::Set(d, k[5]));
    return hn::Div(up, down);
}

// Each curve is a type, so that the pixel loop holds no branch.
struct NoCurve {
    explicit NoCurve(const ToneCurve&) {}
    HWY_INLINE Color operator()(const Color& x) const { return x; }
};

struct RationalCurve {
    float k[6];
    explicit RationalCurve(const ToneCurve& curve) {
        for (size_t i = 0; i < 6; ++i)
            k[i] = float(curve.k[i]);
    }
    HWY_INLINE Color operator()(const Color& x) const {
        return {Rational(k, x.c0), Rational(k, x.c1), Rational(k, x.c2)};
    }
};

struct ReinhardCurve {
    explicit ReinhardCurve(const ToneCurve&) {}
    HWY_INLINE Color operator()(const Color& x) const {
        V lum = hn::Mul(hn::Set(d, float(kLuminance[0])), x.c0);
        lum = hn::MulAdd(hn::Set(d, float(kLuminance[1])), x.c1, lum);
        lum = hn::MulAdd(hn::Set(d, float(kLuminance[2])), x.c2, lum);
        const V scale = hn::Div(hn::Set(d, 1.0f), hn::Add(hn::Set(d, 1.0f), lum));
        return {hn::Mul(x.c0, scale), hn::Mul(x.c1, scale), hn::Mul(x.c2, scale)};
    }
};

// The exposure of a pixel; what is brighter than any curve tells apart is cut off.
struct Expose {
    float scale;
    HWY_INLINE V operator()(V x) const {
        return hn::Min(hn::Mul(x, hn::Set(d, scale)), hn::Set(d, kLargestExposed));
    }
};

// The same where the curve has the factor in its coefficients.
struct CutOff {
    float largest;
    HWY_INLINE V operator()(V x) const { return hn::Min(x, hn::Set(d, largest)); }
};

// Tone map `count` pixels, rounded up to whole vectors; `store(i, color)` takes them.
template <class Exposure, class Curve, class Store>
HWY_INLINE void ForDisplay(const float* const in[3], ptrdiff_t count, const Exposure& expose,
                           const Curve& curve, const Store& store) {
    for (ptrdiff_t i = 0; i < count; i += ptrdiff_t(hn::Lanes(d))) {
        const Color y =
            curve(Color{expose(hn::LoadU(d, in[0] + i)), expose(hn::LoadU(d, in[1] + i)),
                        expose(hn::LoadU(d, in[2] + i))});
        store(i, Color{Clamp01(y.c0), Clamp01(y.c1), Clamp01(y.c2)});
    }
}

// A rational curve of x * scale as one of x.
inline ToneCurve Scaled(ToneCurve curve, double scale) {
    for (size_t i : {0, 3}) {
        curve.k[i] *= scale * scale;
        curve.k[i + 1] *= scale;
    }
    return curve;
}

template <class Store>
void WithCurve(const float* const in[3], ptrdiff_t count, const ToneCurve& curve, float scale,
               const Store& store) {
    // Beyond this coefficients and squares could leave the range of a float.
    constexpr float most = 1e9f;
    if (curve.kind == ToneKind::ReinhardLuminance)
        ForDisplay(in, count, Expose{scale}, ReinhardCurve(curve), store);
    else if (curve.kind == ToneKind::None)
        ForDisplay(in, count, Expose{scale}, NoCurve(curve), store);
    else if (scale < 1 / most || scale > most)
        ForDisplay(in, count, Expose{scale}, RationalCurve(curve), store);
    else
        ForDisplay(in, count, CutOff{kLargestExposed / scale}, RationalCurve(Scaled(curve, scale)),
                   store);
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
