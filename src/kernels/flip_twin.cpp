#include "kernels/flip_twin.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/flip_constants.h"

namespace tonetool::kernels {
namespace {

using Plane = std::vector<double>;
using Color = std::array<double, 3>;

Color multiply(const double (&m)[3][3], const Color& v) {
    Color out{};
    for (size_t i = 0; i < 3; ++i)
        out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

Color tone_map(const ToneCurve& curve, const Color& x) {
    const auto& k = curve.k;
    Color y = x;
    if (curve.kind == ToneKind::ReinhardLuminance) {
        const double lum = kLuminance[0] * x[0] + kLuminance[1] * x[1] + kLuminance[2] * x[2];
        for (double& v : y)
            v /= 1.0 + lum;
    } else if (curve.kind == ToneKind::Rational) {
        for (double& v : y)
            v = (k[0] * v * v + k[1] * v + k[2]) / (k[3] * v * v + k[4] * v + k[5]);
    }
    for (double& v : y)
        v = std::clamp(v, 0.0, 1.0);
    return y;
}

// YCxCz, the linear opponent space of the paper.
Color to_ycxcz(const Color& rgb) {
    const Color xyz = multiply(kRgbToXyz, rgb);
    const double x = xyz[0] / kWhite[0], y = xyz[1] / kWhite[1], z = xyz[2] / kWhite[2];
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Color from_ycxcz(const Color& c) {
    const double y = (c[0] + 16.0) / 116.0;
    const double x = y + c[1] / 500.0, z = y - c[2] / 200.0;
    return multiply(kXyzToRgb, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

double lab_f(double t) {
    return t > kLabKnee ? std::cbrt(t) : t * kLabSlope + kLabOffset;
}

Color to_hunt_lab(const Color& rgb) {
    const Color xyz = multiply(kRgbToXyz, rgb);
    const double fx = lab_f(xyz[0] / kWhite[0]);
    const double fy = lab_f(xyz[1] / kWhite[1]);
    const double fz = lab_f(xyz[2] / kWhite[2]);
    const double l = 116.0 * fy - 16.0;
    return {l, 0.01 * l * 500.0 * (fx - fy), 0.01 * l * 200.0 * (fy - fz)};
}

// Correlation along x (step 1) or y (step width), the border replicated.
Plane filter(const Plane& in, int width, int height, const std::vector<double>& taps, bool odd,
             bool along_x) {
    Plane out(in.size());
    const int radius = int(taps.size()) - 1;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int i = -radius; i <= radius; ++i) {
                const int sx = along_x ? std::clamp(x + i, 0, width - 1) : x;
                const int sy = along_x ? y : std::clamp(y + i, 0, height - 1);
                const double tap = taps[size_t(std::abs(i))] * (odd && i < 0 ? -1.0 : 1.0);
                sum += tap * in[size_t(sy) * size_t(width) + size_t(sx)];
            }
            out[size_t(y) * size_t(width) + size_t(x)] = sum;
        }
    return out;
}

struct Side {
    Plane lab[3];
    Plane edge, point;
};

Plane separable(const Plane& in, const TwinImage& image, const std::vector<double>& along_x,
                bool odd_x, const std::vector<double>& along_y, bool odd_y) {
    return filter(filter(in, image.width, image.height, along_x, odd_x, true), image.width,
                  image.height, along_y, odd_y, false);
}

Plane magnitude(const Plane& a, const Plane& b) {
    Plane out(a.size());
    for (size_t i = 0; i < a.size(); ++i)
        out[i] = std::sqrt(a[i] * a[i] + b[i] * b[i]);
    return out;
}

Side prepare(const TwinImage& image, const FlipTaps<double>& taps) {
    const size_t n = image.plane[0].size();
    Plane c[3] = {Plane(n), Plane(n), Plane(n)};
    Plane luminance(n);
    for (size_t i = 0; i < n; ++i) {
        const Color v = to_ycxcz({image.plane[0][i], image.plane[1][i], image.plane[2][i]});
        for (size_t j = 0; j < 3; ++j)
            c[j][i] = v[j];
        luminance[i] = (v[0] + 16.0) / 116.0;
    }
    Side side;
    side.edge = magnitude(separable(luminance, image, taps.d1, true, taps.g, false),
                          separable(luminance, image, taps.g, false, taps.d1, true));
    side.point = magnitude(separable(luminance, image, taps.d2, false, taps.g, false),
                           separable(luminance, image, taps.g, false, taps.d2, false));
    const Plane y = separable(c[0], image, taps.y, false, taps.y, false);
    const Plane cx = separable(c[1], image, taps.cx, false, taps.cx, false);
    const Plane cz1 = separable(c[2], image, taps.cz1, false, taps.cz1, false);
    const Plane cz2 = separable(c[2], image, taps.cz2, false, taps.cz2, false);
    for (Plane& p : side.lab)
        p.resize(n);
    for (size_t i = 0; i < n; ++i) {
        Color rgb = from_ycxcz({y[i], cx[i], cz1[i] + cz2[i]});
        for (double& v : rgb)
            v = std::clamp(v, 0.0, 1.0);
        const Color lab = to_hunt_lab(rgb);
        for (size_t j = 0; j < 3; ++j)
            side.lab[j][i] = lab[j];
    }
    return side;
}

double flip_error(const Side& r, const Side& t, size_t i) {
    const double da = r.lab[1][i] - t.lab[1][i], db = r.lab[2][i] - t.lab[2][i];
    const double h = std::abs(r.lab[0][i] - t.lab[0][i]) + std::sqrt(da * da + db * db);
    const double q = std::pow(h, kColorExponent), knee = kKneeShare * kLargestQ;
    const double color = q < knee
                             ? q * (kKneeError / knee)
                             : kKneeError + (q - knee) / (kLargestQ - knee) * (1.0 - kKneeError);
    const double feature =
        std::sqrt(std::max(std::abs(r.edge[i] - t.edge[i]), std::abs(r.point[i] - t.point[i])) /
                  std::sqrt(2.0));
    return color > 0 ? std::pow(color, 1.0 - std::min(feature, 1.0)) : 0.0;
}

} // namespace

TwinImage tone_map_twin(const ConstRgb& image, const ToneCurve& curve, double stops) {
    TwinImage out{image.width, image.height, {}};
    const double scale = std::exp2(stops);
    for (Plane& p : out.plane)
        p.resize(size_t(image.width) * size_t(image.height));
    size_t at = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x, ++at) {
            Color v{};
            for (size_t c = 0; c < 3; ++c)
                v[c] = std::min(double(image.plane[c][y * image.stride + x]) * scale,
                                double(kLargestExposed));
            v = tone_map(curve, v);
            for (size_t c = 0; c < 3; ++c)
                out.plane[c][at] = v[c];
        }
    return out;
}

std::vector<double> ldr_flip_twin(const TwinImage& reference, const TwinImage& test,
                                  const FlipTaps<double>& taps) {
    const Side r = prepare(reference, taps), t = prepare(test, taps);
    std::vector<double> out(r.edge.size());
    for (size_t i = 0; i < out.size(); ++i)
        out[i] = flip_error(r, t, i);
    return out;
}

std::vector<double> hdr_flip_twin(const ConstRgb& reference, const ConstRgb& test,
                                  const FlipTaps<double>& taps, const ToneCurve& curve,
                                  const std::vector<double>& stops, std::vector<int>* index) {
    std::vector<double> best(size_t(reference.width) * size_t(reference.height), 0.0);
    if (index)
        index->assign(best.size(), 0);
    for (size_t n = 0; n < stops.size(); ++n) {
        const auto error = ldr_flip_twin(tone_map_twin(reference, curve, stops[n]),
                                         tone_map_twin(test, curve, stops[n]), taps);
        for (size_t i = 0; i < best.size(); ++i)
            if (error[i] > best[i]) {
                best[i] = error[i];
                if (index)
                    (*index)[i] = int(n);
            }
    }
    return best;
}

} // namespace tonetool::kernels
