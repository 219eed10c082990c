// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/curve_plan.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/color/curve_file.h"
#include "imagebuf/color/tone_rows.h"
#include "imagebuf/options/tone_options.h"
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

// What only curves from files have.
void refuse_table_options(const CurveOptions& options) {
    describe(options, [&](const auto& row) {
        if (options.*row.member != CurveOptions().*row.member)
            throw Refusal(format("{}={} is of curves from files", row.key, options.*row.member));
    });
}

std::vector<std::string> given_parameters(const CurveOptions& options) {
    std::vector<std::string> names;
    for (const auto& [name, value] : options.parameters)
        names.push_back(name);
    for (const auto& [name, values] : options.channel_parameters)
        names.push_back(name);
    return names;
}

CurvePlan plan_coefficients(const CurveOptions& options) {
    CurvePlan plan;
    plan.name = "coeffs";
    for (const auto& name : given_parameters(options))
        throw Refusal(name + "= does not go with coeffs=");
    refuse_table_options(options);
    plan.numbers = refusing_as(
        [&](const std::string& why) {
            return "coeffs are " + OIIO::Strutil::join(options.coeffs, ",") + ": " + why;
        },
        [&] { return tonemap::coefficient_curve(options.coeffs); });
    plan_domain(options, CurveDomain::Channel, plan);
    return plan;
}

void check_channel_parameters(const CurveOptions& options, const Curve& curve) {
    for (const auto& [name, values] : options.channel_parameters) {
        const auto row = std::find_if(curve.parameters.begin(), curve.parameters.end(),
                                      [&, &key = name](const auto& p) { return p.name == key; });
        if (row != curve.parameters.end() && !row->per_channel)
            throw Refusal(format("\"{}\" of curve \"{}\" is one number, not one for each channel",
                                 name, curve.name));
        if (values.size() != 3)
            throw Refusal(
                format("\"{}\" has {} numbers: must be 3, R, G and B", name, values.size()));
        if (options.parameters.count(name))
            throw Refusal("\"" + name + "\" is given for all channels and for each");
    }
}

bool differ(const std::array<tonemap::CurveValues, 3>& values) {
    return values[1] != values[0] || values[2] != values[0];
}

// Values of R, G and B, which differ only where the options say so.
std::array<tonemap::CurveValues, 3> channel_values(const CurveOptions& options, const Curve& curve,
                                                   bool flip) {
    std::array<tonemap::CurveValues, 3> values;
    for (size_t c = 0; c < 3; ++c) {
        auto given = options.parameters;
        for (const auto& [name, of_channels] : options.channel_parameters)
            given[name] = of_channels[c];
        values[c] = tonemap::curve_values(curve, given, flip);
    }
    return values;
}

void name_values(const Curve& curve, const std::array<tonemap::CurveValues, 3>& values,
                 CurvePlan& plan) {
    static const char* const channels[] = {".r", ".g", ".b"};
    for (size_t i = 0; i < curve.parameters.size(); ++i) {
        const std::string name = curve.parameters[i].name;
        if (values[0][i] == values[1][i] && values[0][i] == values[2][i])
            plan.parameters[name] = values[0][i];
        else
            for (size_t c = 0; c < 3; ++c)
                plan.parameters[name + channels[c]] = values[c][i];
    }
}

// T(L) is of one curve.
void refuse_luminance(const CurvePlan& plan, bool by_channel) {
    if (by_channel && plan.use.on_luminance)
        throw Refusal(plan.name + " has other curves for R, G and B: on=luminance does not apply "
                                  "to it");
}

CurvePlan plan_named(const CurveOptions& options, bool flip) {
    const Curve* curve = tonemap::find_curve(options.name);
    if (!curve)
        throw Refusal(unknown_name("tone curve", options.name, tonemap::curve_names()) +
                      ", or a file (with a '.' or '/')");
    refuse_table_options(options);
    check_channel_parameters(options, *curve);
    CurvePlan plan;
    plan.name = curve->name;
    const auto values = channel_values(options, *curve, flip);
    name_values(*curve, values, plan);
    plan.numbers = curve->make(values[0]);
    if (differ(values))
        plan.numbers =
            tonemap::of_channels({plan.numbers, curve->make(values[1]), curve->make(values[2])});
    plan_domain(options, curve->domain, plan);
    refuse_luminance(plan, differ(values));
    return plan;
}

double white_of_file(const CurveOptions& options) {
    const std::string file = OIIO::Filesystem::filename(options.name);
    for (const std::string& name : given_parameters(options))
        if (name != "white" || options.channel_parameters.count(name))
            throw Refusal(
                format("curve \"{}\" has no parameter \"{}\" (a file has white)", file, name));
    const auto white = options.parameters.find("white");
    const double value = white == options.parameters.end() ? 1 : white->second;
    if (!(value >= tonemap::kLeastWhite && value <= tonemap::kMostWhite))
        throw Refusal(format("\"white\" of curve \"{}\" cannot be {}; valid: {} to {}", file, value,
                             tonemap::kLeastWhite, tonemap::kMostWhite));
    return value;
}

CurvePlan plan_table(const CurveOptions& options, const std::string& encode) {
    check_options(options);
    tonemap::TableMeaning meaning;
    meaning.white = white_of_file(options);
    meaning.input = options.table_input == "log2"    ? tonemap::TableInput::Log2
                    : options.table_input == "log10" ? tonemap::TableInput::Log10
                                                     : tonemap::TableInput::Linear;
    meaning.output = options.table_output == "encoded"   ? tonemap::TableOutput::Encoded
                     : options.table_output == "density" ? tonemap::TableOutput::Density
                                                         : tonemap::TableOutput::Linear;
    meaning.decode = find_decoding(encode);
    const auto made = refusing_as(
        [&](const std::string& why) {
            const bool named = OIIO::Strutil::starts_with(why, "curve");
            return named ? why : "curve \"" + options.name + "\": " + why;
        },
        [&] { return tonemap::table_curve(read_curve_file(options), meaning); });
    CurvePlan plan;
    plan.name = OIIO::Filesystem::filename(options.name);
    plan.parameters["white"] = meaning.white;
    plan.numbers = made.numbers;
    plan.table = made.facts;
    plan_domain(options, CurveDomain::Channel, plan);
    refuse_luminance(plan, made.facts.by_channel);
    return plan;
}

} // namespace

std::vector<double> CurvePlan::coeffs() const {
    if (numbers.kind != kernels::CurveKind::Rational)
        return {};
    return {numbers.p.begin(), numbers.p.begin() + 6};
}

std::string CurvePlan::table_text() const {
    if (!table)
        return {};
    return format("{} rows of x {:g} to {:g}{}, {}", table->rows, table->low, table->high,
                  table->by_channel ? " for R, G and B" : "",
                  table->falls_at ? format("falling from x = {:g}", *table->falls_at) : "rising");
}

CurvePlan plan_curve(const CurveOptions& options, bool flip, const std::string& encode) {
    if (is_curve_file(options.name))
        return plan_table(options, encode);
    return is_rational(options) ? plan_coefficients(options) : plan_named(options, flip);
}

bool is_rational(const CurveOptions& options) {
    return !options.coeffs.empty() && !is_curve_file(options.name);
}

bool has_parameter(const CurveOptions& options, const std::string& name) {
    if (is_curve_file(options.name))
        return name == "white";
    const Curve* curve = is_rational(options) ? nullptr : tonemap::find_curve(options.name);
    return curve && std::any_of(curve->parameters.begin(), curve->parameters.end(),
                                [&](const auto& parameter) { return parameter.name == name; });
}

} // namespace tonetool
