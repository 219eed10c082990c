#include "kernels/flip_tile.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "kernels/flip_constants.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels/flip_tile.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file once per instruction set.
#include <hwy/highway.h>

#include "kernels/hunt_lab-inl.h"
#include "kernels/tone_curve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void ToneMapVectors(const float* const in[3], float* const out[3], int64_t count,
                    const ToneCurve& curve, float scale) {
    WithCurve(in, count, curve, scale, [out](int64_t i, const Color& c) HWY_ATTR {
        hn::StoreU(c.c0, d, out[0] + i);
        hn::StoreU(c.c1, d, out[1] + i);
        hn::StoreU(c.c2, d, out[2] + i);
    });
}

int64_t VectorLanes() {
    return int64_t(hn::Lanes(d));
}

// The opponent planes without the scale and offset of YCxCz: filters are linear and sum to 1.
void ToOpponent(const float* const in[3], int64_t count, const ToneCurve& curve, float scale,
                float* y, float* xy, float* yz) {
    const Matrix to_xyz = ToRelativeXyz();
    WithCurve(in, count, curve, scale, [&to_xyz, y, xy, yz](int64_t i, const Color& rgb) HWY_ATTR {
        const Color xyz = to_xyz(rgb);
        hn::StoreU(xyz.c1, d, y + i);
        hn::StoreU(hn::Sub(xyz.c0, xyz.c1), d, xy + i);
        hn::StoreU(hn::Sub(xyz.c1, xyz.c2), d, yz + i);
    });
}

// A plane at one vector of pixels: its neighbours `step` elements apart, in pairs, from which even
// filters take the sum and odd ones the difference.
struct Neighbours {
    const float* HWY_RESTRICT at;
    ptrdiff_t step;

    HWY_INLINE V Centre() const { return hn::LoadU(d, at); }
    HWY_INLINE V Sum(ptrdiff_t i) const {
        return hn::Add(hn::LoadU(d, at + i * step), hn::LoadU(d, at - i * step));
    }
    HWY_INLINE V Difference(ptrdiff_t i) const {
        return hn::Sub(hn::LoadU(d, at + i * step), hn::LoadU(d, at - i * step));
    }
};

HWY_INLINE V Add(V sum, float tap, V value) {
    return hn::MulAdd(hn::Set(d, tap), value, sum);
}

// Sums run from the outside in, so that the rounding of one is that of its last few terms.
HWY_INLINE V Even(const Neighbours& n, const std::vector<float>& taps) {
    V sum = hn::Zero(d);
    for (ptrdiff_t i = ptrdiff_t(taps.size()) - 1; i > 0; --i)
        sum = Add(sum, taps[size_t(i)], n.Sum(i));
    return Add(sum, taps[0], n.Centre());
}

struct TwoFilters {
    V first, second;
};

// Two even filters of one length on one plane.
HWY_INLINE TwoFilters EvenTwo(const Neighbours& n, const std::vector<float>& first,
                              const std::vector<float>& second) {
    V one = hn::Zero(d), two = hn::Zero(d);
    for (ptrdiff_t i = ptrdiff_t(first.size()) - 1; i > 0; --i) {
        const V pair = n.Sum(i);
        one = Add(one, first[size_t(i)], pair);
        two = Add(two, second[size_t(i)], pair);
    }
    const V centre = n.Centre();
    return {Add(one, first[0], centre), Add(two, second[0], centre)};
}

// The odd and the zero-sum detector on one plane. A filter whose taps sum to 0 is a sum over
// differences to the centre: a flat area gives exactly 0, which matters since the square root of
// the result enters the error.
HWY_INLINE TwoFilters Detectors(const Neighbours& n, const FlipTaps<float>& taps) {
    const V centre = n.Centre(), twice = hn::Add(centre, centre);
    V odd = hn::Zero(d), zero_sum = hn::Zero(d);
    for (ptrdiff_t i = ptrdiff_t(taps.d1.size()) - 1; i > 0; --i) {
        odd = Add(odd, taps.d1[size_t(i)], n.Difference(i));
        zero_sum = Add(zero_sum, taps.d2[size_t(i)], hn::Sub(n.Sum(i), twice));
    }
    return {odd, zero_sum};
}

