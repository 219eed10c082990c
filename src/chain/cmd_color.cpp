// Commands that measure luminance, change exposure, and show values as colours.
#include <OpenImageIO/strutil.h>

#include "chain/colormap.h"
#include "chain/error.h"
#include "chain/first_part.h"
#include "chain/flip_args.h"
#include "chain/ops.h"

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

Lines luminance_lines(const std::string& label, const LuminanceStats& stats,
                      const std::string& name) {
    Lines lines(label);
    lines.add("image", name);
    lines.add("layer", stats.layer.empty() ? "R,G,B" : stats.layer);
    lines.add("space", stats.space);
    lines.add("pixels", stats.pixels);
    lines.add("nonfinite", stats.nonfinite);
    lines.add("negative", stats.negative);
    lines.add("black", stats.black);
    lines.add("min", stats.min);
    lines.add("max", stats.max);
    lines.add("mean", stats.mean);
    lines.add("median", stats.median);
    lines.add("median-lit", stats.median_lit);
    lines.add("log-average", stats.log_average);
    lines.add("p1", stats.p1);
    lines.add("p99", stats.p99);
    lines.add("p99.9", stats.p999);
    return lines;
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
    session.report(luminance_lines(label, stats, image.name()).text);
    session.produced = true;
    session.push(call.images[0]);
}

// oiiotool's: of the luminance, as linear light.
OIIO::ImageBuf linear_colors(const OIIO::ImageBuf& pixels, const std::string& map) {
    Floats knots;
    if (map.find(',') == std::string::npos) {
        return IBA::color_map(pixels, -1, map);
    }
    OIIO::Strutil::extract_from_list_string(knots, map);
    return IBA::color_map(pixels, -1, int(knots.size()) / 3, 3, knots);
}

bool colormap(Op& op) {
    const std::string& map = op.call.argument(0);
    op.dst = op.session.compat ? linear_colors(op.a(), map)
                               : colored(flat_pixels(*op.call.images.front()), map);
    return !op.dst.has_error();
}

} // namespace

std::vector<Command> color_commands() {
    std::vector<Command> all = op_rows(
        Group::Color,
        {{"colormap MAPNAME", 1,
          "Show values as colours: " + join(ToneAlgo::color_maps(), ", ") + ", or RGB triples",
          colormap}});
    all.push_back({{{"exposure"}, {"STOPS"}, 1, 1, Group::Color},
                   pixel_modifiers(),
                   "Multiply the colour by 2^STOPS",
                   run_exposure});
    all.push_back({{{"luminancestats"}, {}, 1, 1, Group::Measure},
                   pixel_modifiers(),
                   "Print the luminance statistics of the current image",
                   run_luminance});
    return all;
}

} // namespace tonetool::chain
