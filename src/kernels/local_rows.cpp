// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/local_rows.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/local_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/curves-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kLargest = std::numeric_limits<float>::max();

HWY_INLINE V LuminanceOf(const float (&weights)[3], const Color& c) {
    V lum = hn::Mul(Number(weights[0]), c.c0);
    lum = hn::MulAdd(Number(weights[1]), c.c1, lum);
    return hn::MulAdd(Number(weights[2]), c.c2, lum);
}

struct Weights {
    float w[3];
    explicit Weights(const std::array<double, 3>& weights)
        : w{float(weights[0]), float(weights[1]), float(weights[2])} {}
};

// Calls rows(i) for vectors of pixels from i on. The rest goes through the same instructions, in
// `tail`, which calls it with its own planes.
template <class Row, class Tail>
void ForVectors(ptrdiff_t count, const Row& row, const Tail& tail) {
    const auto lanes = ptrdiff_t(hn::Lanes(d));
    const ptrdiff_t whole = count - count % lanes;
    for (ptrdiff_t i = 0; i < whole; i += lanes)
        row(i);
    if (whole < count)
        tail(whole, count - whole);
}

void LuminanceRow(const std::array<double, 3>& weights, const float* const in[3], float* out,
                  ptrdiff_t count) {
    const Weights by(weights);
    ForVectors(
        count,
        [&](ptrdiff_t i) HWY_ATTR {
            hn::StoreU(LuminanceOf(by.w, {hn::LoadU(d, in[0] + i), hn::LoadU(d, in[1] + i),
                                          hn::LoadU(d, in[2] + i)}),
                       d, out + i);
        },
        [&](ptrdiff_t at, ptrdiff_t rest) HWY_ATTR {
            float buffer[3][hn::MaxLanes(d)] = {};
            for (size_t c = 0; c < 3; ++c)
                std::copy_n(in[c] + at, rest, buffer[c]);
            const V lum = LuminanceOf(
                by.w, {hn::LoadU(d, buffer[0]), hn::LoadU(d, buffer[1]), hn::LoadU(d, buffer[2])});
            hn::StoreU(lum, d, buffer[0]);
            std::copy_n(buffer[0], rest, out + at);
        });
}

HWY_INLINE V Logarithm(V x, float least, float scale) {
    const auto valid = hn::And(hn::Ge(x, hn::Zero(d)), hn::Le(x, Number(kLargest)));
    const V log = hn::Mul(Number(scale), Log2Within(hn::Max(x, Number(least))));
    return hn::IfThenElse(valid, log, Number(std::numeric_limits<float>::quiet_NaN()));
}

void LogRow(const float* in, float* out, ptrdiff_t count, float least, float scale) {
    ForVectors(
        count,
        [&](ptrdiff_t i)
            HWY_ATTR { hn::StoreU(Logarithm(hn::LoadU(d, in + i), least, scale), d, out + i); },
        [&](ptrdiff_t at, ptrdiff_t rest) HWY_ATTR {
            float buffer[hn::MaxLanes(d)] = {};
            std::copy_n(in + at, rest, buffer);
            hn::StoreU(Logarithm(hn::LoadU(d, buffer), least, scale), d, buffer);
            std::copy_n(buffer, rest, out + at);
        });
}

// Tone curves, section 1.4 of the paper, Eq. 2.
struct LocalLanes {
    DragoLanes drago;
    float weights[3], per_adaptation, display, saturation;
    bool log_base, saturate;

    explicit LocalLanes(const LocalCurve& curve)
        : drago(CurveNumbers{CurveKind::Drago, {curve.maximum / curve.adaptation, curve.bias}}),
          weights{float(curve.weights[0]), float(curve.weights[1]), float(curve.weights[2])},
          per_adaptation(float(1 / curve.adaptation)),
          display(float(curve.display_maximum / 100)),
          saturation(float(curve.saturation)),
          log_base(curve.log_base),
          saturate(curve.saturation != 1) {}