// The x pass of one row: seven filters of three planes.
void FilterRow(const float* y, const float* xy, const float* yz, int width,
               const FlipTaps<float>& taps, float* const out[kRowPlanes]) {
    for (ptrdiff_t x = 0; x < width; x += ptrdiff_t(hn::Lanes(d))) {
        const Neighbours luminance{y + x, 1};
        const TwoFilters cz = EvenTwo({yz + x, 1}, taps.cz1, taps.cz2);
        const TwoFilters detectors = Detectors(luminance, taps);
        hn::StoreU(Even(luminance, taps.y), d, out[kRowY] + x);
        hn::StoreU(Even({xy + x, 1}, taps.cx), d, out[kRowCx] + x);
        hn::StoreU(cz.first, d, out[kRowCz1] + x);
        hn::StoreU(cz.second, d, out[kRowCz2] + x);
        hn::StoreU(Even(luminance, taps.g), d, out[kRowG] + x);
        hn::StoreU(detectors.first, d, out[kRowD1] + x);
        hn::StoreU(detectors.second, d, out[kRowD2] + x);
    }
}

HWY_INLINE V Magnitude(V a, V b) {
    return hn::Sqrt(hn::MulAdd(a, a, hn::Mul(b, b)));
}

// The y pass of one row of the tile, and everything per pixel up to the comparison.
void FilterColumns(const float* const rows[kRowPlanes], ptrdiff_t stride, int width,
                   const FlipTaps<float>& taps, float* const out[kFeaturePlanes]) {
    const Matrix to_xyz = ToRelativeXyz(), to_rgb = FromRelativeXyz();
    for (ptrdiff_t x = 0; x < width; x += ptrdiff_t(hn::Lanes(d))) {
        const auto plane = [rows, stride, x](RowPlane p) HWY_ATTR {
            return Neighbours{rows[p] + x, stride};
        };
        const V y = Even(plane(kRowY), taps.y);
        const V cx = Even(plane(kRowCx), taps.cx);
        const V cz = hn::Add(Even(plane(kRowCz1), taps.cz1), Even(plane(kRowCz2), taps.cz2));
        const Lab lab = HuntLab(to_xyz, to_rgb, y, cx, cz);
        hn::StoreU(lab.l.high, d, out[kLHigh] + x);
        hn::StoreU(lab.l.low, d, out[kLLow] + x);
        hn::StoreU(lab.a, d, out[kA] + x);
        hn::StoreU(lab.b, d, out[kB] + x);
        const TwoFilters down = Detectors(plane(kRowG), taps);
        const V edge = Magnitude(Even(plane(kRowD1), taps.g), down.first);
        const V point = Magnitude(Even(plane(kRowD2), taps.g), down.second);
        hn::StoreU(edge, d, out[kEdge] + x);
        hn::StoreU(point, d, out[kPoint] + x);
    }
}

// log2 of the colour difference of h > 0 after the remap of q = h^0.7.
HWY_INLINE V Log2ColorError(V h) {
    constexpr double knee = kKneeShare * kLargestQ;
    const V log2_q = hn::Mul(hn::Set(d, float(kColorExponent)), Log2(d, h));
    const V low = hn::Add(log2_q, hn::Set(d, float(std::log2(kKneeError / knee))));
    const auto above = hn::Ge(log2_q, hn::Set(d, float(std::log2(knee))));
    if (hn::AllFalse(d, above))
        return low;
    constexpr double slope = (1.0 - kKneeError) / (kLargestQ - knee);
    const V high = hn::MulAdd(Exp2(d, log2_q), hn::Set(d, float(slope)),
                              hn::Set(d, float(kKneeError - slope * knee)));
    return hn::IfThenElse(above, Log2(d, high), low);
}

