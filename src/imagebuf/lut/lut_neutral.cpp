// SPDX-License-Identifier: BSD-3-Clause
// Khronos PBR neutral as tables of one channel. It leaves the hue, so that hue, least and largest
// channel are all it needs; products are sums of logarithms.
#include <algorithm>
#include <cmath>

#include "imagebuf/lut/lut_ops.h"
#include "kernels/curve_constants.h"

namespace tonetool {
namespace {

// Saturations down to 2^-32 as 0 to 1.
constexpr double kStops = 32;

// What remains of the least channel.
double least(double m) {
    return m < kernels::kNeutralToe ? kernels::kNeutralSquare * m * m
                                    : m - kernels::kNeutralFresnel;
}

double pressed(double peak) {
    const double room = 1 - kernels::kNeutralStart;
    return peak < kernels::kNeutralStart ? peak
                                         : 1 - room * room / (peak + room - kernels::kNeutralStart);
}

// log2 of what remains of the saturation, in the unit of its channel.
double desaturation(double peak) {
    return -std::log2(kernels::kNeutralDesaturation * (peak - pressed(peak)) + 1) / kStops;
}

// Increasing, as the first term falls by less than one in 32 per stop.
double lifted(const LutShaper& shaper, double v) {
    return desaturation(shaper.light(v)) + v;
}

double unlifted(const LutShaper& shaper, double y) {
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (lifted(shaper, middle) < y ? low : high) = middle;
    }
    return low;
}

double from_log(double v) {
    return std::exp2(v) - 1;
}

// log2 of the second and the third channel, log2(1 + v) of the hue; or back.
ocio::TransformRcPtr logs(ocio::TransformDirection direction) {
    const double offsets[3] = {1, 0, 0};
    const auto log = ocio::LogAffineTransform::Create();
    log->setLinSideOffsetValue(offsets);
    log->setDirection(direction);
    return log;
}

ocio::TransformRcPtr second_row(double first, double second, double third) {
    return lut_matrix({{1, 0, 0}, {0, first, second}, {0, 0, 1}}, {0, third, 0});
}

// Hue, saturation, value to hue, least (of the result), chroma = largest - least.
void append_least(const LutShaper& shaper, int size, ocio::GroupTransform& group) {
    group.appendTransform(second_row(-1, 0, 1));
    group.appendTransform(logs(ocio::TRANSFORM_DIR_FORWARD));
    group.appendTransform(second_row(1, 1, 0));
    group.appendTransform(logs(ocio::TRANSFORM_DIR_INVERSE));
    group.appendTransform(lut_matrix({{1, 0, 0}, {0, 1, 0}, {0, -1, 1}}, {}));
    group.appendTransform(lut_range(false));
    group.appendTransform(shaper.channels({false, true, true}));
    group.appendTransform(lut_table(size, [&](int c, double v) {
        return c == 0 ? from_log(v) : c == 1 ? least(shaper.light(v)) : shaper.light(v);
    }));
}

// That to hue, saturation = chroma / peak, peak = chroma + least.
void append_saturation(ocio::GroupTransform& group) {
    group.appendTransform(lut_matrix({{1, 0, 0}, {0, 0, 1}, {0, 1, 1}}, {}));
    group.appendTransform(logs(ocio::TRANSFORM_DIR_FORWARD));
    group.appendTransform(second_row(1, -1, 0));
    group.appendTransform(logs(ocio::TRANSFORM_DIR_INVERSE));
}

// Saturation and peak, pressed. One table can not change a channel by another, so that the third
// becomes f(v) + v for a moment and is added, then v and is subtracted.
void append_pressed(const LutShaper& shaper, int size, ocio::GroupTransform& group) {
    const double offsets[3] = {1, 0, shaper.offset()};
    const double slopes[3] = {1, 1 / kStops, shaper.slope()}, shifts[3] = {0, 1, shaper.shift()};
    const auto log = ocio::LogAffineTransform::Create();
    log->setLogSideSlopeValue(slopes);
    log->setLogSideOffsetValue(shifts);
    log->setLinSideOffsetValue(offsets);
    group.appendTransform(log);
    group.appendTransform(
        lut_table(size, [&](int c, double v) { return c < 2 ? v : lifted(shaper, v); }));
    group.appendTransform(second_row(0.5, 0.5, 0));
    group.appendTransform(
        lut_table(size, [&](int c, double v) { return c < 2 ? v : unlifted(shaper, v); }));
    group.appendTransform(second_row(2, -1, 0));
    group.appendTransform(lut_table(size, [&](int c, double v) {
        return c == 0   ? from_log(v)
               : c == 1 ? std::exp2(kStops * (v - 1))
                        : pressed(shaper.light(v));
    }));
}

} // namespace

void append_neutral(const LutShaper& shaper, int size, ocio::GroupTransform& group) {
    const auto back = ocio::FixedFunctionTransform::Create(ocio::FIXED_FUNCTION_RGB_TO_HSV);
    back->setDirection(ocio::TRANSFORM_DIR_INVERSE);
    group.appendTransform(ocio::FixedFunctionTransform::Create(ocio::FIXED_FUNCTION_RGB_TO_HSV));
    append_least(shaper, size, group);
    append_saturation(group);
    append_pressed(shaper, size, group);
    group.appendTransform(back);
}

} // namespace tonetool
