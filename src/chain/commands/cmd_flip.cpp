// SPDX-License-Identifier: BSD-3-Clause
// FLIP of a test image against a reference.
#include "chain/commands/attribute_args.h"
#include "chain/commands/comparing.h"
#include "chain/commands/frame_pictures.h"
#include "chain/commands/shot_args.h"
#include "chain/images/colormap.h"
#include "imagebuf/options/flip_options.h"
#include "sequence/results/measuring.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

void show_flip(Session& session, const Call& call, sequence::PictureRequest request,
               const OIIO::ImageBuf& map, const FlipResult& result) {
    request.error = &map;
    request.exposures = result.summary.exposures;
    if (result.exposure_stops.initialized())
        request.stops = &result.exposure_stops;
    show(session, call, std::move(request));
}

bool judge_flip(Session& session, const Call& call, const Limits& limits,
                const FlipSummary& summary, size_t test = 0) {
    const FlipPool& pool = summary.pool;
    const auto measure = [&](const std::string& quantity) {
        return ToneAlgo::flip_quantity(pool, quantity).value();
    };
    return judge(session, call, limits, measure, sequence::Position{pool.max_x, pool.max_y}, test,
                 summary.ignored);
}

// ---- hdrflip

int hdrflip_pushes(const Call& call) {
    return test_count(call) * (call.has("exposuremap") ? 2 : 1);
}

void save(Session& session, const OIIO::ImageBuf& image, const std::string& filename) {
    session.claim(filename);
    if (session.settings.dry_run)
        return;
    session.stack.keep_pixels_of(filename);
    std::string why;
    if (!write_image(image, filename, why))
        throw CommandError(why);
}

void save_exposures(Session& session, const Call& call, const FlipResult& result, size_t test) {
    std::string of_test = test_count(call) > 1 ? ".t" + std::to_string(test + 1) : "";
    std::string start = call.text("saveexposures").value_or("") + of_test;
    for (size_t i = 0; i < result.exposures.size(); ++i) {
        std::string name = start + (i < 10 ? ".0" : ".") + std::to_string(i);
        save(session, result.exposures[i].reference, name + ".reference.exr");
        save(session, result.exposures[i].test, name + ".test.exr");
        save(session, result.exposures[i].flip, name + ".flip.exr");
    }
}

Limits read_hdrflip(Session& session, const Call& call, HdrFlipOptions& options) {
    read_flip_options(session, call, true, options);
    read_hdr_options(session, call, options);
    return limits_of(session, call, {}, options.quantities);
}

void check_hdrflip(Session& session, const Call& call) {
    HdrFlipOptions options;
    (void)read_hdrflip(session, call, options);
    (void)attribute_options(call, options, "hdrflip");
}

void run_hdrflip(Session& session, const Call& call) {
    HdrFlipOptions options;
    const Limits limits = read_hdrflip(session, call, options);
    read_shot_exposures(session, call, options);
    auto exposure_map = call.choice("exposuremap", {"stops", "index"});
    options.want_exposure_map = exposure_map || shown_bytes(session, call) > 0;
    options.want_exposures = call.has("saveexposures");
    const auto attributed = attribute_options(call, options, "hdrflip");
    std::vector<FlipResult> results;
    auto [views, maps] =
        compare_tests(session, call, {options.pixels, options.pixels},
                      [&](Maps& to, auto& reference, auto& tests) {
                          return ToneAlgo::hdr_flip(to, reference, tests, options, &results);
                      });
    for (size_t i = 0; i < maps.size(); ++i) {
        FlipResult& result = results[i];
        tell_summary(session, call, result.summary, limits, i);
        judge_flip(session, call, limits, result.summary, i);
        attribute_error(session, call, attributed, maps[i], i);
        save_exposures(session, call, result, i);
        sequence::PictureRequest request = pair_request(views, i);
        request.look = options;
        show_flip(session, call, std::move(request), maps[i], result);
        if (exposure_map) {
            push_map(session, call,
                     std::move(*exposure_map == "stops" ? result.exposure_stops
                                                        : result.exposure_index));
        }
        push_map(session, call, std::move(maps[i]));
    }
}

// ---- one test

Limits read_ldrflip(Session& session, const Call& call, HdrFlipOptions& options) {
    read_flip_options(session, call, true, options);
    return limits_of(session, call, {}, options.quantities);
}

void check_ldrflip(Session& session, const Call& call) {
    HdrFlipOptions options;
    (void)read_ldrflip(session, call, options);
    (void)attribute_options(call, options, "ldrflip");
}

void run_ldrflip(Session& session, const Call& call) {
    HdrFlipOptions options; // of which LDR-FLIP has those of FlipOptions
    const Limits limits = read_ldrflip(session, call, options);
    FlipResult result;
    auto [views, maps] =
        compare_tests(session, call, same_look(call), [&](Maps& to, auto& reference, auto& tests) {
            return ToneAlgo::ldr_flip(to[0], reference, *tests[0], options, &result);
        });
    tell_summary(session, call, result.summary, limits);
    judge_flip(session, call, limits, result.summary);
    attribute_error(session, call, attribute_options(call, options, "ldrflip"), maps[0]);
    sequence::PictureRequest request = pair_request(views);
    static_cast<FlipOptions&>(request.look) = options;
    request.hdr = false;
    show_flip(session, call, std::move(request), maps[0], result);
    push_map(session, call, std::move(maps[0]));
}

