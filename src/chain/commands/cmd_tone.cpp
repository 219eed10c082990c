// SPDX-License-Identifier: BSD-3-Clause
// Commands that show HDR images: calibration, tone curves, views.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <ostream>

#include "chain/commands/adapt_args.h"
#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/options.h"
#include "chain/commands/tone_args.h"
#include "imagebuf/options/shot_options.h"
#include "imagebuf/options/tone_options.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

void add_calibration(Lines& lines, const CalibrationSummary& found) {
    if (found.mean > 0) {
        lines.add("mean", found.mean);
        lines.add("key", found.key);
    }
    lines.add("exposure", found.exposure);
    lines.add_positive("unit", found.unit);
    if (found.ev100)
        lines.add("ev100", *found.ev100);
    lines.add_positive("white", found.white);
    if (!found.adapted.empty())
        lines.add("adapted", found.adapted);
}

void add_notes(Lines& lines, const Session& session, const CalibrationSummary& found) {
    if (session.settings.verbose)
        for (const std::string& note : found.notes)
            lines.add("note", note);
}

void run_calibrate(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    PixelOptions pixels = pixel_options(call);
    OIIO::ImageBuf source = color_input(session, call, image, pixels);
    CalibrationOptions options = calibration_options(call);
    options.show = call.choice("show", calibration_parts()).value_or("");
    adapt_to_shot(session, call, source, pixels, options.adapt);
    CalibrationSummary found;
    OIIO::ImageBuf result;
    if (!ToneAlgo::calibrate(result, source, options, pixels, &found))
        throw CommandError(result.geterror());
    Lines lines(call.row().label());
    add_calibration(lines, found);
    add_notes(lines, session, found);
    session.report(lines.text);
    for (const std::string& warning : found.warnings)
        session.warning(call.row().label(), image.name() + ": " + warning);
    push_picture(session, image, pixels, std::move(result));
}

TonemapOptions tonemap_options(const Session& session, const Call& call) {
    TonemapOptions options;
    check_one_way(call, {"curve"});
    options.pixels = pixel_options(call);
    options.view = view_options(session, call);
    options.curve = curve_options(call, {"curve"});
    options.calibration = calibration_options(call);
    options.calibration.white_percentile = white_percentile(call);
    if (options.view && (call.has("encode") || call.has("primaries") || call.has("clamp")))
        throw CommandError("encode=, primaries= and clamp= are of tone curves: a view has its own");
    read_options(call, options);
    return options;
}

void run_tonemap(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    const std::string label = call.row().label();
    TonemapOptions options = tonemap_options(session, call);
    // The configuration of a view defines its own colour spaces.
    PixelOptions checked = options.pixels;
    checked.from = options.view ? "rec709" : checked.from;
    OIIO::ImageBuf source = color_input(session, call, image, checked);
    adapt_to_shot(session, call, source, options.pixels, options.calibration.adapt);
    TonemapSummary found;
    OIIO::ImageBuf result;
    if (!ToneAlgo::tonemap(result, source, options, &found))
        throw CommandError(result.geterror());
    Lines lines(label);
    lines.add("curve", found.curve);
    for (const auto& [name, value] : found.parameters)
        lines.add(name, value);
    if (!found.table.empty())
        lines.add("table", found.table);
    add_calibration(lines, found.calibration);
    add_notes(lines, session, found.calibration);
    if (session.settings.verbose && found.negative > 0)
        lines.add("negative", found.negative);
    session.report(lines.text);
    for (const std::string& warning : found.warnings)
        session.warning(label, image.name() + ": " + warning);
    push_picture(session, image, checked, std::move(result));
}

void print_curve(Session& session, const ToneCurveInfo& curve) {
    session.print(curve.name + ": " + curve.title + "; on " + curve.domain);
    session.print("    " + curve.formula);
    for (const ToneCurveParameter& p : curve.parameters) {
        session.print("    " + p.name + "=" + format_number(p.value) + "  " + p.help + ", " +
                      format_number(p.low) + " to " + format_number(p.high));
    }
    if (!curve.coefficients.empty()) {
        Strings numbers;
        for (double k : curve.coefficients)
            numbers.push_back(format_number(k));
        session.print("    coeffs=" + join(numbers, ","));
    }
    if (!curve.note.empty())
        session.print("    " + curve.note);
    session.print("    from: " + curve.source);
}

// A table of stops and display-linear values, with a column for each curve.
void print_table(Session& session, const Strings& names, const std::vector<CurveOptions>& curves) {
    session.print("stops," + join(names, ","));
    constexpr int first = -12, last = 12, per_stop = 4;
    std::vector<double> light;
    for (int i = first * per_stop; i <= last * per_stop; ++i)
        light.push_back(std::exp2(double(i) / per_stop));
    std::vector<Strings> rows(light.size());
    for (size_t i = 0; i < rows.size(); ++i)
        rows[i].push_back(format_number(double(first) + double(i) / per_stop));
    for (const CurveOptions& curve : curves) {
        std::vector<double> shown;
        std::string why;
        if (!ToneAlgo::tone_curve_response(shown, curve, light, why))
            throw CommandError(why);
        for (size_t i = 0; i < rows.size(); ++i)
            rows[i].push_back(format_number(std::min(1.0, std::max(0.0, shown[i]))));
    }
    for (const Strings& row : rows)
        session.print(join(row, ","));
}

