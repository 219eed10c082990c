// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lut/lut_shaper.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// ACEScct, S-2016-001.
constexpr double kCctBreak = 0.0078125, kCctSlope = 1 / 17.52, kCctShift = 9.72 / 17.52;
constexpr double kCctLinearSlope = 10.5402377416545, kCctLinearShift = 0.0729055341958355;

} // namespace

void LutShaper::make(const LutOptions& options) {
    const auto names = ToneAlgo::lut_shapers();
    m_kind = Kind(std::find(names.begin(), names.end(), options.shaper) - names.begin());
    const LutOptions defaults;
    if (m_kind != Kind::Log2 && (options.min != defaults.min || options.max != defaults.max))
        throw Refusal("min and max are of the shaper log2, this one is " + options.shaper);
    m_min = options.min;
    m_max = options.max;
    m_offset = std::exp2(m_min);
    m_slope = 1 / (std::log2(std::exp2(m_max) + m_offset) - m_min);
    m_shift = -m_min * m_slope;
}

double LutShaper::shape(double x) const {
    switch (m_kind) {
    case Kind::Log2:
        return m_slope * std::log2(x + m_offset) + m_shift;
    case Kind::AcesCct:
        return x > kCctBreak ? kCctSlope * std::log2(x) + kCctShift
                             : kCctLinearSlope * x + kCctLinearShift;
    default:
        return x;
    }
}

double LutShaper::light(double v) const {
    double x = v;
    if (m_kind == Kind::Log2)
        x = v <= 0 ? 0 : std::exp2((v - m_shift) / m_slope) - m_offset;
    else if (m_kind == Kind::AcesCct)
        x = v > shape(kCctBreak) ? std::exp2((v - kCctShift) / kCctSlope)
                                 : (v - kCctLinearShift) / kCctLinearSlope;
    return std::max(x, 0.0);
}

std::string LutShaper::formula() const {
    switch (m_kind) {
    case Kind::Log2:
        return format("(log2(x + 2^{0}) + {2}) / (log2(2^{1} + 2^{0}) + {2})", m_min, m_max,
                      std::abs(m_min));
    case Kind::AcesCct:
        return "ACEScct's curve of x";
    default:
        return "";
    }
}

ocio::TransformRcPtr LutShaper::transform() const {
    if (m_kind == Kind::Linear)
        return nullptr;
    if (m_kind == Kind::Log2)
        return channels({true, true, true});
    const double slopes[3] = {kCctSlope, kCctSlope, kCctSlope};
    const double shifts[3] = {kCctShift, kCctShift, kCctShift};
    const double breaks[3] = {kCctBreak, kCctBreak, kCctBreak};
    const auto log = ocio::LogCameraTransform::Create(breaks);
    log->setLogSideSlopeValue(slopes);
    log->setLogSideOffsetValue(shifts);
    return log;
}

ocio::TransformRcPtr LutShaper::channels(const std::array<bool, 3>& shaped) const {
    double slopes[3], shifts[3], offsets[3];
    for (size_t c = 0; c < 3; ++c) {
        slopes[c] = shaped[c] ? m_slope : 1;
        shifts[c] = shaped[c] ? m_shift : 0;
        offsets[c] = shaped[c] ? m_offset : 1;
    }
    const auto log = ocio::LogAffineTransform::Create();
    log->setLogSideSlopeValue(slopes);
    log->setLogSideOffsetValue(shifts);
    log->setLinSideOffsetValue(offsets);
    return log;
}

std::vector<std::string> ToneAlgo::lut_shapers() {
    return {"log2", "acescct", "linear"};
}

} // namespace tonetool
