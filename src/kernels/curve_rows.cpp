// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/curve_rows.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/curve_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/curves-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class Curve>
struct PerChannel {
    Curve curve;
    PerChannel(const CurveNumbers& numbers, const CurveUse&) : curve(numbers) {}
    HWY_INLINE Color operator()(const Color& x) const {
        return {curve(x.c0), curve(x.c1), curve(x.c2)};
    }
};

template <class Curve>
struct Mixed {
    Curve curve;
    Mixed(const CurveNumbers& numbers, const CurveUse&) : curve(numbers) {}
    HWY_INLINE Color operator()(const Color& x) const { return curve(x); }
};

// C / L, limited to a finite value: with weights of 0 the ratio has no bound.
struct PlainRatio {
    explicit PlainRatio(const CurveUse&) {}
    HWY_INLINE V operator()(V x, V lum) const {
        return hn::Min(hn::Div(x, lum), Number(std::numeric_limits<float>::max()));
    }
};

// (C / L)^saturation.
struct SaturatedRatio {
    float saturation, of_zero;
    explicit SaturatedRatio(const CurveUse& use)
        : saturation(float(use.saturation)),
          of_zero(use.saturation > 0 ? 0.0f : 1.0f) {}
    HWY_INLINE V operator()(V x, V lum) const {
        const V ratio = hn::Min(hn::Div(x, lum), Number(std::numeric_limits<float>::max()));
        const V power = Exp2Within(hn::Mul(Number(saturation), Log2Within(ratio)));
        return hn::IfThenElse(hn::Gt(ratio, hn::Zero(d)), power, Number(of_zero));
    }
};

template <class Curve, class Ratio>
struct OnLuminance {
    Curve curve;
    Ratio ratio;
    float weights[3];
    OnLuminance(const CurveNumbers& numbers, const CurveUse& use)
        : curve(numbers),
          ratio(use),
          weights{float(use.weights[0]), float(use.weights[1]), float(use.weights[2])} {}
    HWY_INLINE Color operator()(const Color& x) const {
        V lum = hn::Mul(Number(weights[0]), x.c0);
        lum = hn::MulAdd(Number(weights[1]), x.c1, lum);
        lum = hn::MulAdd(Number(weights[2]), x.c2, lum);
        const auto lit = hn::Ge(lum, Number(kSmallestLuminance));
        const V y = curve(lum);
        return {hn::IfThenElseZero(lit, hn::Mul(y, ratio(x.c0, lum))),
                hn::IfThenElseZero(lit, hn::Mul(y, ratio(x.c1, lum))),
                hn::IfThenElseZero(lit, hn::Mul(y, ratio(x.c2, lum)))};
    }
};

// `count` is a multiple of the number of lanes.
template <class Map>
void MapVectors(const Map& map, const float* const in[3], float* const out[3], ptrdiff_t count,
                float scale, bool clamp) {
    constexpr float largest = std::numeric_limits<float>::max();
    const V s = Number(scale), limit = Number(kLargestExposed);
    const V low = Number(clamp ? 0.0f : -largest), high = Number(clamp ? 1.0f : largest);
    for (ptrdiff_t i = 0; i < count; i += ptrdiff_t(hn::Lanes(d))) {
        const Color y = map(Color{hn::Min(hn::Mul(hn::LoadU(d, in[0] + i), s), limit),
                                  hn::Min(hn::Mul(hn::LoadU(d, in[1] + i), s), limit),
                                  hn::Min(hn::Mul(hn::LoadU(d, in[2] + i), s), limit)});
        hn::StoreU(hn::Min(hn::Max(y.c0, low), high), d, out[0] + i);
        hn::StoreU(hn::Min(hn::Max(y.c1, low), high), d, out[1] + i);
        hn::StoreU(hn::Min(hn::Max(y.c2, low), high), d, out[2] + i);
    }
}

