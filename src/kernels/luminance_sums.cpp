// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/luminance_sums.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/luminance_sums.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/curves-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kLargest = std::numeric_limits<float>::max();
constexpr double kLn2 = 0.693147180559945309417232121458;

// Sums of values up to the largest of float are floats.
constexpr float kScale = 1.0f / (1 << 24);

// Twice the digits of float: what an addition rounds off is added up beside it (D. E. Knuth, "The
// Art of Computer Programming", volume 2, section 4.2.2, theorem B).
struct Sum {
    V high, low;

    HWY_INLINE Sum() : high(hn::Zero(d)), low(hn::Zero(d)) {}

    HWY_INLINE void Add(V v) {
        const V sum = hn::Add(high, v);
        const V added = hn::Sub(sum, high);
        const V lost = hn::Add(hn::Sub(high, hn::Sub(sum, added)), hn::Sub(v, added));
        low = hn::Add(low, lost);
        high = sum;
    }

    HWY_ATTR double Total() const {
        alignas(64) float lanes[2][hn::MaxLanes(d)];
        hn::Store(high, d, lanes[0]);
        hn::Store(low, d, lanes[1]);
        double sum = 0;
        for (size_t i = 0; i < hn::Lanes(d); ++i)
            sum += double(lanes[0][i]) + double(lanes[1][i]);
        return sum;
    }
};

struct LuminanceLanes {
    Sum values, logs, reciprocals, counted;
    V most;

    HWY_INLINE LuminanceLanes() : most(hn::Zero(d)) {}

    HWY_INLINE void Add(V v, V epsilon) {
        const auto valid = hn::And(hn::Ge(v, hn::Zero(d)), hn::Le(v, Number(kLargest)));
        const V one = Number(1), x = hn::IfThenElseZero(valid, v);
        const V raised = hn::Min(hn::Add(x, epsilon), Number(kLargest));
        values.Add(hn::Mul(x, Number(kScale)));
        logs.Add(hn::IfThenElseZero(valid, Log2Within(raised)));
        reciprocals.Add(hn::IfThenElseZero(valid, hn::Div(one, raised)));
        counted.Add(hn::IfThenElseZero(valid, one));
        most = hn::Max(most, x);
    }
};

LuminanceSums SumsOfRow(const float* luminance, ptrdiff_t count, float epsilon) {
    const auto lanes = ptrdiff_t(hn::Lanes(d));
    const V raise = Number(epsilon);
    LuminanceLanes sums;
    ptrdiff_t i = 0;
    for (; i + lanes <= count; i += lanes)
        sums.Add(hn::LoadU(d, luminance + i), raise);
    if (i < count) {
        alignas(64) float rest[hn::MaxLanes(d)];
        std::fill_n(rest, hn::MaxLanes(d), -1.0f);
        std::copy(luminance + i, luminance + count, rest);
        sums.Add(hn::Load(d, rest), raise);
    }
    return {int64_t(sums.counted.Total()), sums.values.Total() / double(kScale),
            sums.logs.Total() * kLn2, sums.reciprocals.Total(),
            hn::GetLane(hn::MaxOfLanes(d, sums.most))};
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(SumsOfRow);

LuminanceSums luminance_sums(const float* luminance, ptrdiff_t count, float epsilon) {
    return HWY_DYNAMIC_DISPATCH(SumsOfRow)(luminance, count, epsilon);
}

} // namespace tonetool::kernels
#endif
