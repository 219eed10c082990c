// SPDX-License-Identifier: BSD-3-Clause
// The tone curves in lanes. Included once per target.
//
// Each curve is a type, so that the pixel loop holds no branch. Its constructor works out in double
// what the parameters come to.
#if defined(TONETOOL_KERNELS_CURVES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_CURVES_INL_H_
#undef TONETOOL_KERNELS_CURVES_INL_H_
#else
#define TONETOOL_KERNELS_CURVES_INL_H_
#endif

#include <cmath>
#include <hwy/highway.h>

#include "kernels/color-inl.h"
#include "kernels/curve.h"
#include "kernels/curve_constants.h"
#include "kernels/curve_table.h"
#include "kernels/fast_math-inl.h"
#include "kernels/tone_curve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE V Number(float v) {
    return hn::Set(d, v);
}

/// 2^x, where x beyond the range of Exp2 takes its ends.
HWY_INLINE V Exp2Within(V x) {
    return Exp2(d, hn::Min(hn::Max(x, Number(-126.0f)), Number(127.0f)));
}

/// log2 of x >= 0, -126 for 0 and denormals.
HWY_INLINE V Log2Within(V x) {
    return Log2(d, hn::Max(x, Number(kSmallestLuminance)));
}

/// x^exponent for x >= 0, exponent > 0.
HWY_INLINE V Power(V x, float exponent) {
    const V y = Exp2Within(hn::Mul(Number(exponent), Log2Within(x)));
    return hn::IfThenElseZero(hn::Gt(x, hn::Zero(d)), y);
}

struct RationalLanes {
    float k[6];
    explicit RationalLanes(const CurveNumbers& curve) {
        for (size_t i = 0; i < 6; ++i)
            k[i] = float(curve.p[i]);
    }
    HWY_INLINE V operator()(V x) const { return Rational(k, x); }
};

struct LogarithmicLanes {
    float scale;
    explicit LogarithmicLanes(const CurveNumbers& curve)
        : scale(float(std::log(2.0) / std::log1p(curve.p[0]))) {}
    HWY_INLINE V operator()(V x) const { return hn::Mul(Number(scale), Log2OfOnePlus(d, x)); }
};

struct ExponentialLanes {
    float scale;
    explicit ExponentialLanes(const CurveNumbers& curve)
        : scale(float(-1 / (curve.p[0] * std::log(2.0)))) {}
    HWY_INLINE V operator()(V x) const {
        const V power = hn::Max(hn::Mul(Number(scale), x), Number(-126.0f));
        return hn::Neg(Exp2LessOne(d, power));
    }
};

struct DragoLanes {
    float scale, white, share, exponent;
    explicit DragoLanes(const CurveNumbers& curve)
        : scale(float(std::log(10.0) / std::log1p(curve.p[0]))),
          white(float(curve.p[0])),
          share(float(1 / curve.p[0])),
          exponent(float(std::log(curve.p[1]) / std::log(0.5))) {}
    HWY_INLINE V operator()(V x) const {
        x = hn::Min(x, Number(white));
        const V log_share = Log2Within(hn::Mul(x, Number(share)));
        const V bias = Exp2Within(hn::Mul(Number(exponent), log_share));
        const V down = Log2(d, hn::MulAdd(Number(8.0f), bias, Number(2.0f)));
        return hn::Div(hn::Mul(Number(scale), Log2OfOnePlus(d, x)), down);
    }
};

struct FilmicAluLanes {
    float black, k[6];
    explicit FilmicAluLanes(const CurveNumbers& curve)
        : black(float(curve.p[0])),
          k{float(curve.p[1]), float(curve.p[2]), 0.0f,
            float(curve.p[1]), float(curve.p[3]), float(curve.p[4])} {}
    HWY_INLINE V operator()(V x) const {
        const V y = hn::Max(hn::Sub(x, Number(black)), hn::Zero(d));
        return Power(Rational(k, y), float(kDisplayGamma));
    }
};

// x^a / (b x^(a d) + c) = 1 / (b x^(a d - a) + c x^-a): the first exponent is small, and with it
// the error of the logarithm.
struct LottesLanes {
    float slow, fast, b, c;
    explicit LottesLanes(const CurveNumbers& curve)
        : slow(float(curve.p[0] * (curve.p[1] - 1))),
          fast(float(-curve.p[0])),
          b(float(curve.p[2])),
          c(float(curve.p[3])) {}
    HWY_INLINE V operator()(V x) const {
        const V log_x = Log2Within(x);
        const V shoulder = hn::Mul(Number(b), Exp2Within(hn::Mul(Number(slow), log_x)));
        const V toe = Exp2Within(hn::Mul(Number(fast), log_x));
        const V y = hn::Div(Number(1.0f), hn::MulAdd(Number(c), toe, shoulder));
        return hn::IfThenElseZero(hn::Gt(x, hn::Zero(d)), y);
    }
};

