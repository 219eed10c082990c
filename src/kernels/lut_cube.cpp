// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/lut_rows.h"

#include <algorithm>
#include <cmath>

#include "kernels/flip_constants.h"

namespace tonetool::kernels {
namespace {

constexpr double kDarkest = -8, kBrightest = 8; // light that vertices are cut off at

double lab_f(double t) {
    return t > kLabKnee ? std::cbrt(t) : t * kLabSlope + kLabOffset;
}

} // namespace

double encode_light(double light) {
    const double cut = std::isnan(light) ? 0.0 : std::clamp(light, kDarkest, kBrightest);
    return cut < 0 ? 2 * kLabOffset - lab_f(-cut) : lab_f(cut);
}

double decode_light(double code) {
    const double cube = code * code * code;
    const double light = cube > kLabKnee ? cube : (code - kLabOffset) / kLabSlope;
    return std::clamp(light, 0.0, 1.0);
}

LightCube::LightCube(const CubeShape& shape)
    : m_shape(shape),
      m_data(hwy::AllocateAligned<float>(4 * size_t(shape.size) * size_t(shape.size) *
                                         size_t(shape.size))) {}

double LightCube::share(double x) const {
    const double power = std::pow(x / m_shape.pivot, m_shape.steep ? 0.75 : 0.5);
    return power / (power + 1);
}

double LightCube::place(double x) const {
    return (m_shape.size - 1) * std::min(share(x) / share(m_shape.brightest), 1.0);
}

double LightCube::level(int i) const {
    const double part = i / (m_shape.size - 1.0) * share(m_shape.brightest);
    return m_shape.pivot * std::pow(part / (1 - part), m_shape.steep ? 4.0 / 3.0 : 2.0);
}

void LightCube::set_row(int r, int g, const float* light) {
    float* to = vertex(r, g, 0);
    for (int b = 0; b < m_shape.size; ++b, to += 4, light += 3) {
        for (int c = 0; c < 3; ++c)
            to[c] = float(encode_light(double(light[c])));
        to[3] = 0;
    }
}

void light_cube_reference(const LightCube& cube, const double (&in)[3], double (&out)[3]) {
    int at[3], order[3] = {0, 1, 2};
    double part[3];
    for (int c = 0; c < 3; ++c) {
        const double place = cube.place(in[c]);
        at[c] = std::min(int(place), cube.shape().size - 2);
        part[c] = place - at[c];
    }
    std::stable_sort(order, order + 3, [&](int a, int b) { return part[a] > part[b]; });
    // From the darkest corner of the cell to the brightest, along its edges.
    double sum[3], weight = 1 - part[order[0]];
    for (int c = 0; c < 3; ++c)
        sum[c] = weight * double(cube.vertex(at[0], at[1], at[2])[c]);
    for (int step = 0; step < 3; ++step) {
        ++at[order[step]];
        weight = part[order[step]] - (step < 2 ? part[order[step + 1]] : 0);
        for (int c = 0; c < 3; ++c)
            sum[c] += weight * double(cube.vertex(at[0], at[1], at[2])[c]);
    }
    for (int c = 0; c < 3; ++c)
        out[c] = decode_light(sum[c]);
}

} // namespace tonetool::kernels
