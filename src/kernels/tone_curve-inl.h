// Tone curves in lanes. Included once per target.
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

template <class Curve>
HWY_INLINE Color Display(const Curve& curve, const Color& linear, V scale) {
    const V limit = hn::Set(d, kLargestExposed);
    const Color y = curve(Color{hn::Min(hn::Mul(linear.c0, scale), limit),
                                hn::Min(hn::Mul(linear.c1, scale), limit),
                                hn::Min(hn::Mul(linear.c2, scale), limit)});
    return {Clamp01(y.c0), Clamp01(y.c1), Clamp01(y.c2)};
}

// Tone map `count` pixels, rounded up to whole vectors; `store(i, color)` takes them.
template <class Curve, class Store>
HWY_INLINE void ForDisplay(const float* const in[3], ptrdiff_t count, const Curve& curve,
                           float scale, const Store& store) {
    const V s = hn::Set(d, scale);
    for (ptrdiff_t i = 0; i < count; i += ptrdiff_t(hn::Lanes(d)))
        store(i, Display(curve,
                         Color{hn::LoadU(d, in[0] + i), hn::LoadU(d, in[1] + i),
                               hn::LoadU(d, in[2] + i)},
                         s));
}

template <class Store>
void WithCurve(const float* const in[3], ptrdiff_t count, const ToneCurve& curve, float scale,
               const Store& store) {
    if (curve.kind == ToneKind::Rational)
        ForDisplay(in, count, RationalCurve(curve), scale, store);
    else if (curve.kind == ToneKind::ReinhardLuminance)
        ForDisplay(in, count, ReinhardCurve(curve), scale, store);
    else
        ForDisplay(in, count, NoCurve(curve), scale, store);
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