struct UchimuraLanes {
    float peak, slope, start, share, toe, pedestal, end, rest, decay;
    explicit UchimuraLanes(const CurveNumbers& curve) {
        const double a = curve.p[1], m = curve.p[2];
        const double length = (curve.p[0] - m) * curve.p[3] / a;
        const double left = curve.p[0] - m - a * length;
        peak = float(curve.p[0]);
        slope = float(a);
        start = float(m);
        share = float(1 / m);
        toe = float(curve.p[4]);
        pedestal = float(curve.p[5]);
        end = float(m + length);
        rest = float(left);
        decay = float(-a / (left * std::log(2.0)));
    }
    HWY_INLINE V operator()(V x) const {
        const V one = Number(1.0f), u = hn::Mul(x, Number(share)), v = hn::Min(u, one);
        const V line_share = hn::Mul(hn::Mul(v, v), hn::NegMulAdd(Number(2.0f), v, Number(3.0f)));
        const V line = hn::MulAdd(Number(slope), hn::Sub(x, Number(start)), Number(start));
        const V low = hn::MulAdd(Number(start), Power(u, toe), Number(pedestal));
        const V below = hn::MulAdd(low, hn::Sub(one, line_share), hn::Mul(line, line_share));
        const V past = hn::Max(hn::Sub(x, Number(end)), hn::Zero(d));
        const V above =
            hn::NegMulAdd(Number(rest), Exp2Within(hn::Mul(Number(decay), past)), Number(peak));
        return hn::IfThenElse(hn::Ge(x, Number(end)), above, below);
    }
};

struct MatrixLanes {
    float m[3][3];
    explicit MatrixLanes(const Matrix3& matrix) {
        for (size_t i = 0; i < 9; ++i)
            m[i / 3][i % 3] = float(matrix[i / 3][i % 3]);
    }
    HWY_INLINE V Row(const float (&row)[3], const Color& v) const {
        const V two = hn::MulAdd(Number(row[1]), v.c1, hn::Mul(Number(row[0]), v.c0));
        return hn::MulAdd(Number(row[2]), v.c2, two);
    }
    HWY_INLINE Color operator()(const Color& v) const {
        return {Row(m[0], v), Row(m[1], v), Row(m[2], v)};
    }
};

struct AcesHillLanes {
    MatrixLanes in{kAcesHillIn}, out{kAcesHillOut};
    RationalLanes curve;
    explicit AcesHillLanes(const CurveNumbers& numbers) : curve(numbers) {}
    HWY_INLINE Color operator()(const Color& x) const {
        const Color v = in(x);
        return out({curve(v.c0), curve(v.c1), curve(v.c2)});
    }
};

struct AgxLanes {
    MatrixLanes in{kAgxIn}, out{kAgxOut};
    float sigmoid[7];
    // About its middle the polynomial's large terms do not cancel.
    explicit AgxLanes(const CurveNumbers&) {
        auto c = kAgxSigmoid;
        for (size_t i = 0; i < 6; ++i)
            for (size_t j = 6; j-- > i;)
                c[j] += 0.5 * c[j + 1];
        for (size_t i = 0; i < 7; ++i)
            sigmoid[i] = float(c[i]);
    }
    HWY_INLINE V Encoded(V x) const {
        constexpr double range = kAgxHighest - kAgxLowest;
        const V stops =
            hn::Min(hn::Max(Log2Within(x), Number(float(kAgxLowest))), Number(float(kAgxHighest)));
        const V t =
            hn::MulAdd(stops, Number(float(1 / range)), Number(float(-kAgxLowest / range - 0.5)));
        V y = Number(sigmoid[6]);
        for (size_t i = 6; i-- > 0;)
            y = hn::MulAdd(y, t, Number(sigmoid[i]));
        return y;
    }
    HWY_INLINE Color operator()(const Color& x) const {
        const Color v = in(x);
        const Color y = out({Encoded(v.c0), Encoded(v.c1), Encoded(v.c2)});
        return {Decoded(y.c0), Decoded(y.c1), Decoded(y.c2)};
    }
    HWY_INLINE V Decoded(V y) const { return Power(y, float(kDisplayGamma)); }
};

