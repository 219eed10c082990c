// Weights of the cross bilateral filter in lanes. Included once per target.
#if defined(TONETOOL_KERNELS_GUIDED_WEIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_GUIDED_WEIGHT_INL_H_
#undef TONETOOL_KERNELS_GUIDED_WEIGHT_INL_H_
#else
#define TONETOOL_KERNELS_GUIDED_WEIGHT_INL_H_
#endif

#include <hwy/highway.h>

#include "kernels/color-inl.h"
#include "kernels/guided_rows.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Where the background is, and on the other side what no pixel may be a neighbour of: so far that
/// weights are 0, and the squares of these distances are floats.
constexpr float kFarAway = 3e18f;

/// 2^x for x <= 0, exactly 0 below -127.5; relative error below 2.8e-6. The polynomial has the
/// least relative error for its degree.
HWY_INLINE V Weight2(V x) {
    const hn::RebindToSigned<D> di;
    x = hn::Max(x, hn::Set(d, -127.0f));
    const V whole = hn::Round(x), f = hn::Sub(x, whole);
    V p = hn::Set(d, 0.009570101908854097f);
    p = hn::MulAdd(p, f, hn::Set(d, 0.055917860321131746f));
    p = hn::MulAdd(p, f, hn::Set(d, 0.24024744827851016f));
    p = hn::MulAdd(p, f, hn::Set(d, 0.6931218147368339f));
    p = hn::MulAdd(p, f, hn::Set(d, 0.999999261445985f));
    // -127 gives the bits of 0.
    const auto bits = hn::Add(hn::ConvertTo(di, whole), hn::Set(di, 127));
    return hn::Mul(p, hn::BitCast(d, hn::ShiftLeft<23>(bits)));
}

/// One vector of pixels, against which others are weighed. Each combination of terms is a type, so
/// that the loop holds no branch.
template <bool kPosition, int kPlain, bool kAngle_, bool kRangeOfValue>
struct Terms {
    static constexpr bool kAngle = kAngle_;
    static constexpr int kWhere = kPosition ? 3 : 1, kFirstPlain = 1 + kWhere;
    static constexpr int kFirstAngle = kFirstPlain + kPlain;
    static constexpr int kNearness = kFirstAngle + (kAngle ? 3 : 0);

    V value, where[kWhere], plain[kPlain + 1], angle[3], nearness, slope, range;

    HWY_INLINE Terms(const GuidedLayout& layout, const GuidedScales& scales, const float* at) {
        const auto load = [&](int p) HWY_ATTR { return hn::LoadU(d, at + p * layout.pitch); };
        value = load(0);
        for (int i = 0; i < kWhere; ++i)
            where[i] = load(1 + i);
        for (int i = 0; i < kPlain; ++i)
            plain[i] = load(kFirstPlain + i);
        if constexpr (kAngle)
            for (int i = 0; i < 3; ++i)
                angle[i] = load(kFirstAngle + i);
        nearness = load(kNearness);
        slope = hn::Set(d, scales.angle);
        range = hn::Set(d, scales.range_of_value);
    }

    /// The weight of the pixels at `at`; `start` is log2 of the spatial one.
    HWY_INLINE V Weight(const float* HWY_RESTRICT at, ptrdiff_t pitch, float start,
                        V& neighbor) const {
        V away = hn::Sub(where[0], hn::LoadU(d, at + pitch)), square = hn::Mul(away, away);
        V x = hn::Set(d, start);
        if constexpr (kPosition) {
            away = hn::Sub(where[1], hn::LoadU(d, at + 2 * pitch));
            square = hn::MulAdd(away, away, square);
            away = hn::Sub(where[2], hn::LoadU(d, at + 3 * pitch));
            square = hn::MulAdd(away, away, square);
            x = hn::NegMulAdd(square, nearness, x);
        } else {
            x = hn::Sub(x, square);
        }
        for (int i = 0; i < kPlain; ++i) {
            const V step = hn::Sub(plain[i], hn::LoadU(d, at + (kFirstPlain + i) * pitch));
            x = hn::NegMulAdd(step, step, x);
        }
        if constexpr (kAngle) {
            V cosine = hn::Mul(angle[0], hn::LoadU(d, at + kFirstAngle * pitch));
            cosine = hn::MulAdd(angle[1], hn::LoadU(d, at + (kFirstAngle + 1) * pitch), cosine);
            cosine = hn::MulAdd(angle[2], hn::LoadU(d, at + (kFirstAngle + 2) * pitch), cosine);
            x = hn::MulAdd(hn::Abs(cosine), slope, x);
        }
        neighbor = hn::LoadU(d, at);
        if constexpr (kRangeOfValue) {
            const V step = hn::Sub(value, neighbor);
            x = hn::NegMulAdd(hn::Mul(step, step), range, x);
        }
        return Weight2(x);
    }
};

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
