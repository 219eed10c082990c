// SPDX-License-Identifier: BSD-3-Clause
// Colours in SIMD lanes. Included once per target.
#if defined(TONETOOL_KERNELS_COLOR_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TONETOOL_KERNELS_COLOR_INL_H_
#undef TONETOOL_KERNELS_COLOR_INL_H_
#else
#define TONETOOL_KERNELS_COLOR_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
constexpr D d{};

struct Color {
    V c0, c1, c2;
};

HWY_INLINE V Clamp01(V v) {
    return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0f));
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
