// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/footprint_rows.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/footprint_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/color-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Int = hn::RebindToSigned<D>;

HWY_INLINE V Number(float v) {
    return hn::Set(d, v);
}

bool IsSurface(const GuidePlanes& image, ptrdiff_t i) {
    bool all = !(image.background && image.background[i] != 0);
    for (const float* plane : image.position)
        all = all && std::abs(plane[i]) <= kFarthestPosition; // false for NaN
    return all;
}

void FillMargins(float* row, int width) {
    std::fill_n(row - kFootprintMargin, kFootprintMargin, kUnknown);
    std::fill_n(row + width, kFootprintMargin, kUnknown);
}

// A vector of pixels from i on.
HWY_INLINE void CleanVector(const GuidePlanes& image, ptrdiff_t i, float* const to[3], int x) {
    const hn::Rebind<uint8_t, D> bytes;
    const Int di;
    const V far = Number(kFarthestPosition);
    const V p[3] = {hn::LoadU(d, image.position[0] + i), hn::LoadU(d, image.position[1] + i),
                    hn::LoadU(d, image.position[2] + i)};
    auto surface = hn::And(hn::Le(hn::Abs(p[0]), far),
                           hn::And(hn::Le(hn::Abs(p[1]), far), hn::Le(hn::Abs(p[2]), far)));
    if (image.background) {
        const auto none = hn::PromoteTo(di, hn::LoadU(bytes, image.background + i));
        surface = hn::And(surface, hn::RebindMask(d, hn::Eq(none, hn::Zero(di))));
    }
    for (size_t c = 0; c < 3; ++c)
        hn::StoreU(hn::IfThenElse(surface, p[c], Number(kUnknown)), d, to[c] + x);
}

void Clean(const GuidePlanes& image, int y, float* const to[3]) {
    const bool outside = y < 0 || y >= image.height;
    for (size_t c = 0; c < 3; ++c) {
        FillMargins(to[c], image.width);
        if (outside)
            std::fill_n(to[c], image.width, kUnknown);
    }
    if (outside)
        return;
    const ptrdiff_t at = (y - image.first_row) * image.stride;
    const auto lanes = int(hn::Lanes(d));
    int x = 0;
    for (; x + lanes <= image.width; x += lanes)
        CleanVector(image, at + x, to, x);
    for (; x < image.width; ++x)
        for (size_t c = 0; c < 3; ++c)
            to[c][x] = IsSurface(image, at + x) ? image.position[c][at + x] : kUnknown;
}

// Squared distance in space; infinite where one of the two is background.
HWY_INLINE V SquaredStep(const float* const (&a)[3], const float* const (&b)[3], int x, int dx) {
    V sum = hn::Zero(d);
    for (size_t c = 0; c < 3; ++c) {
        const V step = hn::Sub(hn::LoadU(d, a[c] + x), hn::LoadU(d, b[c] + x + dx));
        sum = hn::MulAdd(step, step, sum);
    }
    return hn::IfThenElse(hn::IsFinite(sum), sum, Number(kInfinity));
}

void Raw(const float* const (&rows)[3][3], int width, float* to) {
    const auto lanes = int(hn::Lanes(d));
    for (int x = 0; x < width; x += lanes) {
        const V along_x =
            hn::Min(SquaredStep(rows[1], rows[1], x, -1), SquaredStep(rows[1], rows[1], x, 1));
        const V along_y =
            hn::Min(SquaredStep(rows[1], rows[0], x, 0), SquaredStep(rows[1], rows[2], x, 0));
        const V less = hn::Sqrt(hn::Min(along_x, along_y));
        const V more = hn::Sqrt(hn::Max(along_x, along_y));
        const V both = hn::Sqrt(hn::Mul(less, more));
        const V step = hn::IfThenElse(hn::IsFinite(more), both, less);
        const auto known = hn::And(hn::IsFinite(step), hn::Gt(step, hn::Zero(d)));
        hn::StoreU(hn::IfThenElse(known, step, Number(kUnknown)), d, to + x);
    }
    FillMargins(to, width); // also over what the last vector wrote beyond
}

// Whether all that is known around a vector of pixels is within the spread of them, so that their
// medians are, too: nearly everywhere.
HWY_INLINE bool AllAlike(const float* const (&raw)[2 * kFootprintReach + 1], int x, V center) {
    V least = center, most = center;
    for (const float* row : raw)
        for (int dx = -kFootprintReach; dx <= kFootprintReach; ++dx) {
            const V other = hn::LoadU(d, row + x + dx);
            const V known = hn::IfThenElse(hn::Eq(other, other), other, center);
            least = hn::Min(least, known);
            most = hn::Max(most, known);
        }
    const auto low = hn::Ge(least, hn::Mul(center, Number(1 / kFootprintSpread)));
    return hn::AllTrue(d, hn::And(low, hn::Le(most, hn::Mul(center, Number(kFootprintSpread)))));
}

// Counting what is below a quarter and up to four times a footprint is much faster than finding
// the median that lies between.
HWY_INLINE hn::Mask<D> NearMedian(const float* const (&raw)[2 * kFootprintReach + 1], int x,
                                  V center) {
    const V one = Number(1), low = hn::Mul(center, Number(1 / kFootprintSpread));
    const V high = hn::Mul(center, Number(kFootprintSpread));
    V known = hn::Zero(d), below = hn::Zero(d), up_to = hn::Zero(d);
    for (const float* row : raw)
        for (int dx = -kFootprintReach; dx <= kFootprintReach; ++dx) {
            const V other = hn::LoadU(d, row + x + dx);
            known = hn::Add(known, hn::IfThenElseZero(hn::Gt(other, hn::Zero(d)), one));
            below = hn::Add(below, hn::IfThenElseZero(hn::Lt(other, low), one));
            up_to = hn::Add(up_to, hn::IfThenElseZero(hn::Le(other, high), one));
        }
    const V middle = hn::Floor(hn::Mul(known, Number(0.5f)));
    return hn::And(hn::Le(below, middle), hn::Gt(up_to, middle));
}

void Settle(const float* const (&raw)[2 * kFootprintReach + 1], const float* const row[3],
            float step, int width, float* to) {
    const auto lanes = int(hn::Lanes(d));
    for (int x = 0; x < width; x += lanes) {
        const V center = hn::LoadU(d, raw[kFootprintReach] + x);
        V most = hn::Abs(hn::LoadU(d, row[0] + x));
        const auto surface = hn::Le(most, Number(kFarthestPosition));
        for (size_t c = 1; c < 3; ++c)
            most = hn::Max(most, hn::Abs(hn::LoadU(d, row[c] + x)));
        const V least = hn::Mul(most, Number(step));
        V settled = hn::Max(center, least);
        if (!AllAlike(raw, x, center))
            settled = hn::IfThenElse(NearMedian(raw, x, center), settled, Number(kNotSettled));
        hn::StoreU(hn::IfThenElseZero(surface, settled), d, to + x);
    }
}

const FootprintRows& FootprintTable() {
    static const FootprintRows table = {hwy::TargetName(HWY_TARGET), Clean, Raw, Settle};
    return table;
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(FootprintTable);

const FootprintRows& footprint_rows() {
    return HWY_DYNAMIC_DISPATCH(FootprintTable)();
}

} // namespace tonetool::kernels
#endif
