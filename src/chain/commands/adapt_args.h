// SPDX-License-Identifier: BSD-3-Clause
// adapt=: the exposure of a frame by the shot that it is in.
#pragma once

#include "chain/commands/commands.h"
#include "chain/language/registry.h"
#include "tonetool/shot.h"

namespace tonetool::chain {

/// Whether a word asks by name for a shot that is measured before the frames run.
bool names_shot_mode(const std::string& adapt);

/// What a command with these options has to know of the shot. Where nobody asks, options that the
/// statistics of a shot do not hold are those of each frame.
template <class Options>
ShotNeed shot_need(const Call& call, const Options& options) {
    const std::string adapt = call.text("adapt").value_or("");
    if (!(adapt.empty() || names_shot_mode(adapt)) || !ToneAlgo::measures(options))
        return {};
    if (const std::string lack = ToneAlgo::not_of_shots(options); adapt.empty() && !lack.empty())
        return {"", false, lack};
    return {adapt.empty() ? "shot" : adapt, !adapt.empty(), ""};
}

/// Completes what the modifiers say by the shot that was measured for this call. In the run that
/// measures it, the image is measured instead, and the run ends here.
void adapt_to_shot(Session& session, const Call& call, const OIIO::ImageBuf& image,
                   const PixelOptions& pixels, AdaptOptions& options);

} // namespace tonetool::chain
