// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/curve_plan.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"
#include "tonemap/curves.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using tonemap::Curve;
using tonemap::CurveDomain;

// What the curve is applied to, where the curve leaves a choice.
void plan_domain(const CurveOptions& options, CurveDomain domain, CurvePlan& plan) {
    if (!options.on.empty() && options.on != "rgb" && options.on != "luminance")
        throw Refusal("on is \"" + options.on + "\"; valid: rgb, luminance");
    if (domain == CurveDomain::Color && !options.on.empty())
        throw Refusal(plan.name + " mixes the channels: on=" + options.on +
                      " does not apply to it");
    const bool luminance =
        options.on.empty() ? domain == CurveDomain::Luminance : options.on == "luminance";
    if (!(options.saturation >= 0 && options.saturation <= 4))
        throw Refusal(format("saturation is {}: must be 0 to 4", options.saturation));
    if (options.saturation != 1 && !luminance)
        throw Refusal(format("saturation={} is of curves on luminance: {} is not applied so",
                             options.saturation, plan.name));
    plan.on = domain == CurveDomain::Color ? "color" : luminance ? "luminance" : "rgb";
    plan.use.on_luminance = luminance;
    plan.use.saturation = options.saturation;
}

CurvePlan plan_coefficients(const CurveOptions& options) {
    CurvePlan plan;
    plan.name = "coeffs";
    if (!options.parameters.empty())
        throw Refusal(options.parameters.begin()->first + "= does not go with coeffs=");
    plan.numbers = refusing_as(
        [&](const std::string& why) {
            return "coeffs are " + OIIO::Strutil::join(options.coeffs, ",") + ": " + why;
        },
        [&] { return tonemap::coefficient_curve(options.coeffs); });
    plan_domain(options, CurveDomain::Channel, plan);
    return plan;
}

CurvePlan plan_named(const CurveOptions& options, bool flip) {
    const Curve* curve = tonemap::find_curve(options.name);
    if (!curve)
        throw Refusal(unknown_name("tone curve", options.name, tonemap::curve_names()));
    CurvePlan plan;
    plan.name = curve->name;
    const auto values = tonemap::curve_values(*curve, options.parameters, flip);
    for (size_t i = 0; i < values.size(); ++i)
        plan.parameters[curve->parameters[i].name] = values[i];
    plan.numbers = curve->make(values);
    plan_domain(options, curve->domain, plan);
    return plan;
}

} // namespace

std::vector<double> CurvePlan::coeffs() const {
    if (numbers.kind != kernels::CurveKind::Rational)
        return {};
    return {numbers.p.begin(), numbers.p.begin() + 6};
}

CurvePlan plan_curve(const CurveOptions& options, bool flip) {
    return options.coeffs.empty() ? plan_named(options, flip) : plan_coefficients(options);
}

bool has_parameter(const CurveOptions& options, const std::string& name) {
    const Curve* curve = options.coeffs.empty() ? tonemap::find_curve(options.name) : nullptr;
    return curve && std::any_of(curve->parameters.begin(), curve->parameters.end(),
                                [&](const auto& parameter) { return parameter.name == name; });
}

} // namespace tonetool