struct NeutralLanes {
    explicit NeutralLanes(const CurveNumbers&) {}
    HWY_INLINE Color operator()(const Color& x) const {
        const V one = Number(1.0f), start = Number(float(kNeutralStart));
        const V low = hn::Min(x.c0, hn::Min(x.c1, x.c2));
        const V toe = hn::NegMulAdd(hn::Mul(Number(float(kNeutralSquare)), low), low, low);
        const V offset = hn::IfThenElse(hn::Lt(low, Number(float(kNeutralToe))), toe,
                                        Number(float(kNeutralFresnel)));
        const Color v = {hn::Sub(x.c0, offset), hn::Sub(x.c1, offset), hn::Sub(x.c2, offset)};
        // Below the start of the compression this is the identity: scale 1, nothing mixed with
        // grey.
        const V peak = hn::Max(hn::Max(v.c0, hn::Max(v.c1, v.c2)), start);
        constexpr double room = 1 - kNeutralStart;
        const V pressed = hn::Sub(one, hn::Div(Number(float(room * room)),
                                               hn::Add(hn::Sub(peak, start), Number(float(room)))));
        const V above = hn::Sub(peak, pressed);
        const V kept = hn::Div(one, hn::MulAdd(Number(float(kNeutralDesaturation)), above, one));
        const V scale = hn::Mul(hn::Div(pressed, peak), kept);
        const V grey = hn::NegMulAdd(pressed, kept, pressed);
        return {hn::MulAdd(v.c0, scale, grey), hn::MulAdd(v.c1, scale, grey),
                hn::MulAdd(v.c2, scale, grey)};
    }
};

// 10^-(range / (1 + (x / middle)^power)); the quotient first, as its logarithm is exact where the
// curve is steep.
struct FilmLanes {
    float share[3], power[3], range[3];
    explicit FilmLanes(const CurveNumbers& curve) {
        for (size_t c = 0; c < 3; ++c) {
            const double* p = &curve.p[4 * c];
            share[c] = float(1 / p[0]);
            power[c] = float(4 * p[1] / ((p[3] - p[2]) * std::log(10.0)));
            range[c] = float(-(p[3] - p[2]) * std::log2(10.0));
        }
    }
    HWY_INLINE V Channel(size_t c, V x) const {
        const V rise = Power(hn::Mul(x, Number(share[c])), power[c]);
        return Exp2Within(hn::Div(Number(range[c]), hn::Add(Number(1.0f), rise)));
    }
    HWY_INLINE V operator()(V x) const { return Channel(0, x); }
    HWY_INLINE Color operator()(const Color& x) const {
        return {Channel(0, x.c0), Channel(1, x.c1), Channel(2, x.c2)};
    }
};

// The row at or below x by bisection, then its line.
struct TableLanes {
    const float* knots;
    const float *values[3], *slopes[3];
    int half;
    bool log2;
    explicit TableLanes(const CurveNumbers& curve)
        : knots(curve.table->knots()),
          half(int(curve.table->entries() / 2)),
          log2(curve.table->rows().log2) {
        for (size_t c = 0; c < 3; ++c) {
            values[c] = curve.table->values(c);
            slopes[c] = curve.table->slopes(c);
        }
    }
    HWY_INLINE V Channel(size_t c, V x) const {
        const hn::RebindToSigned<decltype(d)> di;
        if (log2)
            x = Log2Within(x);
        x = hn::Max(x, Number(knots[0]));
        auto at = hn::Zero(di);
        for (int step = half; step > 0; step /= 2) {
            const auto next = hn::Add(at, hn::Set(di, step));
            const auto below = hn::Le(hn::GatherIndex(d, knots, next), x);
            at = hn::IfThenElse(hn::RebindMask(di, below), next, at);
        }
        const V run = hn::Sub(x, hn::GatherIndex(d, knots, at));
        return hn::MulAdd(hn::GatherIndex(d, slopes[c], at), run,
                          hn::GatherIndex(d, values[c], at));
    }
    HWY_INLINE V operator()(V x) const { return Channel(0, x); }
    HWY_INLINE Color operator()(const Color& x) const {
        return {Channel(0, x.c0), Channel(1, x.c1), Channel(2, x.c2)};
    }
};

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
