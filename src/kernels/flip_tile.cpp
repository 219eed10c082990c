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

#include "kernels/fast_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tonetool::kernels::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;
constexpr D d{};

struct Color {
    V c0, c1, c2;
};

// A 3x3 matrix times diagonal scalings, in float.
struct Matrix {
    float m[3][3];
    HWY_INLINE Color operator()(const Color& v) const {
        return {Row(m[0], v), Row(m[1], v), Row(m[2], v)};
    }
    static HWY_INLINE V Row(const float (&r)[3], const Color& v) {
        V sum = hn::Mul(hn::Set(d, r[0]), v.c0);
        sum = hn::MulAdd(hn::Set(d, r[1]), v.c1, sum);
        return hn::MulAdd(hn::Set(d, r[2]), v.c2, sum);
    }
};

// Linear RGB to XYZ relative to white, and back.
Matrix ToRelativeXyz() {
    Matrix out;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out.m[i][j] = float(kRgbToXyz[i][j] / kWhite[i]);
    return out;
}

Matrix FromRelativeXyz() {
    Matrix out;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out.m[i][j] = float(kXyzToRgb[i][j] * kWhite[j]);
    return out;
}

HWY_INLINE V Clamp01(V v) {
    return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0f));
}

HWY_INLINE V Rational(const float (&k)[6], V x) {
    const V up = hn::MulAdd(hn::MulAdd(hn::Set(d, k[0]), x, hn::Set(d, k[1])), x, hn::Set(d, k[2]));
    const V down =
        hn::MulAdd(hn::MulAdd(hn::Set(d, k[3]), x, hn::Set(d, k[4])), x, hn::Set(d, k[5]));
    return hn::Div(up, down);
}

// Each curve is a type, so that the pixel loop holds no branch.
struct NoCurve {
    explicit NoCurve(const ToneCurve&) {}
    HWY_INLINE Color operator()(const Color& x) const { return x; }
};

struct RationalCurve {
    float k[6];
    explicit RationalCurve(const ToneCurve& curve) {
        for (size_t i = 0; i < 6; ++i)
            k[i] = float(curve.k[i]);
    }
    HWY_INLINE Color operator()(const Color& x) const {
        return {Rational(k, x.c0), Rational(k, x.c1), Rational(k, x.c2)};
    }
};

struct ReinhardCurve {
    explicit ReinhardCurve(const ToneCurve&) {}
    HWY_INLINE Color operator()(const Color& x) const {
        V lum = hn::Mul(hn::Set(d, float(kLuminance[0])), x.c0);
        lum = hn::MulAdd(hn::Set(d, float(kLuminance[1])), x.c1, lum);
        lum = hn::MulAdd(hn::Set(d, float(kLuminance[2])), x.c2, lum);
        const V scale = hn::Div(hn::Set(d, 1.0f), hn::Add(hn::Set(d, 1.0f), lum));
        return {hn::Mul(x.c0, scale), hn::Mul(x.c1, scale), hn::Mul(x.c2, scale)};
    }
};

template <class Curve>
HWY_INLINE Color Display(const Curve& curve, const Color& linear, V scale) {
    const V limit = hn::Set(d, kLargestExposed);
    const Color y = curve(Color{hn::Min(hn::Mul(linear.c0, scale), limit),
                                hn::Min(hn::Mul(linear.c1, scale), limit),
                                hn::Min(hn::Mul(linear.c2, scale), limit)});
    return {Clamp01(y.c0), Clamp01(y.c1), Clamp01(y.c2)};
}

// Tone map `count` pixels, rounded up to whole vectors; `store(i, color)` takes them.
template <class Curve, class Store>
HWY_INLINE void ForDisplay(const float* const in[3], int64_t count, const Curve& curve, float scale,
                           const Store& store) {
    const V s = hn::Set(d, scale);
    for (int64_t i = 0; i < count; i += int64_t(hn::Lanes(d)))
        store(i, Display(curve,
                         Color{hn::LoadU(d, in[0] + i), hn::LoadU(d, in[1] + i),
                               hn::LoadU(d, in[2] + i)},
                         s));
}

