// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/shot_args.h"

#include "chain/commands/color_input.h"
#include "sequence/results/shot_exposures.h"
#include "text/error.h"
#include "tonetool/luminance.h"

namespace tonetool::chain {

namespace {

void measure_sample(Session& session, const Call& call, const PairOptions& options) {
    const Image& reference = *call.images.front();
    const OIIO::ImageBuf pixels = color_source(session, call, reference, options.pixels);
    LuminanceStats stats;
    std::string why;
    if (!ToneAlgo::luminance_stats(stats, pixels, why, options.pixels, {}, 0, options))
        throw CommandError(why);
    session.check.sample->reference = reference.name();
    session.check.sample->max_luminance = stats.max;
    session.check.sample->median_luminance = stats.median > 0 ? stats.median : stats.median_lit;
    throw EndOfRun();
}

sequence::ShotExposures range_of(const Session& session, const std::string& from) {
    if (session.check.shot)
        return *session.check.shot;
    if (from == "shot")
        throw CommandError("exposures=shot has no shot here (valid: frame, FILE)");
    return sequence::read_exposures(from);
}

} // namespace

void read_shot_exposures(Session& session, const Call& call, HdrFlipOptions& options) {
    const std::string from = call.text("exposures").value_or("frame");
    if (from == "frame")
        return;
    if (options.max_luminance || options.median_luminance) {
        throw CommandError("exposures=" + from +
                           " goes without maxluminance= and medianluminance= (valid: either)");
    }
    if (from == "shot" && session.check.sample)
        measure_sample(session, call, options);
    const sequence::ShotExposures range = range_of(session, from);
    const std::string& name = call.images.front()->name();
    if (from != "shot" && !sequence::was_measured_on(range, name)) {
        session.warning(call.row().label(),
                        "the exposures of \"" + from + "\" were measured on other files, \"" +
                            name +
                            "\" is not among them (valid: exposures=shot, or a FILE of "
                            "--statistics with these references)");
    }
    options.max_luminance = range.max_luminance;
    options.median_luminance = range.median_luminance;
}

} // namespace tonetool::chain
