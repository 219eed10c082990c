#include "kernels/lut_rows.h"

#include <algorithm>
#include <cmath>

#include "kernels/flip_constants.h"

namespace tonetool::kernels {
namespace {

double lab_f(double t) {
    return t > kLabKnee ? std::cbrt(t) : t * kLabSlope + kLabOffset;
}

} // namespace

double encode_light(double light) {
    return light < 0 ? 2 * kLabOffset - lab_f(-light) : lab_f(light);
}

double decode_light(double code) {
    const double cube = code * code * code;
    const double light = cube > kLabKnee ? cube : (code - kLabOffset) / kLabSlope;
    return std::clamp(light, 0.0, 1.0);
}

LightCube::LightCube(const CubeRange& range)
    : m_range(range),
      m_data(hwy::AllocateAligned<float>(4 * size_t(range.size) * size_t(range.size) *
                                         size_t(range.size))) {}

double LightCube::level(int i) const {
    const double stops = i / m_range.cells_per_stop();
    return std::exp2(m_range.darkest) * std::expm1(stops * std::log(2.0));
}

void LightCube::set_row(int r, int g, const float* light) {
    float* to = vertex(r, g, 0);
    for (int b = 0; b < m_range.size; ++b, to += 4, light += 3) {
        for (int c = 0; c < 3; ++c)
            to[c] = float(encode_light(double(light[c])));
        to[3] = 0;
    }
}

void light_cube_twin(const LightCube& cube, const double (&in)[3], double (&out)[3]) {
    const CubeRange& range = cube.range();
    int at[3], order[3] = {0, 1, 2};
    double part[3];
    for (int c = 0; c < 3; ++c) {
        const double stops = std::log2(in[c] + std::exp2(range.darkest)) - range.darkest;
        const double place = std::clamp(stops * range.cells_per_stop(), 0.0, range.size - 1.0);
        at[c] = std::min(int(place), range.size - 2);
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
