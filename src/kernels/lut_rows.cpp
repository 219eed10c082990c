// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "kernels/flip_constants.h"
#include "kernels/flip_rows.h"
#include "kernels/lut_rows.h"
#include "kernels/tone_curve.h"
#include "kernels/whole_vectors.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/lut_rows.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/color-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using I = hn::RebindToSigned<D>;
constexpr I di{};

struct CubeLookup {
    const float* table;
    int size;
    float scale, pivot, cells, last_place, last_cell;

    CubeLookup(const LightCube& cube, float by)
        : table(cube.vertex(0, 0, 0)),
          size(cube.shape().size),
          scale(by),
          pivot(float(std::pow(cube.shape().pivot, cube.shape().steep ? 0.75 : 0.5))),
          cells(float((size - 1) / cube.share(cube.shape().brightest))),
          last_place(float(size - 1)),
          last_cell(float(size - 2)) {}
};

// Where the vertices of a tetrahedron are, and their weights.
struct Corners {
    alignas(64) int32_t first[HWY_MAX_BYTES / 4], second[HWY_MAX_BYTES / 4];
    alignas(64) int32_t third[HWY_MAX_BYTES / 4];
    alignas(64) float weight[4][HWY_MAX_BYTES / 4];
};

template <bool kSteep>
HWY_INLINE V Place(const CubeLookup& cube, V x) {
    const V light = hn::Min(hn::Mul(x, hn::Set(d, cube.scale)), hn::Set(d, kLargestExposed));
    V power = hn::Sqrt(light);
    if constexpr (kSteep)
        power = hn::Sqrt(hn::Mul(light, power));
    const V share = hn::Div(power, hn::Add(power, hn::Set(d, cube.pivot)));
    const V place = hn::Mul(share, hn::Set(d, cube.cells));
    // NaN is 0 too, lest it be an address.
    return hn::IfThenElseZero(hn::Gt(place, hn::Zero(d)),
                              hn::Min(place, hn::Set(d, cube.last_place)));
}

HWY_INLINE V Cell(const CubeLookup& cube, V place) {
    const V cell = hn::ConvertTo(d, hn::ConvertTo(di, place));
    return hn::Min(cell, hn::Set(d, cube.last_cell));
}

HWY_INLINE void FindCorners(const CubeLookup& cube, V r, V g, V b, Corners& corners) {
    const V r_cell = Cell(cube, r), g_cell = Cell(cube, g), b_cell = Cell(cube, b);
    r = hn::Sub(r, r_cell);
    g = hn::Sub(g, g_cell);
    b = hn::Sub(b, b_cell);
    const V low = hn::Min(r, g), high = hn::Max(r, g);
    const V least = hn::Min(low, b), most = hn::Max(high, b);
    const V middle = hn::Max(low, hn::Min(high, b));
    hn::Store(hn::Sub(hn::Set(d, 1.0f), most), d, corners.weight[0]);
    hn::Store(hn::Sub(most, middle), d, corners.weight[1]);
    hn::Store(hn::Sub(middle, least), d, corners.weight[2]);
    hn::Store(least, d, corners.weight[3]);
    // Exact: a table has fewer than 2^24 floats.
    const V size = hn::Set(d, float(cube.size));
    const V index = hn::MulAdd(hn::MulAdd(r_cell, size, g_cell), size, b_cell);
    const auto first = hn::ShiftLeft<2>(hn::ConvertTo(di, index));
    const V b_step = hn::Set(d, 4.0f), g_step = hn::Set(d, 4.0f * float(cube.size));
    const V r_step = hn::Set(d, 4.0f * float(cube.size) * float(cube.size));
    const V all = hn::Add(r_step, hn::Add(g_step, b_step));
    const V up =
        hn::IfThenElse(hn::Eq(r, most), r_step, hn::IfThenElse(hn::Eq(g, most), g_step, b_step));
    const V down =
        hn::IfThenElse(hn::Eq(b, least), b_step, hn::IfThenElse(hn::Eq(g, least), g_step, r_step));
    hn::Store(first, di, corners.first);
    hn::Store(hn::Add(first, hn::ConvertTo(di, up)), di, corners.second);
    hn::Store(hn::Add(first, hn::ConvertTo(di, hn::Sub(all, down))), di, corners.third);
}