template <class Map>
void Run(const CurveNumbers& curve, const CurveUse& use, const float* const in[3],
         float* const out[3], ptrdiff_t count, float scale) {
    const Map map(curve, use);

    const ptrdiff_t rest = count % ptrdiff_t(hn::Lanes(d)), whole = count - rest;
    MapVectors(map, in, out, whole, scale, use.clamp);
    if (rest == 0)
        return;
    // The rest goes through the same instructions in a buffer of one vector.
    float buffer[3][hn::MaxLanes(d)] = {};
    float* const at[3] = {buffer[0], buffer[1], buffer[2]};
    for (size_t c = 0; c < 3; ++c)
        std::copy_n(in[c] + whole, rest, at[c]);
    MapVectors(map, at, at, ptrdiff_t(hn::Lanes(d)), scale, use.clamp);
    for (size_t c = 0; c < 3; ++c)
        std::copy_n(at[c], rest, out[c] + whole);
}

// As it is run on channels and on luminance.
template <class Channels, class Curve>
void RunUnmixed(const CurveNumbers& curve, const CurveUse& use, const float* const in[3],
                float* const out[3], ptrdiff_t count, float scale) {
    if (!use.on_luminance)
        Run<Channels>(curve, use, in, out, count, scale);
    else if (use.saturation == 1)
        Run<OnLuminance<Curve, PlainRatio>>(curve, use, in, out, count, scale);
    else
        Run<OnLuminance<Curve, SaturatedRatio>>(curve, use, in, out, count, scale);
}

void CurveRows(const CurveNumbers& curve, const CurveUse& use, const float* const in[3],
               float* const out[3], ptrdiff_t count, float scale) {
    switch (curve.kind) {
    case CurveKind::Rational:
        return RunUnmixed<PerChannel<RationalLanes>, RationalLanes>(curve, use, in, out, count,
                                                                    scale);
    case CurveKind::Logarithmic:
        return RunUnmixed<PerChannel<LogarithmicLanes>, LogarithmicLanes>(curve, use, in, out,
                                                                          count, scale);
    case CurveKind::Exponential:
        return RunUnmixed<PerChannel<ExponentialLanes>, ExponentialLanes>(curve, use, in, out,
                                                                          count, scale);
    case CurveKind::Drago:
        return RunUnmixed<PerChannel<DragoLanes>, DragoLanes>(curve, use, in, out, count, scale);
    case CurveKind::FilmicAlu:
        return RunUnmixed<PerChannel<FilmicAluLanes>, FilmicAluLanes>(curve, use, in, out, count,
                                                                      scale);
    case CurveKind::Lottes:
        return RunUnmixed<PerChannel<LottesLanes>, LottesLanes>(curve, use, in, out, count, scale);
    case CurveKind::Uchimura:
        return RunUnmixed<PerChannel<UchimuraLanes>, UchimuraLanes>(curve, use, in, out, count,
                                                                    scale);
    case CurveKind::AcesHill:
        return Run<Mixed<AcesHillLanes>>(curve, use, in, out, count, scale);
    case CurveKind::Agx:
        return Run<Mixed<AgxLanes>>(curve, use, in, out, count, scale);
    case CurveKind::Neutral:
        return Run<Mixed<NeutralLanes>>(curve, use, in, out, count, scale);
    case CurveKind::Film:
        return RunUnmixed<Mixed<FilmLanes>, FilmLanes>(curve, use, in, out, count, scale);
    case CurveKind::Table:
        return RunUnmixed<Mixed<TableLanes>, TableLanes>(curve, use, in, out, count, scale);
    }
}

const char* CurveTarget() {
    return hwy::TargetName(HWY_TARGET);
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(CurveRows);
HWY_EXPORT(CurveTarget);

void curve_rows(const CurveNumbers& curve, const CurveUse& use, const float* const in[3],
                float* const out[3], ptrdiff_t count, float scale) {
    HWY_DYNAMIC_DISPATCH(CurveRows)(curve, use, in, out, count, scale);
}

const char* curve_target() {
    return HWY_DYNAMIC_DISPATCH(CurveTarget)();
}

} // namespace tonetool::kernels
#endif
