// SPDX-License-Identifier: BSD-3-Clause
// Commands that measure luminance and change exposure.
#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_report.h"
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
    push_picture(session, image, pixel_options(call), std::move(result));
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
    Lines lines(label);
    lines.add("image", image.name());
    visit_source<LuminanceStats>(fields(lines, stats));
    visit_luminance(fields(lines, stats));
    session.report(lines.text);
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
