// SPDX-License-Identifier: BSD-3-Clause
// The registry of tone curves as the public header shows it.
#include "imagebuf/color/curve_file.h"
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
        info.parameters.push_back({p.name, p.help, p.value, p.low, p.high,
                                   p.flip_value.value_or(p.value), p.per_channel});
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

bool tone_curve_of_file(ToneCurveInfo& info, const CurveOptions& curve, std::string& error) {
    return contained(error, [&] {
        if (!is_curve_file(curve.name))
            throw Refusal("\"" + curve.name + "\" is no file (valid: a name with a '.' or '/')");
        const CurvePlan plan = plan_curve(curve, false);
        ToneCurveInfo found;
        found.name = plan.name;
        found.title = "a measured curve";
        found.source = curve.name;
        found.formula = "y by straight lines between the rows of the file, its ends held";
        found.note = plan.table_text();
        found.domain = plan.on;
        found.parameters = {{"white", "the scene light that is x = 1", 1, tonemap::kLeastWhite,
                             tonemap::kMostWhite, 1, false}};
        info = found;
    });
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
