// SPDX-License-Identifier: BSD-3-Clause
// Commands that compare a test image with a reference.
#include <functional>

#include "chain/commands/attribute_args.h"
#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/flip_report.h"
#include "chain/commands/frame_pictures.h"
#include "chain/commands/options.h"
#include "chain/commands/shot_args.h"
#include "chain/images/colormap.h"
#include "imagebuf/options/flip_options.h"
#include "imagebuf/pixels/upright.h"
#include "metrics/errors.h"
#include "sequence/results/measurement.h"
#include "sequence/results/measuring.h"
#include "text/error.h"
#include "text/printable.h"

namespace tonetool::chain {

namespace {

using Maps = std::vector<OIIO::ImageBuf>;
using Tests = std::vector<const OIIO::ImageBuf*>;
using Views = std::vector<OIIO::ImageBuf>;
using Compare = std::function<bool(Maps&, const OIIO::ImageBuf&, const Tests&)>;

// What the images of a command are looked at for: call.images is the reference and the tests.
struct Look {
    PixelOptions reference, tests;
    bool alike = true; ///< both are the picture that was rendered, and none is made of the other
    /// Many times: the images are read before, unless their memory is bounded.
    bool again = false;
};

Look same_look(const Call& call, bool again = false) {
    return {pixel_options(call), pixel_options(call), true, again};
}

// The images as they were compared, and a map for each test.
struct Compared {
    Views views;
    Maps maps;
};

// The same pixels twice: most likely a slip of the command line.
void warn_of_same_file(Session& session, const Call& call, const Image& test, const Look& look) {
    const Image& reference = *call.images.front();
    const auto r = looked_at(reference, look.reference), t = looked_at(test, look.tests);
    if (r && t && same_file(reference, r->part, test, t->part) && r->color.r == t->color.r &&
        r->color.g == t->color.g && r->color.b == t->color.b) {
        tell_same_file(session, call, reference, test,
                       "reference \"" + reference.name() + "\" and test \"" + test.name() +
                           "\" are the same file");
    }
}

Compared compare(Session& session, const Call& call, const Look& look, const Compare& function) {
    Compared done;
    const auto view = shown_bytes(session, call) > 0               ? shown_input
                      : look.again && session.settings.memory == 0 ? color_input
                                                                   : color_source;
    done.views.reserve(call.images.size()); // else the pixels are copied
    for (const ImagePtr& image : call.images) {
        const PixelOptions& options = done.views.empty() ? look.reference : look.tests;
        done.views.push_back(view(session, call, *image, options));
    }
    Tests tests;
    for (size_t i = 1; i < done.views.size(); ++i) {
        warn_of_same_file(session, call, *call.images[i], look);
        if (look.alike)
            check_same_picture(session, call, *call.images.front(), look.reference, *call.images[i],
                               look.tests);
        tests.push_back(&done.views[i]);
    }
    done.maps.resize(tests.size());
    if (!function(done.maps, done.views.front(), tests))
        throw CommandError(done.maps.front().geterror());
    session.outcome.produced = true;
    return done;
}

std::string left_out_text(const PairSummary& summary) {
    return ignored_text(summary.ignored);
}
std::string left_out_text(const TmqiSummary&) {
    return "";
}

template <class Summary>
void print(Session& session, const Call& call, const Summary& summary, const std::string& test,
           bool judged) {
    const std::string label = call.row().label(), reference = call.images.front()->name();
    const Detail what = detail(session, call);
    if (what == Detail::All)
        session.print(summary_text(label, summary, reference, test));
    else if (what == Detail::Brief)
        session.print(brief_text(label, summary, reference, test));
    else if (what == Detail::Line && !judged)
        session.print(label + ": " + numbers_text(summary) + left_out_text(summary) + " (" +
                      printable(test) + ")");
}

// `limits` are what judge() will say a line of.
template <class Summary>
void report(Session& session, const Call& call, const Summary& summary, const Limits& limits,
            size_t test = 0) {
    for (const std::string& warning : summary.warnings)
        session.warning(call.row().label(), warning);
    record(session, call, sequence::measurement(summary), test);
    print(session, call, summary, call.images.at(test + 1)->name(), !limits.empty());
}

// The pair for the report; of maps without a bound there are no colours that mean the same in all
// frames.
sequence::PictureRequest pair_request(const Views& views, size_t test = 0) {
    sequence::PictureRequest request;
    request.reference = &views.at(0);
    request.test = &views.at(test + 1);
    return request;
}

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

void push_result(Session& session, const Call& call, OIIO::ImageBuf result) {
    session.stack.push(Image::computed("--" + call.row().label(), std::move(result)));
}

// The map lies as its pictures do.
void push_map(Session& session, const Call& call, OIIO::ImageBuf map) {
    lie_as(call.images.front()->part().header(), map);
    push_result(session, call, std::move(map));
}

// ---- hdrflip

int test_count(const Call& call) {
    return call.integer("tests", {1, 1000}).value_or(1);
}

int hdrflip_pops(const Call& call) {
    return 1 + test_count(call);
}

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
        compare(session, call, {options.pixels, options.pixels},
                [&](Maps& to, auto& reference, auto& tests) {
                    return ToneAlgo::hdr_flip(to, reference, tests, options, &results);
                });
    for (size_t i = 0; i < maps.size(); ++i) {
        FlipResult& result = results[i];
        report(session, call, result.summary, limits, i);
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
        compare(session, call, same_look(call), [&](Maps& to, auto& reference, auto& tests) {
            return ToneAlgo::ldr_flip(to[0], reference, *tests[0], options, &result);
        });
    report(session, call, result.summary, limits);
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
        compare(session, call, same_look(call), [&](Maps& to, auto& reference, auto& tests) {
            return hdr ? ToneAlgo::hdr_flip(to[0], reference, *tests[0], options, &result)
                       : ToneAlgo::ldr_flip(to[0], reference, *tests[0], options, &result);
        });
    report(session, call, result.summary, limits);
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
    auto [views, maps] =
        compare(session, call, same_look(call, true), [&](Maps& to, auto& reference, auto& tests) {
            return ToneAlgo::flip_filmstrip(to[0], reference, *tests[0], options, look, &result);
        });
    report(session, call, result.summary, limits);
    judge_flip(session, call, limits, result.summary);
    maps[0].specmod().attribute("oiio:ColorSpace", "sRGB");
    push_result(session, call, std::move(maps[0])); // upright already
}

Limits read_errormap(Session& session, const Call& call, ErrorOptions& options) {
    options = error_options(session, call);
    const metrics::ErrorMetric& metric = *metrics::find_error_metric(options.metric);
    return limits_of(session, call, error_measures(metric), options.quantities);
}

void check_errormap(Session& session, const Call& call) {
    ErrorOptions options;
    (void)read_errormap(session, call, options);
    (void)attribute_options(call, options);
}

void run_errormap(Session& session, const Call& call) {
    ErrorOptions options;
    const Limits limits = read_errormap(session, call, options);
    const metrics::ErrorMetric& metric = *metrics::find_error_metric(options.metric);
    std::vector<ErrorSummary> summaries(size_t(test_count(call)));
    auto [views, maps] = compare(
        session, call, same_look(call, test_count(call) > 1),
        [&](Maps& to, auto& reference, auto& tests) {
            for (size_t i = 0; i < tests.size(); ++i) {
                if (!ToneAlgo::error_map(to[i], reference, *tests[i], options, &summaries[i])) {
                    std::swap(to[0], to[i]); // the one whose error is told
                    return false;
                }
            }
            return true;
        });
    for (size_t i = 0; i < maps.size(); ++i) {
        const ErrorSummary& summary = summaries[i];
        report(session, call, summary, limits, i);
        const auto measured = [&](const std::string& quantity) {
            return ToneAlgo::flip_quantity(summary.pool, quantity).value_or(summary.value);
        };
        judge(session, call, limits, measured,
              sequence::Position{summary.pool.max_x, summary.pool.max_y}, i, summary.ignored);
        attribute_error(session, call, attribute_options(call, options), maps[i], i);
        sequence::PictureRequest request = pair_request(views, i);
        request.look.pixels = options.pixels;
        request.look.size = options.size;
        request.exposures = summary.exposures;
        (metric.has(metrics::kBounded) ? request.error : request.unbounded) = &maps[i];
        show(session, call, std::move(request));
        push_map(session, call, std::move(maps[i]));
    }
}

Measures tmqi_measures() {
    return {ToneAlgo::tmqi_quantities(), false};
}

void check_tmqi(Session& session, const Call& call) {
    Strings none;
    (void)limits_of(session, call, tmqi_measures(), none);
}

void run_tmqi(Session& session, const Call& call) {
    TmqiOptions options{pixel_options(call), pixel_options(call, "ldr"), call.flag("crop", false),
                        session.settings.memory};
    Strings none;
    const Limits limits = limits_of(session, call, tmqi_measures(), none);
    TmqiSummary summary;
    auto [views, maps] = compare(
        session, call, {options.hdr, options.ldr, false}, [&](Maps& to, auto& hdr, auto& tests) {
            return ToneAlgo::tmqi(to[0], hdr, *tests[0], options, &summary);
        });
    report(session, call, summary, limits);
    const auto measured = [&](const std::string& quantity) {
        return ToneAlgo::tmqi_quantity(summary.score, quantity).value();
    };
    judge(session, call, limits, measured, {});
    push_map(session, call, std::move(maps[0]));
}

// ---- rows

Row hdrflip_row() {
    return command("hdrflip", "HDR-FLIP: reference, test -> error map", run_hdrflip)
        .checked(check_hdrflip)
        .images(2, 1)
        .images_of(hdrflip_pops, hdrflip_pushes)
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

Row tmqi_row() {
    return command("tmqi", "TMQI of a tone-mapped picture: HDR image, picture -> structure map",
                   run_tmqi)
        .checked(check_tmqi)
        .images(2, 1)
        .modifier("layer", "NAME", "layer of the HDR image whose R,G,B are used")
        .modifier("from", "SPACE", "colour space of the HDR image")
        .modifier("ldrlayer", "NAME", "layer of the picture")
        .modifier("ldrfrom", "SPACE", "colour space of the picture (sRGB for integers)")
        .modifier("crop", "0|1", "compare only where the display windows meet")
        .modifiers(threshold_modifiers(tmqi_measures(), "at least X (0 to 1; higher is better)"))
        .frequent("fail,warn,layer,ldrlayer");
}

} // namespace

Rows compare_commands() {
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
            filmstrip_row(),
            command("errormap", "An error by pixel: reference, test -> error map", run_errormap)
                .checked(check_errormap)
                .images(2, 1)
                .images_of(hdrflip_pops, test_count)
                .modifiers(error_modifiers(), attribute_modifiers())
                .modifier("tests", "K", "compare K tests with the one reference below them")
                .frequent("metric,fail,warn,layer,from"),
            tmqi_row()};
}

} // namespace tonetool::chain
