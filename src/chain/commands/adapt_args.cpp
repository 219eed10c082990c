// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/adapt_args.h"

#include "imagebuf/options/shot_options.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

void measure_light(const Session& session, const OIIO::ImageBuf& image, const PixelOptions& pixels,
                   std::optional<double> unit) {
    FrameLight& light = *session.shot.light;
    std::string why;
    if (!ToneAlgo::frame_light(light, image, why, pixels))
        throw CommandError(why);
    light.unit = unit.value_or(light.unit);
    light.frame = session.frame.number;
    light.view = session.frame.view;
    throw EndOfRun();
}

// Modifiers that say how a shot is followed, where none is.
void refuse_without_shot(const Call& call) {
    describe(AdaptOptions(), [&](const auto& row) {
        const std::string key = row.key; // the unit may be that of one image
        if (key != "adapt" && key != "unit" && call.has(key))
            throw CommandError(key + "= is of adapt=shot, eye, smooth or FILE: "
                                     "here each image has its own exposure");
    });
}

} // namespace

bool names_shot_mode(const std::string& adapt) {
    return adapt == "shot" || adapt == "eye" || adapt == "smooth";
}

void adapt_to_shot(Session& session, const Call& call, const OIIO::ImageBuf& image,
                   const PixelOptions& pixels, AdaptOptions& options) {
    const auto& shot = session.shot;
    const bool by_mode = names_shot_mode(options.adapt);
    if (by_mode && (call.has("mode") || call.has("frame")))
        throw CommandError("mode= and frame= are of adapt=FILE, this is adapt=" + options.adapt);
    if (shot.light && shot.at == call.at)
        measure_light(session, image, pixels, options.unit);
    if (const auto found = shot.measured.find(call.at); found != shot.measured.end()) {
        options.statistics = found->second;
        options.frame = session.frame.number;
    } else if (by_mode) {
        throw CommandError("adapt=" + options.adapt +
                           " has no shot here (valid: frame, FILE, or the frames of a command line "
                           "that measures something)");
    } else if (options.adapt == "frame") {
        refuse_without_shot(call);
    } else if (!options.frame && session.frame.loops) {
        options.frame = session.frame.number;
    }
}

} // namespace tonetool::chain
