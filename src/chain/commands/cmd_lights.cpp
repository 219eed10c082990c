// SPDX-License-Identifier: BSD-3-Clause
// The index of the light that lights each pixel.
#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/light_args.h"
#include "chain/commands/options.h"
#include "imagebuf/options/tone_options.h"
#include "imagebuf/pixels/layer_name.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

void run_lightindex(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    const PixelOptions pixels = pixel_options(call);
    OIIO::ImageBuf source = color_input(session, call, image, pixels);
    LightIndexSummary found;
    OIIO::ImageBuf result;
    if (!ToneAlgo::light_index(result, source, light_options(call), pixels, &found))
        throw CommandError(result.geterror());
    Lines lines(call.row().label());
    lines.add("layer", shown_layer(found.layer));
    for (size_t g = 0; g < found.groups.size(); ++g) {
        const LightGroupSummary& group = found.groups[g];
        std::string text = group.name + ": pixels " + std::to_string(group.pixels) + " maximum " +
                           format_number(group.maximum);
        if (group.luminance)
            text += " luminance " + format_number(*group.luminance);
        lines.add("group " + std::to_string(g), text + (group.maximum > 0 ? "" : " black"));
    }
    lines.add("unlit", found.unlit);
    lines.add("sum", found.sum);
    lines.add("difference", found.difference);
    session.report(lines.text);
    for (const std::string& warning : found.warnings)
        session.warning(call.row().label(), image.name() + ": " + warning);
    session.stack.push(Image::computed(image.name(), std::move(result)));
}

} // namespace

Rows light_commands() {
    return {command("lightindex", "Index of the light group that lights each pixel, -1 for none",
                    run_lightindex)
                .images(1, 1)
                .modifiers(modifiers_of<LightOptions>(), pixel_modifiers())};
}

} // namespace tonetool::chain