    HWY_INLINE V Base(V base, V lum) const {
        if (log_base)
            base = Exp2Within(hn::Mul(base, Number(1.4426950408889634f)));
        const V least = Number(kSmallestLuminance);
        const auto valid = hn::And(hn::Ge(base, least), hn::Le(base, Number(kLargest)));
        return hn::IfThenElse(valid, base, lum);
    }

    HWY_INLINE V Channel(V c, V lum, V gain) const {
        if (!saturate)
            return hn::Mul(c, gain);
        const V size = hn::Min(hn::Div(hn::Abs(c), lum), Number(kLargest));
        const V power = Exp2Within(hn::Mul(Number(saturation), Log2Within(size)));
        const V of_zero = Number(saturation > 0 ? 0.0f : 1.0f);
        const V raised = hn::IfThenElse(hn::Gt(size, hn::Zero(d)), power, of_zero);
        return hn::Mul(hn::CopySign(raised, c), hn::Mul(lum, gain));
    }

    HWY_INLINE V Bounded(V v) const {
        return hn::Min(hn::Max(v, Number(-kLargest)), Number(kLargest));
    }

    // The gain is Ld / L = T(Lb) / Lb.
    HWY_INLINE Color operator()(V base, const Color& c) const {
        const V lum = LuminanceOf(weights, c);
        const auto lit =
            hn::And(hn::Ge(lum, Number(kSmallestLuminance)), hn::Le(lum, Number(kLargest)));
        base = Base(base, hn::IfThenElse(lit, lum, Number(1.0f)));
        const V shown = hn::Mul(Number(display), drago(hn::Mul(base, Number(per_adaptation))));
        const V gain = hn::Div(shown, base);
        return {hn::IfThenElseZero(lit, Bounded(Channel(c.c0, lum, gain))),
                hn::IfThenElseZero(lit, Bounded(Channel(c.c1, lum, gain))),
                hn::IfThenElseZero(lit, Bounded(Channel(c.c2, lum, gain)))};
    }
};

void LocalRow(const LocalCurve& curve, const float* base, const float* const in[3],
              float* const out[3], ptrdiff_t count) {
    const LocalLanes lanes(curve);
    const auto run = [&](const float* b, const float* const from[3], float* const to[3],
                         ptrdiff_t i) HWY_ATTR {
        const Color c =
            lanes(hn::LoadU(d, b + i), {hn::LoadU(d, from[0] + i), hn::LoadU(d, from[1] + i),
                                        hn::LoadU(d, from[2] + i)});
        hn::StoreU(c.c0, d, to[0] + i);
        hn::StoreU(c.c1, d, to[1] + i);
        hn::StoreU(c.c2, d, to[2] + i);
    };
    ForVectors(
        count, [&](ptrdiff_t i) HWY_ATTR { run(base, in, out, i); },
        [&](ptrdiff_t at, ptrdiff_t rest) HWY_ATTR {
            float buffer[4][hn::MaxLanes(d)] = {};
            float* const planes[3] = {buffer[0], buffer[1], buffer[2]};
            for (size_t c = 0; c < 3; ++c)
                std::copy_n(in[c] + at, rest, buffer[c]);
            std::copy_n(base + at, rest, buffer[3]);
            run(buffer[3], planes, planes, 0);
            for (size_t c = 0; c < 3; ++c)
                std::copy_n(buffer[c], rest, out[c] + at);
        });
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(LuminanceRow);
HWY_EXPORT(LogRow);
HWY_EXPORT(LocalRow);

void luminance_rows(const std::array<double, 3>& weights, const float* const in[3], float* out,
                    ptrdiff_t count) {
    HWY_DYNAMIC_DISPATCH(LuminanceRow)(weights, in, out, count);
}

void log_rows(const float* in, float* out, ptrdiff_t count, float least, float scale) {
    HWY_DYNAMIC_DISPATCH(LogRow)(in, out, count, least, scale);
}

void local_rows(const LocalCurve& curve, const float* base, const float* const in[3],
                float* const out[3], ptrdiff_t count) {
    HWY_DYNAMIC_DISPATCH(LocalRow)(curve, base, in, out, count);
}

} // namespace tonetool::kernels
#endif