HWY_INLINE V FlipError(const float* const r[kFeaturePlanes], const float* const t[kFeaturePlanes],
                       ptrdiff_t x) {
    const auto difference = [r, t, x](int plane) HWY_ATTR {
        return hn::Sub(hn::LoadU(d, r[plane] + x), hn::LoadU(d, t[plane] + x));
    };
    const V h = hn::Add(hn::Abs(hn::Add(difference(kLHigh), difference(kLLow))),
                        Magnitude(difference(kA), difference(kB)));
    const V feature =
        hn::Min(hn::Sqrt(hn::Mul(hn::Max(hn::Abs(difference(kEdge)), hn::Abs(difference(kPoint))),
                                 hn::Set(d, 0.70710678118654752f))),
                hn::Set(d, 1.0f));
    // E = color^(1 - feature), with the power as a product of logarithms.
    const V log2_color = Log2ColorError(hn::Max(h, hn::Set(d, 1e-30f)));
    const V error = Exp2(d, hn::Mul(hn::Sub(hn::Set(d, 1.0f), feature), log2_color));
    return hn::IfThenZeroElse(hn::Eq(h, hn::Zero(d)), error);
}

void CompareRow(const float* const r[kFeaturePlanes], const float* const t[kFeaturePlanes],
                int width, float n, float* best, float* index, float* error) {
    for (ptrdiff_t x = 0; x < width; x += ptrdiff_t(hn::Lanes(d))) {
        const V e = FlipError(r, t, x), old = hn::LoadU(d, best + x);
        const auto larger = hn::Gt(e, old);
        hn::StoreU(hn::IfThenElse(larger, e, old), d, best + x);
        hn::StoreU(hn::IfThenElse(larger, hn::Set(d, n), hn::LoadU(d, index + x)), d, index + x);
        if (error)
            hn::StoreU(e, d, error + x);
    }
}

const char* TargetName() {
    return hwy::TargetName(HWY_TARGET);
}

} // namespace tonetool::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tonetool::kernels {

HWY_EXPORT(ToneMapVectors);
HWY_EXPORT(VectorLanes);
HWY_EXPORT(ToOpponent);
HWY_EXPORT(FilterRow);
HWY_EXPORT(FilterColumns);
HWY_EXPORT(CompareRow);
HWY_EXPORT(TargetName);

namespace {

// Loops run over whole vectors: every row has this many floats to spare.
constexpr ptrdiff_t kSpare = 16;

ptrdiff_t round_up(ptrdiff_t n) {
    return (n + kSpare - 1) / kSpare * kSpare;
}

} // namespace

TileShape::TileShape(int tile_width, int tile_height, int tile_halo)
    : width(tile_width),
      height(tile_height),
      halo(tile_halo),
      stride(round_up(tile_width)),
      padded_stride(round_up(tile_width) + 2 * tile_halo + kSpare) {}

Planes::Planes(int count, ptrdiff_t stride, int rows)
    : m_data(hwy::AllocateAligned<float>(size_t(count * (stride * rows + kSpare)))),
      m_size(stride * rows + kSpare) {
    std::fill_n(m_data.get(), count * m_size, 0.0f);
}

TilePixels::TilePixels(const TileShape& shape, const ConstRgb& image, int x0, int y0)
    : rgb(3, shape.padded_stride, shape.padded_height()) {
    const int left = x0 - shape.halo, width = shape.padded_width();
    const int inside_from = std::clamp(-left, 0, width);
    const int inside_to = std::clamp(image.width - left, inside_from, width);
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < shape.padded_height(); ++y) {
            const int source_y = std::clamp(y0 - shape.halo + y, 0, image.height - 1);
            const float* in = image.plane[c] + (source_y - image.first_row) * image.stride;
            float* out = rgb[c] + y * shape.padded_stride;
            std::fill(out, out + inside_from, in[0]);
            std::copy(in + left + inside_from, in + left + inside_to, out + inside_from);
            std::fill(out + inside_to, out + width, in[image.width - 1]);
        }
}

