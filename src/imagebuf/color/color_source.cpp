// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/color_source.h"

#include <OpenImageIO/filesystem.h>
#include <ctime>
#include <mutex>

#include "imagebuf/aov/channels.h"
#include "imagebuf/color/view_config.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

// Of the last space that was asked for: a comparison asks for the same one many times.
struct Kept {
    std::string config, from;
    std::vector<std::pair<std::string, std::string>> context;
    std::time_t written = 0;
    ColorSpace space;
};
std::mutex g_kept_lock;
Kept g_kept;

ColorSpace open_space(const PixelOptions& options) {
    const QuietOcio quiet;
    ViewOptions of_config;
    of_config.config = options.config;
    of_config.context = options.context;
    const ChosenView chosen = open_config(of_config);
    const auto found = known_space(chosen, options.from);
    if (!found)
        throw Refusal(unknown_name("colour space", options.from, scene_spaces(chosen)));
    const SceneBridge bridge = find_bridge(chosen, options.from);
    const auto group = ocio::GroupTransform::Create();
    const auto to_bridge = ocio::ColorSpaceTransform::Create();
    to_bridge->setSrc(found->getName());
    to_bridge->setDst(bridge.space.c_str());
    group->appendTransform(to_bridge);
    group->appendTransform(matrix_transform(bridge.to_rec709, 1));
    const auto processor = make_processor(chosen, group);
    ColorSpace space;
    space.name = found->getName();
    space.convert = [processor](float* rgb, ptrdiff_t count) {
        ocio::PackedImageDesc pixels(rgb, long(count), 1, 3);
        processor->apply(pixels);
    };
    return space;
}

// The space that `options.from` names in the configuration `options.config`, to linear Rec.709.
ColorSpace config_space(const PixelOptions& options) {
    const std::lock_guard<std::mutex> hold(g_kept_lock);
    const Kept asked{options.config,
                     options.from,
                     options.context,
                     OIIO::Filesystem::last_write_time(options.config),
                     {}};
    const bool same = asked.config == g_kept.config && asked.from == g_kept.from &&
                      asked.context == g_kept.context && asked.written == g_kept.written;
    if (!same) {
        Kept next = asked;
        next.space = open_space(options);
        g_kept = next;
    }
    return g_kept.space;
}

ColorSpace space_of(const OIIO::ImageSpec& spec, const PixelOptions& options) {
    // What headers call "linear" may be another space of a configuration.
    if (options.from.empty() || options.config.empty() || is_interchange_name(options.from))
        return find_space(spec, options.from);
    ColorSpace space;
    std::string why;
    if (!contained(why, [&] { space = config_space(options); }))
        return refusing_as([&](const std::string&) { return why; },
                           [&] { return find_space(spec, options.from); });
    space.scale = 1 / stated_exposure(spec);
    return space;
}

} // namespace

void find_picture(const OIIO::ImageSpec& spec, const PixelOptions& options, ColorChoice& choice,
                  ColorSpace& space) {
    choice = chosen_channels(spec, options.layer);
    space = space_of(spec, options);
    choice.space = space.name;
    choice.display_encoded = space.encoded();
    if (choice.grey())
        space.is_rec709 = true;
    const double gamma = double(spec.get_float_attribute("oiio:Gamma", 1));
    space.alpha_power = gamma > 0 && oiio::multiplies_by_power_of_alpha(spec) ? gamma : 1;
    space.straight = (space.encoded() || space.alpha_power != 1) && choice.a >= 0 &&
                     !spec.channelformat(choice.r).is_floating_point();
}

ColorChoice chosen_color(const OIIO::ImageSpec& spec, const PixelOptions& options) {
    ColorChoice choice;
    ColorSpace space;
    find_picture(spec, options, choice, space);
    return choice;
}

bool ToneAlgo::find_color(const OIIO::ImageSpec& spec, const PixelOptions& options,
                          ColorChoice& choice, std::string& error) {
    return contained(error, [&] { choice = chosen_color(spec, options); });
}

} // namespace tonetool
