// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/flip_reference.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/flip_constants.h"

namespace tonetool::kernels {
namespace {

template <typename T>
using Plane = std::vector<T>;
template <typename T>
using Color = std::array<T, 3>;

template <typename T>
Color<T> multiply(const double (&m)[3][3], const Color<T>& v) {
    Color<T> out{};
    for (size_t i = 0; i < 3; ++i)
        out[i] = T(m[i][0]) * v[0] + T(m[i][1]) * v[1] + T(m[i][2]) * v[2];
    return out;
}

template <typename T>
Color<T> tone_map(const ToneCurve& curve, const Color<T>& x) {
    T k[6];
    std::transform(curve.k.begin(), curve.k.end(), k, [](double v) { return T(v); });
    Color<T> y = x;
    if (curve.kind == ToneKind::ReinhardLuminance) {
        const T lum = T(kLuminance[0]) * x[0] + T(kLuminance[1]) * x[1] + T(kLuminance[2]) * x[2];
        for (T& v : y)
            v /= 1 + lum;
    } else if (curve.kind == ToneKind::Rational) {
        for (T& v : y)
            v = (k[0] * v * v + k[1] * v + k[2]) / (k[3] * v * v + k[4] * v + k[5]);
    }
    for (T& v : y)
        v = std::clamp(v, T(0), T(1));
    return y;
}

// YCxCz, the linear opponent space of the paper.
template <typename T>
Color<T> to_ycxcz(const Color<T>& rgb) {
    const Color<T> xyz = multiply(kRgbToXyz, rgb);
    const T x = xyz[0] / T(kWhite[0]), y = xyz[1] / T(kWhite[1]), z = xyz[2] / T(kWhite[2]);
    return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

template <typename T>
Color<T> from_ycxcz(const Color<T>& c) {
    const T y = (c[0] + 16) / 116;
    const T x = y + c[1] / 500, z = y - c[2] / 200;
    return multiply<T>(kXyzToRgb, {x * T(kWhite[0]), y * T(kWhite[1]), z * T(kWhite[2])});
}

template <typename T>
T lab_f(T t) {
    return t > T(kLabKnee) ? std::cbrt(t) : t * T(kLabSlope) + T(kLabOffset);
}

template <typename T>
Color<T> to_hunt_lab(const Color<T>& rgb) {
    const Color<T> xyz = multiply(kRgbToXyz, rgb);
    const T fx = lab_f(xyz[0] / T(kWhite[0]));
    const T fy = lab_f(xyz[1] / T(kWhite[1]));
    const T fz = lab_f(xyz[2] / T(kWhite[2]));
    const T l = 116 * fy - 16;
    return {l, T(0.01) * l * 500 * (fx - fy), T(0.01) * l * 200 * (fy - fz)};
}

// `row` with its ends repeated `radius` times.
template <typename T>
std::vector<T> padded(const T* row, int width, int radius) {
    std::vector<T> out(size_t(radius), row[0]);
    out.insert(out.end(), row, row + width);
    out.insert(out.end(), size_t(radius), row[width - 1]);
    return out;
}

// Correlation along x or y, the border replicated. Every pixel adds its taps from the lowest to the
// highest.
template <typename T>
Plane<T> filter(const Plane<T>& in, int width, int height, const std::vector<T>& taps, bool odd,
                bool along_x) {
    Plane<T> out(in.size());
    const int radius = int(taps.size()) - 1;
    const auto row = [&](int y) { return in.data() + ptrdiff_t(y) * width; };
    for (int y = 0; y < height; ++y) {
        const std::vector<T> line = padded(row(y), width, along_x ? radius : 0);
        T* const sums = out.data() + ptrdiff_t(y) * width;
        for (int i = -radius; i <= radius; ++i) {
            const T* from =
                along_x ? line.data() + radius + i : row(std::clamp(y + i, 0, height - 1));
            const T tap = taps[size_t(std::abs(i))] * T(odd && i < 0 ? -1 : 1);
            for (int x = 0; x < width; ++x)
                sums[x] += tap * from[x];
        }
    }
    return out;
}

template <typename T>
struct Side {
    Plane<T> lab[3];
    Plane<T> edge, point;
};

template <typename T>
Plane<T> separable(const Plane<T>& in, const PlaneImage<T>& image, const std::vector<T>& along_x,
                   bool odd_x, const std::vector<T>& along_y, bool odd_y) {
    return filter(filter(in, image.width, image.height, along_x, odd_x, true), image.width,
                  image.height, along_y, odd_y, false);
}

template <typename T>
Plane<T> magnitude(const Plane<T>& a, const Plane<T>& b) {
    Plane<T> out(a.size());
    for (size_t i = 0; i < a.size(); ++i)
        out[i] = std::sqrt(a[i] * a[i] + b[i] * b[i]);
    return out;
}

template <typename T>
Side<T> prepare(const PlaneImage<T>& image, const FlipTaps<T>& taps) {
    const size_t n = image.plane[0].size();
    Plane<T> c[3] = {Plane<T>(n), Plane<T>(n), Plane<T>(n)};
    Plane<T> luminance(n);
    for (size_t i = 0; i < n; ++i) {
        const Color<T> v = to_ycxcz<T>({image.plane[0][i], image.plane[1][i], image.plane[2][i]});
        for (size_t j = 0; j < 3; ++j)
            c[j][i] = v[j];
        luminance[i] = (v[0] + 16) / 116;
    }
    Side<T> side;
    side.edge = magnitude(separable(luminance, image, taps.d1, true, taps.g, false),
                          separable(luminance, image, taps.g, false, taps.d1, true));
    side.point = magnitude(separable(luminance, image, taps.d2, false, taps.g, false),
                           separable(luminance, image, taps.g, false, taps.d2, false));
    const Plane<T> y = separable(c[0], image, taps.y, false, taps.y, false);
    const Plane<T> cx = separable(c[1], image, taps.cx, false, taps.cx, false);
    const Plane<T> cz1 = separable(c[2], image, taps.cz1, false, taps.cz1, false);
    const Plane<T> cz2 = separable(c[2], image, taps.cz2, false, taps.cz2, false);
    for (Plane<T>& p : side.lab)
        p.resize(n);
    for (size_t i = 0; i < n; ++i) {
        Color<T> rgb = from_ycxcz<T>({y[i], cx[i], cz1[i] + cz2[i]});
        for (T& v : rgb)
            v = std::clamp(v, T(0), T(1));
        const Color<T> lab = to_hunt_lab(rgb);
        for (size_t j = 0; j < 3; ++j)
            side.lab[j][i] = lab[j];
    }
    return side;
}

template <typename T>
T flip_error(const Side<T>& r, const Side<T>& t, size_t i) {
    constexpr T knee = T(kKneeShare * kLargestQ), at_knee = T(kKneeError);
    const T da = r.lab[1][i] - t.lab[1][i], db = r.lab[2][i] - t.lab[2][i];
    const T h = std::abs(r.lab[0][i] - t.lab[0][i]) + std::sqrt(da * da + db * db);
    const T q = std::pow(h, T(kColorExponent));
    const T color = q < knee ? q * (at_knee / knee)
                             : at_knee + (q - knee) / (T(kLargestQ) - knee) * (1 - at_knee);
    const T feature =
        std::sqrt(std::max(std::abs(r.edge[i] - t.edge[i]), std::abs(r.point[i] - t.point[i])) /
                  std::sqrt(T(2)));
    return color > 0 ? std::pow(color, 1 - std::min(feature, T(1))) : T(0);
}

} // namespace

template <typename T>
PlaneImage<T> tone_map_reference(const ConstRgb& image, const ToneCurve& curve, double stops) {
    PlaneImage<T> out{image.width, image.height, {}};
    const T scale = T(std::exp2(stops));
    for (Plane<T>& p : out.plane)
        p.resize(size_t(image.width) * size_t(image.height));
    size_t at = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x, ++at) {
            Color<T> v{};
            for (size_t c = 0; c < 3; ++c)
                v[c] =
                    std::min(T(image.plane[c][y * image.stride + x]) * scale, T(kLargestExposed));
            v = tone_map(curve, v);
            for (size_t c = 0; c < 3; ++c)
                out.plane[c][at] = v[c];
        }
    return out;
}

template <typename T>
std::vector<T> ldr_flip_reference(const PlaneImage<T>& reference, const PlaneImage<T>& test,
                                  const FlipTaps<T>& taps) {
    const Side<T> r = prepare(reference, taps), t = prepare(test, taps);
    std::vector<T> out(r.edge.size());
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = flip_error(r, t, i);
    return out;
}

template <typename T>
std::vector<T> hdr_flip_reference(const ConstRgb& reference, const ConstRgb& test,
                                  const FlipTaps<T>& taps, const ToneCurve& curve,
                                  const std::vector<double>& stops, std::vector<int>* index) {
    std::vector<T> best(size_t(reference.width) * size_t(reference.height), T(0));
    if (index)
        index->assign(best.size(), 0);
    for (size_t n = 0; n < stops.size(); ++n) {
        const auto error = ldr_flip_reference(tone_map_reference<T>(reference, curve, stops[n]),
                                              tone_map_reference<T>(test, curve, stops[n]), taps);
        for (size_t i = 0; i < best.size(); ++i)
            if (error[i] > best[i]) {
                best[i] = error[i];
                if (index)
                    (*index)[i] = int(n);
            }
    }
    return best;
}

template PlaneImage<double> tone_map_reference(const ConstRgb&, const ToneCurve&, double);
template std::vector<double> ldr_flip_reference(const PlaneImage<double>&,
                                                const PlaneImage<double>&, const FlipTaps<double>&);
template std::vector<double> hdr_flip_reference(const ConstRgb&, const ConstRgb&,
                                                const FlipTaps<double>&, const ToneCurve&,
                                                const std::vector<double>&, std::vector<int>*);
template std::vector<float> hdr_flip_reference(const ConstRgb&, const ConstRgb&,
                                               const FlipTaps<float>&, const ToneCurve&,
                                               const std::vector<double>&, std::vector<int>*);

} // namespace tonetool::kernels