HWY_INLINE V Decode(V code) {
    const V cube = hn::Mul(hn::Mul(code, code), code);
    const V line =
        hn::Mul(hn::Sub(code, hn::Set(d, float(kLabOffset))), hn::Set(d, float(1 / kLabSlope)));
    return Clamp01(hn::IfThenElse(hn::Gt(cube, hn::Set(d, float(kLabKnee))), cube, line));
}

#if HWY_TARGET == HWY_SCALAR
HWY_INLINE Color Interpolate(const CubeLookup& cube, const Corners& corners, ptrdiff_t last) {
    const float* a = cube.table + corners.first[0];
    const float* vertices[4] = {a, cube.table + corners.second[0], cube.table + corners.third[0],
                                a + last};
    float sum[3] = {};
    for (int c = 0; c < 3; ++c)
        for (int v = 0; v < 4; ++v)
            sum[c] += corners.weight[v][0] * vertices[v][c];
    return {hn::Set(d, sum[0]), hn::Set(d, sum[1]), hn::Set(d, sum[2])};
}
#else
// A vertex is a register of four: pixel by pixel, then into lanes.
HWY_INLINE Color Interpolate(const CubeLookup& cube, const Corners& corners, ptrdiff_t last) {
    const hn::Full128<float> four;
    alignas(64) float colors[HWY_MAX_BYTES];
    for (size_t i = 0; i < hn::Lanes(d); ++i) {
        const float* first = cube.table + corners.first[i];
        auto sum = hn::Mul(hn::Set(four, corners.weight[0][i]), hn::Load(four, first));
        sum = hn::MulAdd(hn::Set(four, corners.weight[1][i]),
                         hn::Load(four, cube.table + corners.second[i]), sum);
        sum = hn::MulAdd(hn::Set(four, corners.weight[2][i]),
                         hn::Load(four, cube.table + corners.third[i]), sum);
        sum = hn::MulAdd(hn::Set(four, corners.weight[3][i]), hn::Load(four, first + last), sum);
        hn::Store(sum, four, colors + 4 * i);
    }
    Color color;
    V unused;
    hn::LoadInterleaved4(d, colors, color.c0, color.c1, color.c2, unused);
    return color;
}
#endif

template <bool kSteep>
void MapPixels(const CubeLookup& cube, const float* const in[3], float* const out[3],
               ptrdiff_t count) {
    const ptrdiff_t last = 4 * (ptrdiff_t(cube.size) * cube.size + cube.size + 1);
    Corners corners;
    for (ptrdiff_t i = 0; i < count; i += ptrdiff_t(hn::Lanes(d))) {
        FindCorners(cube, Place<kSteep>(cube, hn::LoadU(d, in[0] + i)),
                    Place<kSteep>(cube, hn::LoadU(d, in[1] + i)),
                    Place<kSteep>(cube, hn::LoadU(d, in[2] + i)), corners);
        const Color color = Interpolate(cube, corners, last);
        hn::StoreU(Decode(color.c0), d, out[0] + i);
        hn::StoreU(Decode(color.c1), d, out[1] + i);
        hn::StoreU(Decode(color.c2), d, out[2] + i);
    }
}

void MapRows(const LightCube& table, const float* const in[3], float* const out[3], ptrdiff_t count,
             float scale) {
    const CubeLookup cube(table, scale);
    if (table.shape().steep)
        MapPixels<true>(cube, in, out, count);
    else
        MapPixels<false>(cube, in, out, count);
}

ptrdiff_t LanesHere() {
    return ptrdiff_t(hn::Lanes(d));
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(MapRows);
HWY_EXPORT(LanesHere);

void light_cube_rows(const LightCube& cube, const float* const in[3], float* const out[3],
                     ptrdiff_t count, float scale) {
    in_whole_vectors(in, out, count, HWY_DYNAMIC_DISPATCH(LanesHere)(),
                     [&](const float* const from[3], float* const to[3], ptrdiff_t n) {
                         HWY_DYNAMIC_DISPATCH(MapRows)(cube, from, to, n, scale);
                     });
}

} // namespace tonetool::kernels
#endif
