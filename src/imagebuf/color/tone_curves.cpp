// SPDX-License-Identifier: BSD-3-Clause
// The registry of tone curves as the public header shows it.
#include "imagebuf/color/curve_plan.h"
#include "imagebuf/pixels/guard.h"
#include "kernels/curve_reference.h"
#include "tonemap/curves.h"
#include "tonetool/tonemap.h"

namespace tonetool {
namespace {

ToneCurveInfo info_of(const tonemap::Curve& curve) {
    static const char* const domains[] = {"rgb", "luminance", "color"};
    ToneCurveInfo info;
    info.name = curve.name;
    info.title = curve.title;
    info.source = curve.source;
    info.formula = curve.formula;
    info.note = curve.note;
    info.domain = domains[size_t(curve.domain)];
    info.encoded = curve.encoded;
    for (const auto& p : curve.parameters)
        info.parameters.push_back(
            {p.name, p.help, p.value, p.low, p.high, p.flip_value.value_or(p.value)});
    CurveOptions options;
    options.name = curve.name;
    info.coefficients = plan_curve(options, false).coeffs();
    return info;
}

} // namespace

namespace ToneAlgo {

std::vector<ToneCurveInfo> tone_curves() {
    std::vector<ToneCurveInfo> all;
    for (const auto& curve : tonemap::all_curves())
        all.push_back(info_of(curve));
    return all;
}

std::vector<std::string> tone_curve_names() {
    return tonemap::curve_names();
}

bool tone_curve_response(std::vector<double>& response, const CurveOptions& curve,
                         const std::vector<double>& values, std::string& error) {
    return contained(error, [&] {
        const CurvePlan plan = plan_curve(curve, false);
        response.clear();
        for (double x : values)
            response.push_back(kernels::curve_reference(plan.numbers, x));
    });
}

} // namespace ToneAlgo
} // namespace tonetool
