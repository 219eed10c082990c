// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lut/lut_source.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/names.h"
#include "kernels/curve_constants.h"
#include "kernels/curve_reference.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using kernels::CurveKind;
using OIIO::Strutil::fmt::format;

LutSource::Structure structure_of(const CurvePlan& plan) {
    switch (plan.numbers.kind) {
    case CurveKind::AcesHill:
    case CurveKind::Agx:
        return LutSource::Structure::Matrices;
    case CurveKind::Neutral:
        return LutSource::Structure::Neutral;
    default:
        break;
    }
    if (kernels::mixes_channels(plan.numbers.kind))
        return LutSource::Structure::Other;
    if (!plan.use.on_luminance)
        return LutSource::Structure::Channel;
    return plan.use.saturation == 1 ? LutSource::Structure::Luminance : LutSource::Structure::Other;
}

double agx_sigmoid(double x) {
    const double low = kernels::kAgxLowest, high = kernels::kAgxHighest;
    const double share = (std::clamp(std::log2(x), low, high) - low) / (high - low);
    double y = 0;
    for (size_t i = kernels::kAgxSigmoid.size(); i-- > 0;)
        y = y * share + kernels::kAgxSigmoid[i];
    return y;
}

std::string described(const CurvePlan& plan) {
    std::string text = plan.name;
    for (const auto& [name, value] : plan.parameters)
        text += format(" {}={}", name, value);
    if (plan.on != "color")
        text += " on " + plan.on;
    if (plan.use.saturation != 1)
        text += format(" saturation={}", plan.use.saturation);
    return text;
}

} // namespace

void LutSource::open(const LutOptions& options) {
    m_is_view = options.view.has_value();
    if (m_is_view)
        open_view(options);
    else
        open_curve(options);
}

void LutSource::open_curve(const LutOptions& options) {
    if (!options.from.empty())
        throw Refusal("from=" + options.from + " is of views: curves start from linear Rec.709");
    m_encoding = find_encoding(options.encode);
    if (!m_encoding)
        throw Refusal(unknown_name("encoding", options.encode, ToneAlgo::display_encodings()));
    m_curve = plan_curve(options.curve, false, options.encode);
    m_structure = structure_of(m_curve);
    m_name = "tone curve " + described(m_curve);
    m_input = "linear Rec.709";
    m_encode = options.encode;
    m_output = m_encode == "none" ? "linear display light" : "display, encoded " + m_encode;
}

void LutSource::open_view(const LutOptions& options) {
    m_view.open(*options.view, options.from, OIIO::ImageSpec(1, 1, 3, OIIO::TypeFloat));
    m_name = "view " + m_view.view() + " of display " + m_view.display();
    m_input = m_view.from();
    m_output = m_view.space();
}

void LutSource::exact(float* rgb, ptrdiff_t count) const {
    for (ptrdiff_t i = 0; i < 3 * count; ++i)
        rgb[i] = std::max(rgb[i], 0.0f);
    if (m_is_view) {
        m_view.apply(rgb, count);
        return;
    }
    for (ptrdiff_t i = 0; i < count; ++i, rgb += 3) {
        const auto light = kernels::curve_reference(
            m_curve.numbers, m_curve.use, {double(rgb[0]), double(rgb[1]), double(rgb[2])});
        for (size_t c = 0; c < 3; ++c)
            rgb[c] = m_encoding(float(light[c]));
    }
}

double LutSource::inner(int channel, double x) const {
    kernels::CurveNumbers numbers = m_curve.numbers;
    if (numbers.kind == CurveKind::Agx)
        return agx_sigmoid(x);
    if (numbers.kind == CurveKind::AcesHill)
        numbers.kind = CurveKind::Rational;
    return kernels::curve_reference(numbers, size_t(channel), x);
}

double LutSource::encoded(double light) const {
    return double(m_encoding(float(std::clamp(light, 0.0, 1.0))));
}

} // namespace tonetool