template <class Store>
void WithCurve(const float* const in[3], int64_t count, const ToneCurve& curve, float scale,
               const Store& store) {
    if (curve.kind == ToneKind::Rational)
        ForDisplay(in, count, RationalCurve(curve), scale, store);
    else if (curve.kind == ToneKind::ReinhardLuminance)
        ForDisplay(in, count, ReinhardCurve(curve), scale, store);
    else
        ForDisplay(in, count, NoCurve(curve), scale, store);
}

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

// Taps of an even filter at `at`, elements `step` apart; from the outside in, so that the rounding
// of the sum is that of its last few terms.
HWY_INLINE V Even(const float* HWY_RESTRICT at, ptrdiff_t step, const std::vector<float>& taps) {
    V sum = hn::Zero(d);
    for (ptrdiff_t i = ptrdiff_t(taps.size()) - 1; i > 0; --i)
        sum = hn::MulAdd(hn::Set(d, taps[size_t(i)]),
                         hn::Add(hn::LoadU(d, at + i * step), hn::LoadU(d, at - i * step)), sum);
    return hn::MulAdd(hn::Set(d, taps[0]), hn::LoadU(d, at), sum);
}

HWY_INLINE V Odd(const float* HWY_RESTRICT at, ptrdiff_t step, const std::vector<float>& taps) {
    V sum = hn::Zero(d);
    for (ptrdiff_t i = ptrdiff_t(taps.size()) - 1; i > 0; --i)
        sum = hn::MulAdd(hn::Set(d, taps[size_t(i)]),
                         hn::Sub(hn::LoadU(d, at + i * step), hn::LoadU(d, at - i * step)), sum);
    return sum;
}

enum RowPlane { kRowY, kRowCx, kRowCz1, kRowCz2, kRowG, kRowD1, kRowD2, kRowPlanes };

// The x pass of one row: seven filters of three planes.
void FilterRow(const float* y, const float* xy, const float* yz, int width,
               const FlipTaps<float>& taps, float* const out[kRowPlanes]) {
    for (ptrdiff_t x = 0; x < width; x += ptrdiff_t(hn::Lanes(d))) {
        hn::StoreU(Even(y + x, 1, taps.y), d, out[kRowY] + x);
        hn::StoreU(Even(xy + x, 1, taps.cx), d, out[kRowCx] + x);
        hn::StoreU(Even(yz + x, 1, taps.cz1), d, out[kRowCz1] + x);
        hn::StoreU(Even(yz + x, 1, taps.cz2), d, out[kRowCz2] + x);
        hn::StoreU(Even(y + x, 1, taps.g), d, out[kRowG] + x);
        hn::StoreU(Odd(y + x, 1, taps.d1), d, out[kRowD1] + x);
        hn::StoreU(Even(y + x, 1, taps.d2), d, out[kRowD2] + x);
    }
}

// CIELAB f(t). E is as steep as h^0.7 at h = 0: f is kept to more than float precision, so that
// its differences are limited by t alone.
HWY_INLINE Split<V> LabF(V t) {
    const V knee = hn::Set(d, float(kLabKnee));
    const Split<V> root = CubeRoot(d, hn::Max(t, knee));
    const auto above = hn::Gt(t, knee);
    const V line = hn::MulAdd(t, hn::Set(d, float(kLabSlope)),
                              hn::Set(d, float(kLabOffset - double(float(kLabOffset)))));
    return {hn::IfThenElse(above, root.high, hn::Set(d, float(kLabOffset))),
            hn::IfThenElse(above, root.low, line)};
}

struct Lab {
    Split<V> l;
    V a, b;
};

HWY_INLINE V Difference(const Split<V>& p, const Split<V>& q) {
    return hn::Add(hn::Sub(p.high, q.high), hn::Sub(p.low, q.low));
}

// f(p) - f(q), given p - q to its own precision: by (p - q) / (f(p)^2 + f(p) f(q) + f(q)^2) where
// both are cube roots.
HWY_INLINE V LabStep(V p, V q, V p_minus_q, const Split<V>& fp, const Split<V>& fq) {
    const V a = hn::Add(fp.high, fp.low), b = hn::Add(fq.high, fq.low);
    const V sum = hn::MulAdd(a, hn::Add(a, b), hn::Mul(b, b));
    return hn::IfThenElse(hn::Gt(hn::Min(p, q), hn::Set(d, float(kLabKnee))),
                          hn::Div(p_minus_q, sum), Difference(fp, fq));
}

