#include "imagebuf/color/curve_plan.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/pixels/names.h"
#include "tonemap/curves.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using tonemap::Curve;
using tonemap::CurveDomain;

// What the curve is applied to, where the curve leaves a choice.
bool plan_domain(const CurveOptions& options, CurveDomain domain, CurvePlan& plan,
                 std::string& error) {
    if (!options.on.empty() && options.on != "rgb" && options.on != "luminance") {
        error = "on is \"" + options.on + "\"; valid: rgb, luminance";
        return false;
    }
    if (domain == CurveDomain::Color && !options.on.empty()) {
        error = plan.name + " mixes the channels: on=" + options.on + " does not apply to it";
        return false;
    }
    const bool luminance =
        options.on.empty() ? domain == CurveDomain::Luminance : options.on == "luminance";
    if (!(options.saturation >= 0 && options.saturation <= 4)) {
        error = format("saturation is {}: must be 0 to 4", options.saturation);
        return false;
    }
    if (options.saturation != 1 && !luminance) {
        error = format("saturation={} is of curves on luminance: {} is not applied so",
                       options.saturation, plan.name);
        return false;
    }
    plan.on = domain == CurveDomain::Color ? "color" : luminance ? "luminance" : "rgb";
    plan.use.on_luminance = luminance;
    plan.use.saturation = options.saturation;
    return true;
}

bool plan_coefficients(const CurveOptions& options, CurvePlan& plan, std::string& error) {
    plan.name = "coeffs";
    if (!options.parameters.empty()) {
        error = options.parameters.begin()->first + "= does not go with coeffs=";
        return false;
    }
    if (!tonemap::coefficient_curve(options.coeffs, plan.numbers, error)) {
        error = "coeffs are " + OIIO::Strutil::join(options.coeffs, ",") + ": " + error;
        return false;
    }
    return plan_domain(options, CurveDomain::Channel, plan, error);
}

bool plan_named(const CurveOptions& options, bool flip, CurvePlan& plan, std::string& error) {
    const Curve* curve = tonemap::find_curve(options.name);
    if (!curve) {
        error = unknown_name("tone curve", options.name, tonemap::curve_names());
        return false;
    }
    plan.name = curve->name;
    tonemap::CurveValues values;
    if (!tonemap::curve_values(*curve, options.parameters, flip, values, error))
        return false;
    for (size_t i = 0; i < values.size(); ++i)
        plan.parameters[curve->parameters[i].name] = values[i];
    plan.numbers = curve->make(values);
    return plan_domain(options, curve->domain, plan, error);
}

} // namespace

std::vector<double> CurvePlan::coeffs() const {
    if (numbers.kind != kernels::CurveKind::Rational)
        return {};
    return {numbers.p.begin(), numbers.p.begin() + 6};
}

bool plan_curve(const CurveOptions& options, bool flip, CurvePlan& plan, std::string& error) {
    return options.coeffs.empty() ? plan_named(options, flip, plan, error)
                                  : plan_coefficients(options, plan, error);
}

bool has_parameter(const CurveOptions& options, const std::string& name) {
    const Curve* curve = options.coeffs.empty() ? tonemap::find_curve(options.name) : nullptr;
    return curve && std::any_of(curve->parameters.begin(), curve->parameters.end(),
                                [&](const auto& parameter) { return parameter.name == name; });
}

} // namespace tonetool