// Those of the registry, or the one that is asked for, with what is said of it.
std::vector<ToneCurveInfo> listed_curves(const Call& call, std::vector<CurveOptions>& curves) {
    const CurveOptions asked = curve_options(call, {"curve"});
    if (!asked.coeffs.empty() && !call.has("curve"))
        throw CommandError("coeffs= needs the curve= of a file here");
    std::vector<ToneCurveInfo> all;
    for (const ToneCurveInfo& row : ToneAlgo::tone_curves()) {
        if (call.has("curve") && row.name != asked.name)
            continue;
        all.push_back(row);
        curves.push_back(asked);
        curves.back().name = row.name;
    }
    if (!all.empty())
        return all;
    std::string why;
    all.emplace_back();
    curves.push_back(asked);
    if (!ToneAlgo::tone_curve_of_file(all.back(), asked, why))
        throw CommandError(why);
    return all;
}

void run_tonecurves(Session& session, const Call& call) {
    std::vector<CurveOptions> curves;
    const auto listed = listed_curves(call, curves);
    if (call.flag("table", false)) {
        Strings names;
        for (const ToneCurveInfo& curve : listed)
            names.push_back(curve.name);
        print_table(session, names, curves);
    } else {
        for (const ToneCurveInfo& curve : listed)
            print_curve(session, curve);
    }
    session.outcome.produced = true;
}

bool has_white(const CurveOptions& options) {
    if (options.name.find_first_of("./") != std::string::npos)
        return true; // a file
    for (const ToneCurveInfo& curve : ToneAlgo::tone_curves())
        for (const ToneCurveParameter& parameter : curve.parameters)
            if (options.coeffs.empty() && curve.name == options.name && parameter.name == "white")
                return true;
    return false;
}

// white= of a curve that has no such parameter is that of the file.
void take_white(const Call& call, LutOptions& options) {
    const auto white = options.curve.parameters.find("white");
    const bool of_file = OIIO::Strutil::iends_with(call.argument(0), ".acv");
    if (!of_file || white == options.curve.parameters.end())
        return;
    options.white = white->second;
    if (!has_white(options.curve))
        options.curve.parameters.erase(white);
}

LutOptions lut_options(const Session& session, const Call& call) {
    LutOptions options;
    check_one_way(call, {"curve"});
    options.curve = curve_options(call, {"curve"});
    options.view = view_options(session, call);
    if (options.view && call.has("encode"))
        throw CommandError("encode= is of tone curves: a view has its own");
    read_options(call, options);
    take_white(call, options);
    return options;
}

void run_exportlut(Session& session, const Call& call) {
    LutSummary made;
    std::string why;
    const auto options = lut_options(session, call);
    session.outcome.produced = true;
    if (session.settings.dry_run)
        return;
    if (!ToneAlgo::export_lut(call.argument(0), options, &made, why))
        throw CommandError(why);
    Lines lines(call.row().label());
    lines.add("file", call.argument(0) + ", " + made.structure);
    lines.add("input", made.input);
    lines.add("range", format_number(made.low) + " to " + format_number(made.high));
    lines.add("error max",
              format_number(made.max_error) + " mean " + format_number(made.mean_error));
    lines.add("grey-error max", made.grey_max_error);
    session.report(lines.text);
    session.out.flush();
    if (!session.settings.quiet)
        for (const std::string& remark : made.remarks)
            session.complaints() << call.row().label() << ": " << remark << std::endl;
}

// What a curve or a view is, for --tonemap and --exportlut.
Modifiers display_modifiers(bool measured) {
    return concatenated({{curve_modifier("curve")}, curve_modifiers(measured), view_modifiers()});
}

// How an exposure is measured.
Modifiers method_modifiers() {
    return concatenated({{{"method", "manual|mean|auto|camera",
                           "exposure: stops alone, from the geometric mean, with a key from the "
                           "mean in cd/m2, by a camera (manual)"}},
                         modifiers_of<CalibrationOptions>(),
                         modifiers_of<AdaptOptions>()});
}

ShotNeed need_of_calibration(const Call& call) {
    return shot_need(call, calibration_options(call));
}

ShotNeed need_of_tonemap(const Call& call) {
    CalibrationOptions options = calibration_options(call);
    options.white_percentile = white_percentile(call);
    return shot_need(call, options);
}

} // namespace

Rows tone_commands() {
    return {
        command("calibrate", "Multiply the colour by an exposure that is measured", run_calibrate)
            .images(1, 1)
            .modifiers(method_modifiers(), pixel_modifiers())
            .modifier("show", join(calibration_parts(), "|"), calibration_parts_text())
            .measures_shots(need_of_calibration)
            .keeps_header(),
        command("tonemap", "HDR to a display, by a tone curve or an OpenColorIO view", run_tonemap)
            .images(1, 1)
            .modifiers(display_modifiers(true), method_modifiers(), modifiers_of<TonemapOptions>(),
                       pixel_modifiers())
            .measures_shots(need_of_tonemap)
            .frequent("curve,stops,method,display,view,encode,layer,from")
            .keeps_header(),
        command("exportlut FILE",
                "Write a tone curve or a view as ." + join(ToneAlgo::lut_formats(), ", ."),
                run_exportlut)
            .in(Group::Write)
            .modifiers(display_modifiers(false), modifiers_of<LutOptions>())
            .frequent("curve,display,view,size"),
        command("tonecurves", "Print all tone curves: parameters, formulas, sources",
                run_tonecurves)
            .in(Group::Print)
            .modifiers(
                Modifiers{curve_modifier("curve", "this one alone (all)")},
                Modifiers{{"table", "0|1", "as numbers: stops, and the light of each curve (0)"}},
                curve_modifiers(false)),
    };
}

} // namespace tonetool::chain