// Filtered opponent colour to Hunt-adjusted Lab. The clamp of RGB is applied as a correction of
// XYZ, which is exactly nothing for colours inside the gamut.
HWY_INLINE Lab HuntLab(const Matrix& to_xyz, const Matrix& to_rgb, V y, V xy, V yz) {
    const Color rgb = to_rgb(Color{hn::Add(y, xy), y, hn::Sub(y, yz)});
    const Color moved =
        to_xyz(Color{hn::Sub(Clamp01(rgb.c0), rgb.c0), hn::Sub(Clamp01(rgb.c1), rgb.c1),
                     hn::Sub(Clamp01(rgb.c2), rgb.c2)});
    y = hn::Add(y, moved.c1);
    xy = hn::Add(xy, hn::Sub(moved.c0, moved.c1));
    yz = hn::Add(yz, hn::Sub(moved.c1, moved.c2));
    const V x = hn::Add(y, xy), z = hn::Sub(y, yz);
    const Split<V> fx = LabF(x), fy = LabF(y), fz = LabF(z);
    const V scale = hn::Set(d, 116.0f);
    // Exact: `high` has 8 bits, 116 has 5.
    const Split<V> l = {hn::Sub(hn::Mul(scale, fy.high), hn::Set(d, 16.0f)),
                        hn::Mul(scale, fy.low)};
    const V light = hn::Add(l.high, l.low);
    return {l, hn::Mul(hn::Mul(light, hn::Set(d, 5.0f)), LabStep(x, y, xy, fx, fy)),
            hn::Mul(hn::Mul(light, hn::Set(d, 2.0f)), LabStep(y, z, yz, fy, fz))};
}

HWY_INLINE V Magnitude(V a, V b) {
    return hn::Sqrt(hn::MulAdd(a, a, hn::Mul(b, b)));
}

// The y pass of one row of the tile, and everything per pixel up to the comparison.
void FilterColumns(const float* const rows[kRowPlanes], ptrdiff_t stride, int width,
                   const FlipTaps<float>& taps, float* const out[kFeaturePlanes]) {
    const Matrix to_xyz = ToRelativeXyz(), to_rgb = FromRelativeXyz();
    for (ptrdiff_t x = 0; x < width; x += ptrdiff_t(hn::Lanes(d))) {
        const V y = Even(rows[kRowY] + x, stride, taps.y);
        const V cx = Even(rows[kRowCx] + x, stride, taps.cx);
        const V cz = hn::Add(Even(rows[kRowCz1] + x, stride, taps.cz1),
                             Even(rows[kRowCz2] + x, stride, taps.cz2));
        const Lab lab = HuntLab(to_xyz, to_rgb, y, cx, cz);
        hn::StoreU(lab.l.high, d, out[kLHigh] + x);
        hn::StoreU(lab.l.low, d, out[kLLow] + x);
        hn::StoreU(lab.a, d, out[kA] + x);
        hn::StoreU(lab.b, d, out[kB] + x);
        const V edge = Magnitude(Even(rows[kRowD1] + x, stride, taps.g),
                                 Odd(rows[kRowG] + x, stride, taps.d1));
        const V point = Magnitude(Even(rows[kRowD2] + x, stride, taps.g),
                                  Even(rows[kRowG] + x, stride, taps.d2));
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
constexpr int kRowPlaneCount = 7;

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
            const float* in = image.plane[c] + source_y * image.stride;
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
      m_rows(kRowPlaneCount, shape.stride, shape.padded_height()) {}

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
        float* out[kRowPlaneCount];
        for (int p = 0; p < kRowPlaneCount; ++p)
            out[p] = m_rows[p] + y * m_shape.stride;
        filter_row(m_opponent[0] + at, m_opponent[1] + at, m_opponent[2] + at, m_shape.width,
                   m_taps, out);
    }
    for (int y = 0; y < m_shape.height; ++y) {
        const float* rows[kRowPlaneCount];
        float* out[kFeaturePlanes];
        for (int p = 0; p < kRowPlaneCount; ++p)
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