void run_flipdiff(Session& session, const Call& call) {
    HdrFlipOptions options = flipdiff_options(session, call);
    bool hdr = call.flag("hdr", true);
    const auto* measuring = sequence::measuring_command(call.row().label());
    const Limits limits =
        limits_of(session, call, {{measuring->quantity}, false}, options.quantities);
    auto colors = call.text("colormap");
    if (colors)
        check_colormap(*colors);
    options.want_exposure_map = hdr && shown_bytes(session, call) > 0;
    FlipResult result;
    auto [views, maps] =
        compare_tests(session, call, same_look(call), [&](Maps& to, auto& reference, auto& tests) {
            return hdr ? ToneAlgo::hdr_flip(to[0], reference, *tests[0], options, &result)
                       : ToneAlgo::ldr_flip(to[0], reference, *tests[0], options, &result);
        });
    tell_summary(session, call, result.summary, limits);
    if (judge_flip(session, call, limits, result.summary))
        session.print("FAILURE");
    else if (!limits.empty())
        session.report("PASS");
    sequence::PictureRequest request = pair_request(views);
    request.look = options;
    request.hdr = hdr;
    show_flip(session, call, std::move(request), maps[0], result);
    push_map(session, call, colors ? colored(maps[0], *colors) : std::move(maps[0]));
}

void run_filmstrip(Session& session, const Call& call) {
    HdrFlipOptions options;
    read_flip_options(session, call, false, options);
    read_hdr_options(session, call, options);
    const Limits limits = limits_of(session, call, {}, options.quantities);
    ToneAlgo::FilmstripOptions look;
    look.thumb_width = call.integer("width", {32, 4096}).value_or(look.thumb_width);
    look.max_columns = call.integer("columns", {1, 1024}).value_or(look.max_columns);
    look.font = call.text("font").value_or(look.font);
    FlipResult result;
    auto [views, maps] = compare_tests(
        session, call, same_look(call, true), [&](Maps& to, auto& reference, auto& tests) {
            return ToneAlgo::flip_filmstrip(to[0], reference, *tests[0], options, look, &result);
        });
    tell_summary(session, call, result.summary, limits);
    judge_flip(session, call, limits, result.summary);
    maps[0].specmod().attribute("oiio:ColorSpace", "sRGB");
    push_result(session, call, std::move(maps[0])); // upright already
}

// ---- rows

Row hdrflip_row() {
    return command("hdrflip", "HDR-FLIP: reference, test -> error map", run_hdrflip)
        .checked(check_hdrflip)
        .images(2, 1)
        .images_of(compared_pops, hdrflip_pushes)
        .modifiers(hdr_modifiers(), modifiers_of<FlipOptions>(), pair_modifiers())
        .modifier(
            "exposures", "frame|shot|FILE",
            "range of the exposures: each frame's own (frame), one of the whole shot, or what "
            "--statistics or --json wrote into FILE")
        .modifier("exposuremap", "stops|index",
                  "push the exposure of the largest error below the map")
        .modifier("saveexposures", "PREFIX",
                  "write PREFIX.NN.reference.exr, .test.exr and .flip.exr")
        .modifier("tests", "K", "compare K tests with the one reference below them")
        .modifiers(attribute_modifiers(), threshold_modifiers())
        .frequent("fail,warn,layer,from,startExposure,stopExposure,numExposures,exposures,"
                  "tonemapper,view,ppd")
        .makes_map();
}

Row filmstrip_row() {
    return command("filmstrip", "HDR-FLIP as a picture: every exposure of both images and its map",
                   run_filmstrip)
        .images(2, 1)
        .modifiers(hdr_modifiers(), Modifiers{modifiers_of<FlipOptions>().front()},
                   pair_modifiers())
        .modifier("width", "PIXELS", "width of one picture (240)")
        .modifier("columns", "N", "at most this many exposures are shown (9)")
        .modifier("font", "FILE", "font of the labels (DejaVu Sans)")
        .modifiers(threshold_modifiers())
        .frequent("width,columns,layer,startExposure,stopExposure,numExposures,tonemapper");
}

} // namespace

Rows flip_commands() {
    return {hdrflip_row(),
            command("ldrflip", "LDR-FLIP: reference, test -> error map", run_ldrflip)
                .checked(check_ldrflip)
                .images(2, 1)
                .modifiers(modifiers_of<FlipOptions>(), pair_modifiers(), attribute_modifiers(),
                           threshold_modifiers())
                .frequent("fail,warn,layer,from,ppd")
                .makes_map(),
            command("flipdiff",
                    "FLIP with the option names and defaults of OpenImageIO 3.2's oiiotool",
                    run_flipdiff)
                .images(2, 1)
                .modifiers(flipdiff_modifiers())
                .frequent("fail,layer,hdr"),
            filmstrip_row()};
}

} // namespace tonetool::chain
