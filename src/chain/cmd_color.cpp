// Commands that measure luminance, change exposure, and show values as colours.
#include "chain/colormap.h"
#include "chain/error.h"
#include "chain/first_part.h"
#include "chain/flip_args.h"

namespace tonetool::chain {

namespace {

void run_exposure(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    double stops = call.number_argument(0, {-126, 126});
    OIIO::ImageBuf view = color_input(session, call, image, pixel_options(call));
    OIIO::ImageBuf result = ToneAlgo::exposure(view, stops, pixel_options(call));
    if (result.has_error()) {
        throw CommandError(result.geterror());
    }
    session.push(Image::derived(image, std::move(result)));
}

std::string luminance_text(const std::string& label, const LuminanceStats& stats,
                           const std::string& name) {
    std::string text;
    auto add = [&](const char* key, const std::string& value) {
        text += label + ": " + key + " " + value + "\n";
    };
    add("image", name);
    add("layer", stats.layer.empty() ? "R,G,B" : stats.layer);
    add("space", stats.space);
    add("pixels", std::to_string(stats.pixels));
    add("nonfinite", std::to_string(stats.nonfinite));
    add("negative", std::to_string(stats.negative));
    add("black", std::to_string(stats.black));
    add("min", format_number(stats.min));
    add("max", format_number(stats.max));
    add("mean", format_number(stats.mean));
    add("median", format_number(stats.median));
    add("median-lit", format_number(stats.median_lit));
    add("log-average", format_number(stats.log_average));
    add("p1", format_number(stats.p1));
    add("p99", format_number(stats.p99));
    add("p99.9", format_number(stats.p999));
    return text;
}

void run_luminance(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    const std::string label = call.row().label();
    OIIO::ImageBuf view = color_source(session, call, image, pixel_options(call));
    LuminanceStats stats;
    std::string why;
    if (!ToneAlgo::luminance_stats(stats, view, why, pixel_options(call))) {
        throw CommandError(why);
    }
    if (stats.nonfinite > 0) {
        session.warning(label, std::to_string(stats.nonfinite) + " non-finite pixels in " +
                                   image.name() + " are in no figure");
    }
    if (!session.quiet) {
        session.out << luminance_text(label, stats, image.name());
    }
    session.produced = true;
    session.push(call.images[0]);
}

void run_colormap(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    check_colormap(call.argument(0));
    warn_of_other_parts(session, call, image);
    session.push(Image::derived(image, colored(flat_pixels(image), call.argument(0))));
}

} // namespace

std::vector<Command> color_commands() {
    return {
        {{"exposure"},
         {"STOPS"},
         1,
         1,
         pixel_modifiers(),
         "Multiply the colour by 2^STOPS",
         Group::Color,
         run_exposure},
        {{"colormap"},
         {"MAPNAME"},
         1,
         1,
         {},
         "Show values as colours: " + join(ToneAlgo::color_maps(), ", ") + ", or RGB triples",
         Group::Color,
         run_colormap},
        {{"luminancestats"},
         {},
         1,
         1,
         pixel_modifiers(),
         "Print the luminance statistics of the current image",
         Group::Measure,
         run_luminance},
    };
}

} // namespace tonetool::chain
