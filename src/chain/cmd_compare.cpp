// Commands that compare a test image with a reference.
#include <functional>

#include "chain/colormap.h"
#include "chain/error.h"
#include "chain/first_part.h"
#include "chain/flip_args.h"
#include "chain/flip_report.h"

namespace tonetool::chain {

namespace {

using Maps = std::vector<OIIO::ImageBuf>;
using Tests = std::vector<const OIIO::ImageBuf*>;
using Results = std::vector<FlipResult>;
using Compare = std::function<bool(Maps&, const OIIO::ImageBuf&, const Tests&, Results&)>;

/// What one command has compared: call.images is the reference and the tests.
struct Compared {
    Maps maps;
    Results results;
};

// `again`: the function looks at the images many times, so that they are read before, unless they
// may not take that much memory.
Compared compare(Session& session, const Call& call, const Compare& function, bool again = false) {
    const auto view = again && session.memory == 0 ? color_input : color_source;
    std::vector<OIIO::ImageBuf> views;
    views.reserve(call.images.size());
    for (const ImagePtr& image : call.images) {
        views.push_back(view(session, call, *image, pixel_options(call)));
    }
    Tests tests;
    for (size_t i = 1; i < views.size(); ++i) {
        tests.push_back(&views[i]);
    }
    Compared compared{Maps(tests.size()), Results(tests.size())};
    if (!function(compared.maps, views.front(), tests, compared.results)) {
        for (const OIIO::ImageBuf& map : compared.maps) {
            if (map.has_error()) {
                throw CommandError(map.geterror());
            }
        }
        throw CommandError("failed without a reason");
    }
    session.produced = true;
    return compared;
}

void report(Session& session, const Call& call, const FlipSummary& summary, size_t test) {
    const std::string label = call.row().label();
    for (const std::string& warning : summary.warnings) {
        session.warning(label, warning);
    }
    if (call.flag("print", true) && !session.quiet) {
        session.out << summary_text(label, summary, call.images.front()->name(),
                                    call.images.at(test + 1)->name());
    }
}

void push_map(Session& session, const Call& call, OIIO::ImageBuf map) {
    session.push(Image::computed("--" + call.row().label(), std::move(map)));
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
    session.keep_pixels_of(filename);
    std::string why;
    if (!write_image(image, filename, why)) {
        throw CommandError(why);
    }
}

void save_exposures(Session& session, const Call& call, const FlipResult& result, size_t test) {
    auto prefix = call.text("saveexposures");
    if (!prefix) {
        return;
    }
    std::string start = *prefix;
    if (test_count(call) > 1) {
        start += ".t" + std::to_string(test + 1);
    }
    for (size_t i = 0; i < result.exposures.size(); ++i) {
        std::string name = start + (i < 10 ? ".0" : ".") + std::to_string(i);
        save(session, result.exposures[i].reference, name + ".reference.exr");
        save(session, result.exposures[i].test, name + ".test.exr");
        save(session, result.exposures[i].flip, name + ".flip.exr");
    }
}

void run_hdrflip(Session& session, const Call& call) {
    HdrFlipOptions options;
    read_flip_options(call, true, options);
    read_hdr_options(session, call, options);
    options.memory = session.memory;
    Thresholds thresholds = thresholds_of(call);
    (void)call.flag("print", true);
    auto exposure_map = call.choice("exposuremap", {"stops", "index"});
    options.want_exposure_map = exposure_map.has_value();
    options.want_exposures = call.has("saveexposures");
    Compared compared = compare(
        session, call,
        [&](Maps& maps, const OIIO::ImageBuf& reference, const Tests& tests, Results& results) {
            return ToneAlgo::hdr_flip(maps, reference, tests, options, &results);
        });
    for (size_t i = 0; i < compared.maps.size(); ++i) {
        FlipResult& result = compared.results[i];
        report(session, call, result.summary, i);
        judge(session, call, result.summary.pool, thresholds, i);
        save_exposures(session, call, result, i);
        if (exposure_map) {
            push_map(session, call,
                     std::move(*exposure_map == "stops" ? result.exposure_stops
                                                        : result.exposure_index));
        }
        push_map(session, call, std::move(compared.maps[i]));
    }
}

// ---- ldrflip, flipdiff, filmstrip: one test

Compare ldr_function(const FlipOptions& options) {
    return [options](Maps& maps, const OIIO::ImageBuf& reference, const Tests& tests,
                     Results& results) {
        return ToneAlgo::ldr_flip(maps[0], reference, *tests[0], options, &results[0]);
    };
}

void run_ldrflip(Session& session, const Call& call) {
    FlipOptions options;
    read_flip_options(call, true, options);
    options.memory = session.memory;
    Thresholds thresholds = thresholds_of(call);
    (void)call.flag("print", true);
    Compared compared = compare(session, call, ldr_function(options));
    report(session, call, compared.results[0].summary, 0);
    judge(session, call, compared.results[0].summary.pool, thresholds);
    push_map(session, call, std::move(compared.maps[0]));
}

void run_flipdiff(Session& session, const Call& call) {
    HdrFlipOptions options = flipdiff_options(call);
    options.memory = session.memory;
    bool hdr = call.flag("hdr", true);
    Thresholds thresholds{"max", call.number("fail", {0, 1}), std::nullopt};
    auto colors = call.text("colormap");
    if (colors) {
        check_colormap(*colors);
    }
    (void)call.flag("print", true);
    Compare hdr_function = [&](Maps& maps, const OIIO::ImageBuf& reference, const Tests& tests,
                               Results& results) {
        return ToneAlgo::hdr_flip(maps[0], reference, *tests[0], options, &results[0]);
    };
    Compared compared = compare(session, call, hdr ? hdr_function : ldr_function(options));
    const FlipSummary& summary = compared.results[0].summary;
    report(session, call, summary, 0);
    bool failed = judge(session, call, summary.pool, thresholds);
    if (failed) {
        session.print("FAILURE");
    } else if (thresholds.fail) {
        session.report("PASS");
    }
    push_map(session, call,
             colors ? colored(compared.maps[0], *colors) : std::move(compared.maps[0]));
}

void run_filmstrip(Session& session, const Call& call) {
    HdrFlipOptions options;
    read_flip_options(call, false, options);
    read_hdr_options(session, call, options);
    options.memory = session.memory;
    Thresholds thresholds = thresholds_of(call);
    (void)call.flag("print", true);
    ToneAlgo::FilmstripOptions look;
    look.thumb_width = call.integer("width", {32, 4096}).value_or(look.thumb_width);
    look.max_columns = call.integer("columns", {1, 1024}).value_or(look.max_columns);
    look.font = call.text("font").value_or(look.font);
    Compared compared = compare(
        session, call,
        [&](Maps& maps, const OIIO::ImageBuf& reference, const Tests& tests, Results& results) {
            return ToneAlgo::flip_filmstrip(maps[0], reference, *tests[0], options, look,
                                            &results[0]);
        },
        true);
    report(session, call, compared.results[0].summary, 0);
    judge(session, call, compared.results[0].summary.pool, thresholds);
    compared.maps[0].specmod().attribute("oiio:ColorSpace", "sRGB");
    push_map(session, call, std::move(compared.maps[0]));
}

// ---- rows

std::vector<Modifier> hdrflip_modifiers() {
    return concatenated(
        {hdr_modifiers(),
         viewing_modifiers(),
         pair_modifiers(),
         {{"exposuremap", "stops|index", "push the exposure of the largest error below the map"},
          {"saveexposures", "PREFIX", "write PREFIX.NN.reference.exr, .test.exr and .flip.exr"},
          {"tests", "K", "compare K tests with the one reference below them"}},
         threshold_modifiers()});
}

std::vector<Modifier> filmstrip_modifiers() {
    return concatenated({hdr_modifiers(),
                         {viewing_modifiers().front()},
                         pair_modifiers(),
                         {{"width", "PIXELS", "width of one picture (240)"},
                          {"columns", "N", "at most this many exposures are shown (9)"},
                          {"font", "FILE", "font of the labels (DejaVu Sans)"}},
                         threshold_modifiers()});
}

} // namespace

std::vector<Command> compare_commands() {
    return {
        {{"hdrflip"},
         {},
         2,
         1,
         hdrflip_modifiers(),
         "HDR-FLIP: reference, test -> error map",
         Group::Compare,
         run_hdrflip,
         true,
         hdrflip_pops,
         hdrflip_pushes},
        {{"ldrflip"},
         {},
         2,
         1,
         concatenated({viewing_modifiers(), pair_modifiers(), threshold_modifiers()}),
         "LDR-FLIP: reference, test -> error map",
         Group::Compare,
         run_ldrflip},
        {{"flipdiff"},
         {},
         2,
         1,
         flipdiff_modifiers(),
         "FLIP with the option names and defaults of OpenImageIO 3.2's oiiotool",
         Group::Compare,
         run_flipdiff},
        {{"filmstrip"},
         {},
         2,
         1,
         filmstrip_modifiers(),
         "HDR-FLIP as a picture: every exposure of both images and its map",
         Group::Compare,
         run_filmstrip},
    };
}

} // namespace tonetool::chain