bool TilePixels::same_as(const TilePixels& other) const {
    return std::memcmp(rgb[0], other.rgb[0], size_t(3 * rgb.size()) * sizeof(float)) == 0;
}

FlipTile::FlipTile(const TileShape& shape, const FlipTaps<float>& taps)
    : m_shape(shape),
      m_taps(taps),
      m_opponent(3, shape.padded_stride, shape.padded_height()),
      m_rows(kRowPlanes, shape.stride, shape.padded_height()) {}

void FlipTile::prepare(const TilePixels& pixels, const ToneCurve& curve, float scale,
                       Planes& features) {
    const auto filter_row = HWY_DYNAMIC_DISPATCH(FilterRow);
    const auto filter_columns = HWY_DYNAMIC_DISPATCH(FilterColumns);
    const float* in[3] = {pixels.rgb[0], pixels.rgb[1], pixels.rgb[2]};
    HWY_DYNAMIC_DISPATCH(ToOpponent)
    (in, m_shape.padded_stride * m_shape.padded_height(), curve, scale, m_opponent[0],
     m_opponent[1], m_opponent[2]);
    for (int y = 0; y < m_shape.padded_height(); ++y) {
        const ptrdiff_t at = y * m_shape.padded_stride + m_shape.halo;
        float* out[kRowPlanes];
        for (int p = 0; p < kRowPlanes; ++p)
            out[p] = m_rows[p] + y * m_shape.stride;
        filter_row(m_opponent[0] + at, m_opponent[1] + at, m_opponent[2] + at, m_shape.width,
                   m_taps, out);
    }
    for (int y = 0; y < m_shape.height; ++y) {
        const float* rows[kRowPlanes];
        float* out[kFeaturePlanes];
        for (int p = 0; p < kRowPlanes; ++p)
            rows[p] = m_rows[p] + (y + m_shape.halo) * m_shape.stride;
        for (int p = 0; p < kFeaturePlanes; ++p)
            out[p] = features[p] + y * m_shape.stride;
        filter_columns(rows, m_shape.stride, m_shape.width, m_taps, out);
    }
}

void FlipTile::compare(const Planes& reference, const Planes& test, float n, float* best,
                       float* index, float* error) const {
    const auto compare_row = HWY_DYNAMIC_DISPATCH(CompareRow);
    for (int y = 0; y < m_shape.height; ++y) {
        const ptrdiff_t at = y * m_shape.stride;
        const float* r[kFeaturePlanes];
        const float* t[kFeaturePlanes];
        for (int p = 0; p < kFeaturePlanes; ++p) {
            r[p] = reference[p] + at;
            t[p] = test[p] + at;
        }
        compare_row(r, t, m_shape.width, n, best + at, index + at, error ? error + at : nullptr);
    }
}

void tone_map_pixels(const float* const in[3], float* const out[3], int64_t count,
                     const ToneCurve& curve, float scale) {
    const auto run = HWY_DYNAMIC_DISPATCH(ToneMapVectors);
    const int64_t whole = count - count % HWY_DYNAMIC_DISPATCH(VectorLanes)();
    run(in, out, whole, curve, scale);
    if (whole == count)
        return;
    // The rest goes through the same instructions in a buffer of whole vectors.
    float rest[3][kSpare] = {};
    for (int c = 0; c < 3; ++c)
        std::copy(in[c] + whole, in[c] + count, rest[c]);
    float* at[3] = {rest[0], rest[1], rest[2]};
    run(at, at, count - whole, curve, scale);
    for (int c = 0; c < 3; ++c)
        std::copy(rest[c], rest[c] + (count - whole), out[c] + whole);
}

const char* flip_tile_target() {
    return HWY_DYNAMIC_DISPATCH(TargetName)();
}

} // namespace tonetool::kernels
#endif
