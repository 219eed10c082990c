// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/noise_rows.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/noise_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/color-inl.h"
#include "kernels/fast_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr float kLog2OfE = 1.4426950408889634f;

// Pixels of a row from a place on, all of whose neighbours are in the row.
struct InnerPixels {
    ptrdiff_t at;
    HWY_INLINE V Load(const float* row, ptrdiff_t away) const {
        return hn::LoadU(d, row + at + away);
    }
    HWY_INLINE V Load(const uint8_t* row, ptrdiff_t away) const {
        const hn::Rebind<uint8_t, D> bytes;
        const hn::RebindToSigned<D> di;
        const auto is_set =
            hn::Ne(hn::PromoteTo(di, hn::LoadU(bytes, row + at + away)), hn::Zero(di));
        return hn::IfThenElseZero(hn::RebindMask(d, is_set), hn::Set(d, 1.0f));
    }
};

// Beyond its ends there is the last pixel again.
struct OuterPixels {
    ptrdiff_t at, width;
    HWY_INLINE V Load(const float* row, ptrdiff_t away) const {
        alignas(64) float buffer[hn::MaxLanes(d)];
        for (ptrdiff_t i = 0; i < ptrdiff_t(hn::Lanes(d)); ++i)
            buffer[i] = row[std::clamp<ptrdiff_t>(at + i + away, 0, width - 1)];
        return hn::Load(d, buffer);
    }
    HWY_INLINE V Load(const uint8_t* row, ptrdiff_t away) const {
        alignas(64) float buffer[hn::MaxLanes(d)];
        for (ptrdiff_t i = 0; i < ptrdiff_t(hn::Lanes(d)); ++i)
            buffer[i] = row[std::clamp<ptrdiff_t>(at + i + away, 0, width - 1)] != 0 ? 1.0f : 0.0f;
        return hn::Load(d, buffer);
    }
};

// The row and those above and below it, as offsets into a plane.
struct NoiseLanes {
    const GuidePlanes& image;
    ptrdiff_t above, here, below;

    NoiseLanes(const GuidePlanes& planes, int y) : image(planes) {
        const auto row = [&](int at) {
            return (std::clamp(at, 0, planes.height - 1) - planes.first_row) * planes.stride;
        };
        above = row(y - 1);
        here = row(y);
        below = row(y + 1);
    }

    // Calls visit(pixel, neighbour) on the four neighbours of each pixel of a plane.
    template <class Pixels, class T, class Visit>
    HWY_INLINE void Neighbours(const Pixels& at, const T* plane, const Visit& visit) const {
        const V pixel = at.Load(plane + here, 0);
        visit(pixel, at.Load(plane + here, -1));
        visit(pixel, at.Load(plane + here, 1));
        visit(pixel, at.Load(plane + above, 0));
        visit(pixel, at.Load(plane + below, 0));
    }

    template <class Pixels, class T>
    HWY_INLINE V AddSquaredSteps(const Pixels& at, const T* plane, float scale, V sum) const {
        V steps = hn::Zero(d);
        Neighbours(at, plane, [&](V pixel, V other) HWY_ATTR {
            const V step = hn::Sub(pixel, other);
            steps = hn::MulAdd(step, step, steps);
        });
        return hn::NegMulAdd(steps, hn::Set(d, scale), sum);
    }

    template <class Pixels>
    HWY_INLINE void operator()(const Pixels& at, float* flat, float* square) const {
        V sum = hn::Zero(d), pixels = hn::Zero(d);
        Neighbours(at, image.value, [&](V pixel, V other) HWY_ATTR {
            sum = hn::Add(sum, other);
            pixels = pixel;
        });
        const V h = hn::NegMulAdd(sum, hn::Set(d, 0.25f), pixels), h2 = hn::Mul(h, h);
        constexpr double step2 = kFlatStep * kFlatStep;
        V exponent =
            hn::Mul(hn::Mul(h2, h2), hn::Set(d, float(-double(kLog2OfE) / (step2 * step2))));
        constexpr float of_normal = float(double(kLog2OfE) / (2 * kFlatNormal * kFlatNormal));
        constexpr float of_albedo = float(double(kLog2OfE) / (2 * kFlatAlbedo * kFlatAlbedo));
        for (const auto& [planes, scale] :
             {std::pair{image.normal, of_normal}, std::pair{image.albedo, of_albedo}})
            for (int c = 0; c < 3; ++c)
                if (planes[c])
                    exponent = AddSquaredSteps(at, planes[c], scale, exponent);
        // Where surface and background meet nothing is flat.
        if (image.background)
            exponent = AddSquaredSteps(at, image.background, 1000.0f, exponent);
        const auto counts = hn::And(hn::IsFinite(h), hn::Gt(exponent, hn::Set(d, -126.0f)));
        const V weight = Exp2(d, hn::IfThenElseZero(counts, exponent));
        hn::StoreU(hn::IfThenElseZero(counts, weight), d, flat);
        hn::StoreU(hn::IfThenElseZero(counts, hn::Mul(weight, h2)), d, square);
    }
};

void NoiseRow(const GuidePlanes& image, int y, float* flat, float* square) {
    const auto lanes = ptrdiff_t(hn::Lanes(d));
    const NoiseLanes row(image, y);
    for (ptrdiff_t x = 0; x < image.width; x += lanes) {
        if (x > 0 && x + lanes < image.width) {
            row(InnerPixels{x}, flat + x, square + x);
            continue;
        }
        alignas(64) float buffer[2][hn::MaxLanes(d)];
        row(OuterPixels{x, image.width}, buffer[0], buffer[1]);
        const ptrdiff_t count = std::min<ptrdiff_t>(lanes, image.width - x);
        std::copy_n(buffer[0], count, flat + x);
        std::copy_n(buffer[1], count, square + x);
    }
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(NoiseRow);

void noise_row(const GuidePlanes& image, int y, float* flat, float* square) {
    HWY_DYNAMIC_DISPATCH(NoiseRow)(image, y, flat, square);
}

} // namespace tonetool::kernels
#endif
