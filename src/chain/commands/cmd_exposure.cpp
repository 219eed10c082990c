// SPDX-License-Identifier: BSD-3-Clause
// Commands that measure luminance and change exposure.
#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

void run_exposure(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    double stops = call.number_argument(0, {-126, 126});
    OIIO::ImageBuf view = color_input(session, call, image, pixel_options(call));
    OIIO::ImageBuf result = ToneAlgo::exposure(view, stops, pixel_options(call));
    if (result.has_error())
        throw CommandError(result.geterror());
    session.stack.push(Image::derived(image, std::move(result)));
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
    if (!ToneAlgo::luminance_stats(stats, view, why, pixel_options(call)))
        throw CommandError(why);
    if (stats.nonfinite > 0) {
        session.warning(label, std::to_string(stats.nonfinite) + " non-finite pixels in " +
                                   image.name() + " are in no figure");
    }
    session.report(luminance_lines(label, stats, image.name()).text);
    session.outcome.produced = true;
    session.stack.push(call.images[0]);
}

} // namespace

Rows exposure_commands() {
    return {command("exposure STOPS", "Multiply the colour by 2^STOPS", run_exposure)
                .images(1, 1)
                .modifiers(pixel_modifiers())
                .keeps_header(),
            command("luminancestats", "Print the luminance statistics of the current image",
                    run_luminance)
                .in(Group::Measure)
                .images(1, 1)
                .modifiers(pixel_modifiers())};
}

} // namespace tonetool::chain
