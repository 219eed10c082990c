// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/flip_args.h"

#include <OpenImageIO/sysutil.h>
#include <algorithm>

#include "chain/commands/frame_pictures.h"
#include "chain/commands/options.h"
#include "chain/commands/tone_args.h"
#include "imagebuf/options/flip_options.h"
#include "imagebuf/options/ignore_options.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

const Strings kFlipCurve = {"tonemapper", "curve"};

std::string choices(const Strings& names) {
    return join(names, "|");
}

void read_screen(const Call& call, FlipOptions& options) {
    if (call.has("ppd") && (call.has("distance") || call.has("width") || call.has("pixels")))
        throw CommandError("ppd= goes without distance=, width= and pixels= (valid: either)");
    read_options(call, options);
}

void check_order(const Call& call, const std::optional<double>& start,
                 const std::optional<double>& stop) {
    if (start && stop && *start > *stop) {
        throw CommandError("startExposure " + *call.text("startExposure") +
                           " is above stopExposure " + *call.text("stopExposure"));
    }
}

} // namespace

const Modifier kPrint = {"print", "0|1",
                         "print nothing but failures (0) or every fact (1), also of frames (a few "
                         "lines of a pair)"};

Modifiers pixel_modifiers() {
    return {
        {"layer", "NAME", "layer whose R,G,B are used, \"ViewLayer.Combined\""},
        {"from", "SPACE", "colour space of the pixels: " + join(ToneAlgo::color_spaces(), ", ")}};
}

Modifiers pair_modifiers() {
    return concatenated(
        {pixel_modifiers(),
         {{"resize", "0|1", "resize the test image to the reference's display window"},
          {"crop", "0|1", "compare only where the display windows meet"},
          {"alpha", "ignore|error", "what becomes of alpha: error: its difference joins the map"}},
         modifiers_of<IgnoreOptions>()});
}

Modifiers hdr_modifiers() {
    return concatenated(
        {{curve_modifier("tonemapper"), {"curve", kCurveHint, "the same as tonemapper="}},
         curve_modifiers(false, true),
         view_modifiers(),
         modifiers_of<HdrFlipOptions>()});
}

Modifiers threshold_modifiers(const Measures& measures, const std::string& unless) {
    Modifiers rows = {
        {"fail", "X|QUANTITY=X,...|auto|JSON",
         "exit status 3 unless the quantity is " + unless +
             (measures.map ? "; p99.9 and max find local faults, which the mean does not" : "") +
             "; auto: by the other frames; JSON: what a check or --noisefloor has measured"},
        {"warn", "X|QUANTITY=X,...|JSON", "a warning unless the quantity is " + unless},
        {"quantity", choices(measures.names) + (measures.map ? "|pNN|above" : ""),
         "what a limit without a name tests (the first)" +
             std::string(measures.map ? "; pNN: any percentile, p99.95" : "")}};
    if (measures.map) {
        rows.push_back({"above", "E",
                        "of the quantity above: the share of pixels whose error is "
                        "above E; also by name, fail=above0.2=0.01"});
    }
    rows.push_back(kPrint);
    return rows;
}

PixelOptions pixel_options(const Call& call, const std::string& prefix) {
    return {call.text(prefix + "layer").value_or(""), call.text(prefix + "from").value_or("")};
}

void read_view_spaces(const std::optional<ViewOptions>& view, PixelOptions& pixels) {
    if (view) {
        pixels.config =
            view->config.empty() ? std::string(OIIO::Sysutil::getenv("OCIO")) : view->config;
        pixels.context = view->context;
    }
}

SizePolicy size_policy(const Call& call) {
    const bool resize = call.flag("resize", false), crop = call.flag("crop", false);
    if (resize && crop)
        throw CommandError("resize=1 and crop=1 exclude each other (valid: one of them)");
    return resize ? SizePolicy::Resize : (crop ? SizePolicy::Crop : SizePolicy::Match);
}

uint64_t memory_for(const Session& session, const Call& call) {
    const uint64_t memory = session.settings.memory;
    return memory - std::min(memory, shown_bytes(session, call));
}

void read_ignored(const Call& call, IgnoreOptions& options) {
    read_options(call, options);
}

void read_pair_options(const Session& session, const Call& call, PairOptions& options) {
    options.memory = memory_for(session, call);
    options.pixels = pixel_options(call);
    options.size = size_policy(call);
    bool error = call.choice("alpha", {"ignore", "error"}).value_or("ignore") == "error";
    options.alpha = error ? AlphaPolicy::Error : AlphaPolicy::Ignore;
    read_ignored(call, options);
}

void read_flip_options(const Session& session, const Call& call, bool screen,
                       FlipOptions& options) {
    read_pair_options(session, call, options);
    if (screen)
        read_screen(call, options);
    else
        options.ppd = call.number("ppd", kPpdRange);
}

