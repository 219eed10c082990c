// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/tone_args.h"

#include <algorithm>

#include "chain/commands/options.h"
#include "imagebuf/options/shot_options.h"
#include "imagebuf/options/tone_options.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

// One row per name of a parameter; several curves may have it.
struct Parameter {
    std::string name, help;
    Strings curves;
    bool per_channel = false;
};

std::vector<Parameter> parameters(bool flip = false) {
    std::vector<Parameter> all;
    for (const ToneCurveInfo& curve : ToneAlgo::tone_curves()) {
        for (const ToneCurveParameter& parameter : curve.parameters) {
            auto same = [&](const Parameter& p) { return p.name == parameter.name; };
            auto at = std::find_if(all.begin(), all.end(), same);
            if (at == all.end())
                at = all.insert(all.end(), {parameter.name, parameter.help, {}, false});
            double value = flip ? parameter.flip_value : parameter.value;
            at->curves.push_back(curve.name + " " + format_number(value));
            at->per_channel = at->per_channel || parameter.per_channel;
        }
    }
    for (Parameter& parameter : all)
        if (parameter.name == "white")
            parameter.curves.push_back("a file 1");
    return all;
}

// What white= asks to be measured: "max", "p99.9".
bool is_measured(const std::string& white) {
    return white == "max" || (!white.empty() && white[0] == 'p');
}

// "X", or where a curve may have one for each channel "R,G,B".
void read_parameter(const Call& call, const Parameter& parameter, CurveOptions& options) {
    const auto value = call.text(parameter.name);
    if (!value || (parameter.name == "white" && is_measured(*value)))
        return;
    // What is valid depends on the curve.
    if (parameter.per_channel && value->find(',') != std::string::npos)
        options.channel_parameters[parameter.name] = call.numbers(parameter.name, 3);
    else
        options.parameters[parameter.name] = *call.number(parameter.name, {-1e30, 1e30});
}

bool is_file(const std::string& curve) {
    return curve.find_first_of("./") != std::string::npos;
}

// The modifier that names the curve; empty: none does.
std::string given_key(const Call& call, const Strings& keys) {
    std::string given;
    for (const std::string& key : keys) {
        if (call.has(key) && !given.empty())
            throw CommandError(given + "= and " + key + "= are the same (valid: one of them)");
        given = call.has(key) ? key : given;
    }
    return given;
}

// Six, or for a model in a file as many as it takes.
std::vector<double> read_coeffs(const Call& call, bool of_file) {
    const auto value = call.text("coeffs");
    const size_t count = value ? split(*value, ',').size() : 6;
    return call.numbers("coeffs", of_file ? count : 6);
}

} // namespace

Modifier curve_modifier(const std::string& key, const std::string& what) {
    return {key, kCurveHint,
            what + ", or a file with a measured one, as .csv, .spi1d, .cube or .clf: " +
                join(ToneAlgo::tone_curve_names(), ", ")};
}

Modifiers curve_modifiers(bool measured, bool flip) {
    Modifiers rows;
    for (const Parameter& p : parameters(flip)) {
        bool white = measured && p.name == "white";
        rows.push_back({p.name,
                        white           ? "X|max|pN"
                        : p.per_channel ? "X|R,G,B"
                                        : "X",
                        p.help + (white ? ", or the image's maximum or percentile" : "") + " (" +
                            join(p.curves, ", ") + ")",
                        true});
    }
    rows.push_back({"coeffs", "K0,K1,K2,K3,K4,K5",
                    "curve (k0 x2 + k1 x + k2) / (k3 x2 + k4 x + k5); of a file with a model of "
                    "camera responses: weights of its base functions"});
    rows.push_back({"on", "rgb|luminance", "what the curve is applied to (as it is meant)"});
    rows.push_back({"saturation", "X", "of curves on luminance, 0 to 4 (1)"});
    return concatenated({rows, modifiers_of<CurveOptions>()});
}

CurveOptions curve_options(const Call& call, const Strings& keys) {
    CurveOptions options;
    const std::string key = given_key(call, keys);
    const std::string name = key.empty() ? options.name : *call.text(key);
    const bool file = is_file(name);
    options.coeffs = read_coeffs(call, file);
    if (!key.empty() && !file && !options.coeffs.empty())
        throw CommandError(key + "= and coeffs= exclude each other (valid: one of them)");
    options.name = file || key.empty() ? name : *call.choice(key, ToneAlgo::tone_curve_names());
    for (const Parameter& p : parameters())
        read_parameter(call, p, options);
    read_options(call, options);
    options.on = call.choice("on", {"rgb", "luminance"}).value_or("");
    options.saturation = call.number("saturation", {0, 4}).value_or(1.0);
    return options;
}

Modifiers view_modifiers() {
    return {{"display", "NAME", "display of the OpenColorIO configuration (its default)"},
            {"view", "NAME", "view of that display (its default)"},
            {"looks", "LOOKS", "instead of the view's own looks: \"+a,-b\""},
            {"context", "NAME=VALUE,...", "context variables of the configuration"}};
}

std::optional<ViewOptions> view_options(const Session& session, const Call& call) {
    ViewOptions options;
    options.config = session.settings.color_config;
    options.display = call.text("display").value_or("");
    options.view = call.text("view").value_or("");
    options.looks = call.text("looks").value_or("");
    for (const std::string& pair : split(call.text("context").value_or(""), ',')) {
        size_t equals = pair.find('=');
        if (equals != std::string::npos && equals > 0)
            options.context.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
        else if (!pair.empty())
            throw CommandError("context \"" + pair + "\" is not NAME=VALUE");
    }
    if (call.has("display") || call.has("view"))
        return options;
    if (call.has("looks") || call.has("context"))
        throw CommandError("looks= and context= need display= or view=");
    return std::nullopt;
}

void check_one_way(const Call& call, const Strings& keys) {
    if (!call.has("display") && !call.has("view"))
        return;
    Strings of_curves = keys;
    for (const Modifier& modifier : curve_modifiers(false))
        of_curves.push_back(modifier.key);
    for (const std::string& name : of_curves) {
        if (call.has(name)) {
            throw CommandError(name + "= is of tone curves and does not go with a view "
                                      "(valid: either)");
        }
    }
}

CalibrationOptions calibration_options(const Call& call) {
    CalibrationOptions options;
    auto method = call.choice("method", {"manual", "mean", "auto", "camera"}).value_or("manual");
    options.method = method == "mean"     ? CalibrationMethod::Mean
                     : method == "auto"   ? CalibrationMethod::AutoKey
                     : method == "camera" ? CalibrationMethod::Camera
                                          : CalibrationMethod::Manual;
    if (call.has("key") && options.method != CalibrationMethod::Mean)
        throw CommandError("key= is of a calibration by mean, this one is " + method);
    read_options(call, options);
    read_options(call, options.adapt);
    return options;
}

std::optional<double> white_percentile(const Call& call) {
    auto white = call.text("white");
    if (!white || !is_measured(*white))
        return std::nullopt;
    return *white == "max" ? 100.0 : checked_number("white=p", white->substr(1), {0.001, 100});
}

} // namespace tonetool::chain
