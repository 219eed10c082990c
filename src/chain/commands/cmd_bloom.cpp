// SPDX-License-Identifier: BSD-3-Clause
// Bloom.
#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/options.h"
#include "imagebuf/options/bloom_options.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

void report_bloom(Session& session, const std::string& label, const BloomSummary& found) {
    Lines lines(label);
    lines.add_positive("lwa", found.lwa);
    lines.add("threshold", found.threshold);
    lines.add("spreading", format_number(double(found.spreading)));
    lines.add("light", found.light);
    lines.add_positive("fov", found.fov);
    lines.add("reach", found.reach);
    lines.add_positive("kept", found.kept);
    if (session.settings.verbose)
        for (const std::string& note : found.notes)
            lines.add("note", note);
    session.report(lines.text);
}

void run_bloom(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    const std::string label = call.row().label();
    BloomOptions options;
    options.pixels = pixel_options(call);
    read_options(call, options);
    const OIIO::ImageBuf source = color_input(session, call, image, options.pixels);
    BloomSummary found;
    OIIO::ImageBuf result;
    if (!ToneAlgo::bloom(result, source, options, &found))
        throw CommandError(result.geterror());
    report_bloom(session, label, found);
    for (const std::string& warning : found.warnings)
        session.warning(label, image.name() + ": " + warning);
    push_picture(session, image, options.pixels, std::move(result));
}

} // namespace

Rows bloom_commands() {
    return {command("bloom", "Spread the light of bright pixels, as in the eye, in linear light",
                    run_bloom)
                .images(1, 1)
                .modifiers(modifiers_of<BloomOptions>(), pixel_modifiers())
                .keeps_header()};
}

} // namespace tonetool::chain