void read_hdr_options(const Session& session, const Call& call, HdrFlipOptions& options) {
    check_one_way(call, kFlipCurve);
    options.view = view_options(session, call);
    read_view_spaces(options.view, options.pixels);
    options.curve = curve_options(call, kFlipCurve);
    read_options(call, options);
    if (!options.view && (call.has("encoding") || call.has("peak") || call.has("exact")))
        throw CommandError("encoding=, peak= and exact= need display= or view=");
    check_order(call, options.start_exposure, options.stop_exposure);
}

Modifiers error_modifiers() {
    Measures measures;
    measures.names.insert(measures.names.begin(), "METRIC");
    const std::string in_decibels = join(metrics_that_have(metrics::kDecibels), ", ");
    return concatenated(
        {modifiers_of<ErrorOptions>(), pair_modifiers(),
         threshold_modifiers(measures, "at most X (" + in_decibels + ": at least X dB)")});
}

Measures error_measures(const metrics::ErrorMetric& metric) {
    constexpr double unbounded = 1e30;
    Measures measures;
    measures.names.insert(measures.names.begin(), metric.name);
    measures.scale = [&metric](const std::string& quantity) {
        const bool bounded = metric.has(metrics::kBounded);
        if (quantity == metric.name && metric.has(metrics::kDecibels)) {
            constexpr double least = -300; // of an error of 1e30
            return Scale{bounded ? 0 : least, unbounded};
        }
        return Scale{0, bounded ? 1 : unbounded};
    };
    return measures;
}

ErrorOptions error_options(const Session& session, const Call& call) {
    ErrorOptions options;
    read_pair_options(session, call, options);
    options.metric = call.choice("metric", ToneAlgo::error_metrics()).value_or("");
    if (options.metric.empty())
        throw CommandError("needs metric= (valid: " + join(ToneAlgo::error_metrics(), ", ") + ")");
    constexpr std::pair<const char*, metrics::ErrorTrait> keys[] = {
        {"eps", metrics::kEps},
        {"peak", metrics::kPeak},
        {"startExposure", metrics::kExposures},
        {"stopExposure", metrics::kExposures},
        {"numExposures", metrics::kExposures}};
    for (const auto& [key, trait] : keys) {
        if (call.has(key) && !metrics::find_error_metric(options.metric)->has(trait)) {
            throw CommandError(std::string(key) +
                               "= goes with metric=" + join(metrics_that_have(trait), ", ") +
                               ", not with " + options.metric);
        }
    }
    read_options(call, options);
    check_order(call, options.start_exposure, options.stop_exposure);
    return options;
}

constexpr double kFlipdiffPpd = 67.02; // OpenImageIO's

Modifiers flipdiff_modifiers() {
    return concatenated(
        {{{"hdr", "0|1", "HDR-FLIP (1), or LDR-FLIP"},
          {"maxluminance", "X",
           "luminance that the first exposure suits (2.0); 0: exposures "
           "from the reference"},
          {"medianluminance", "X", "luminance that the last exposure suits (0.18)"},
          {"startExposure", "STOPS", "first exposure"},
          {"stopExposure", "STOPS", "last exposure"},
          {"numExposures", "N", "number of exposures; 0: from their range"},
          {"ppd", "X",
           OIIO::Strutil::fmt::format("pixels per degree of visual angle ({})", kFlipdiffPpd)},
          {"tonemapper", "NAME", "tone curve (aces): " + join(ToneAlgo::flip_tonemappers(), ", ")},
          {"colormap", "NAME", "push the map in these colours, as --colormap"},
          {"layer", "NAME", "layer whose R,G,B are used"},
          {"from", "SPACE", "colour space of the pixels"},
          kPrint,
          {"fail", "X", "exit status 3 unless the largest error is at most X (0 to below 1)"}},
         modifiers_of<IgnoreOptions>()});
}

HdrFlipOptions flipdiff_options(const Session& session, const Call& call) {
    HdrFlipOptions options;
    options.memory = memory_for(session, call);
    options.pixels = pixel_options(call);
    read_ignored(call, options);
    options.ppd = call.number("ppd", kPpdRange).value_or(kFlipdiffPpd);
    options.curve.name =
        call.choice("tonemapper", ToneAlgo::flip_tonemappers()).value_or(options.curve.name);
    options.start_exposure = call.number("startExposure", kStopsRange);
    options.stop_exposure = call.number("stopExposure", kStopsRange);
    check_order(call, options.start_exposure, options.stop_exposure);
    const int count = call.integer("numExposures", {0, flip::kMaxExposures}).value_or(0);
    if (count > 0)
        options.num_exposures = count;
    double maximum = call.number("maxluminance", {-1e30, 1e30}).value_or(2.0);
    double median = call.number("medianluminance", {-1e30, 1e30}).value_or(0.18);
    if (maximum > 0) {
        options.max_luminance = maximum;
        options.median_luminance = median > 0 ? std::optional<double>(median) : std::nullopt;
    }
    return options;
}

} // namespace tonetool::chain
