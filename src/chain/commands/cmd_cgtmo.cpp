// SPDX-License-Identifier: BSD-3-Clause
// The local tone mapper of rendered images.
#include <algorithm>

#include "chain/commands/adapt_args.h"
#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/light_args.h"
#include "chain/commands/options.h"
#include "imagebuf/options/cgtmo_options.h"
#include "imagebuf/options/shot_options.h"
#include "imagebuf/options/tone_options.h"
#include "imagebuf/pixels/layer_name.h"
#include "sequence/frames/frame_range.h"
#include "text/error.h"
#include "tonetool/shot.h"

namespace tonetool::chain {

namespace {

CgTmoOptions options_of(const Call& call) {
    CgTmoOptions options;
    options.pixels = pixel_options(call);
    options.lights = light_options(call);
    options.lights.layer = call.text("lightindex").value_or("");
    read_options(call, options);
    read_options(call, options.adapt);
    return options;
}

void report_summary(Session& session, const std::string& label, const CgTmoSummary& found) {
    auto line = [&](const char* name, const std::string& value) {
        session.report(label + ": " + name + " " + value);
    };
    line("layer", shown_layer(found.layer));
    line("position", found.position.empty() ? "none" : found.position);
    line("normal", found.normal.empty() ? "none" : found.normal);
    line("albedo", found.albedo.empty() ? "none" : found.albedo);
    if (session.settings.verbose)
        for (const std::string& note : found.notes)
            line("note", note);
    if (session.settings.verbose && found.negative > 0)
        line("negative", std::to_string(found.negative));
    line("samples", std::to_string(found.samples));
    line("background", std::to_string(found.background));
    line("counted", std::to_string(found.counted));
    line("footprint", format_number(found.footprint));
    line("light-index", found.light_index.empty() ? "none" : found.light_index);
    line("adaptation", format_number(found.adaptation));
    line("adaptation-from", found.adaptation_from);
    if (found.ev100) {
        line("unit", format_number(found.unit));
        line("ev100", format_number(*found.ev100));
    }
    line("maximum", format_number(found.maximum));
    line("maximum-from",
         found.maximum_from + (found.maximum_light.empty() ? "" : " " + found.maximum_light));
    if (!found.adapted.empty())
        line("adapted", found.adapted);
    if (!found.steady.empty())
        line("steady", "by frames " + sequence::range_text(found.steady));
}

// In the run that makes the frame for others, that is all.
void keep_frame(Session& session, const OIIO::ImageBuf& image, const CgTmoOptions& options) {
    std::string why;
    if (!ToneAlgo::steady_frame(session.shot.frame->frame, image, why, options))
        throw CommandError(why);
    throw EndOfRun();
}

// In the run that measures the shot.
void find_camera(Session& session, const OIIO::ImageBuf& image, const CgTmoOptions& options) {
    std::string why;
    if (!ToneAlgo::frame_camera(session.shot.light->camera, image, why, options))
        throw CommandError(why);
}

// The frames about this one.
void find_frames(Session& session, const Call& call, CgTmoOptions& options) {
    if (!session.shot.find)
        throw CommandError("steady=1 needs the frames about this one, and the image is no frame of "
                           "a sequence (valid: --frames N s.#.exr)");
    std::vector<int> numbers;
    std::string why;
    if (!ToneAlgo::steady_window(numbers, options.adapt, why))
        throw CommandError(why);
    for (const int number : numbers) {
        const ShotFrame found = session.shot.find(call.at, number);
        options.frames[number] = found.frame;
        for (const std::string& file : found.files)
            session.files.note(file);
    }
}

void run_cgtmo(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    const std::string label = call.row().label();
    CgTmoOptions options = options_of(call);
    OIIO::ImageBuf source = color_source(session, call, image, options.pixels);
    const bool here = session.shot.at == call.at;
    if (session.shot.frame && here)
        keep_frame(session, source, options);
    if (session.shot.light && here && options.steady)
        find_camera(session, source, options);
    adapt_to_shot(session, call, source, options.pixels, options.adapt);
    const bool adapts = options.adapt.adapt != "frame" || !options.adapt.statistics.frames.empty();
    if (options.steady && adapts)
        find_frames(session, call, options);
    CgTmoSummary found;
    OIIO::ImageBuf result;
    if (!ToneAlgo::cg_tmo(result, source, options, &found))
        throw CommandError(result.geterror());
    report_summary(session, label, found);
    for (const std::string& warning : found.warnings)
        session.warning(label, image.name() + ": " + warning);
    push_picture(session, image, options.pixels, std::move(result));
}

// With those of the lights behind the percentile that is the maximum.
Modifiers cgtmo_modifiers() {
    Modifiers all = modifiers_of<CgTmoOptions>();
    const Modifiers of_lights =
        concatenated({{{"lightindex", "LAYER|FILE",
                        "index of each pixel's light; groups: by the groups (found)"}},
                      modifiers_of<LightOptions>()});
    const auto maximum = std::find_if(
        all.begin(), all.end(), [](const Modifier& row) { return row.key == "maxpercentile"; });
    all.insert(maximum + 1, of_lights.begin(), of_lights.end());
    return concatenated({all, modifiers_of<AdaptOptions>()});
}

} // namespace

Rows cgtmo_commands() {
    return {
        command("cgtmo",
                "HDR to a display locally, guided by the render's position, normal and albedo",
                run_cgtmo)
            .images(1, 1)
            .modifiers(cgtmo_modifiers(), pixel_modifiers())
            .measures_shots([](const Call& call) { return shot_need(call, options_of(call)); })};
}

} // namespace tonetool::chain
