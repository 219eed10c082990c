// SPDX-License-Identifier: BSD-3-Clause
// From the statistics of a shot to the exposure of one of its frames.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/options/shot_options.h"
#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/tone/calibrate.h"
#include "imagebuf/tone/cgtmo_plan.h"
#include "imagebuf/tone/shot_statistics.h"
#include "metrics/refusal.h"
#include "tonemap/shot.h"
#include "tonemap/steady.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using tonemap::ShotFrame;

constexpr double kUsualFps = 24;

std::string in_file(const AdaptOptions& options) {
    return options.statistics.frames.empty() ? format("\"{}\": ", options.adapt) : "";
}

// The first frames of scenes, by their numbers; they need not be among the frames.
std::vector<size_t> cuts_given(const std::string& text, const std::vector<ShotFrame>& frames) {
    std::vector<size_t> cuts{0};
    for (const std::string& word : OIIO::Strutil::splits(text, ",")) {
        if (!OIIO::Strutil::string_is_int(word))
            throw Refusal(format("cuts is \"{}\": \"{}\" is no number of a frame (valid: auto, "
                                 "none, or the first frames of scenes, 1,97)",
                                 text, word));
        const int number = OIIO::Strutil::stoi(word);
        const auto at = std::find_if(frames.begin(), frames.end(),
                                     [&](const ShotFrame& one) { return one.number >= number; });
        if (at != frames.end())
            cuts.push_back(size_t(at - frames.begin()));
    }
    std::sort(cuts.begin(), cuts.end());
    return cuts;
}

std::vector<size_t> cuts_of(const AdaptOptions& options, const std::vector<ShotFrame>& frames) {
    if (options.cuts == "none")
        return {0};
    return options.cuts == "auto" ? tonemap::find_cuts(frames) : cuts_given(options.cuts, frames);
}

// The place of the image among the frames.
size_t place_of(const AdaptOptions& options, const std::vector<ShotFrame>& frames, bool any) {
    if (!options.frame && any)
        return 0;
    if (!options.frame)
        throw Refusal(format("{}the exposure changes in this shot: which frame is the image? "
                             "(valid: frame=N, {} to {})",
                             in_file(options), frames.front().number, frames.back().number));
    const auto at = std::find_if(frames.begin(), frames.end(), [&](const ShotFrame& one) {
        return one.number == *options.frame;
    });
    if (at == frames.end())
        throw Refusal(format("{}frame {} is not in the statistics of the shot, which are of {} "
                             "frames from {} to {} (valid: frame=N of these, or statistics of all "
                             "frames)",
                             in_file(options), *options.frame, frames.size(), frames.front().number,
                             frames.back().number));
    return size_t(at - frames.begin());
}

double fps_of(const AdaptOptions& options, const std::vector<ShotFrame>& frames,
              std::vector<std::string>& notes) {
    if (options.fps)
        return *options.fps;
    double fps = 0;
    for (const ShotFrame& frame : frames) {
        if (fps > 0 && frame.fps > 0 && frame.fps != fps)
            throw Refusal(format("{}frames have {} and {} frames per second (valid: fps=X)",
                                 in_file(options), fps, frame.fps));
        fps = std::max(fps, frame.fps);
    }
    if (fps == 0)
        notes.push_back(format("no header says framesPerSecond: {} are assumed", kUsualFps));
    return fps > 0 ? fps : kUsualFps;
}

void check_mode_of(const AdaptOptions& options, const std::string& mode) {
    if (options.tau && mode == "shot")
        throw Refusal("tau is of adapt=eye and smooth: one exposure for a shot has no time");
}

void find_units(const std::vector<ShotFrame>& scene, ShotLight& out) {
    bool any_without = false;
    for (const ShotFrame& frame : scene) {
        any_without = any_without || !(frame.unit > 0);
        if (!(frame.unit > 0))
            continue;
        out.least_unit = out.least_unit > 0 ? std::min(out.least_unit, frame.unit) : frame.unit;
        out.largest_unit = std::max(out.largest_unit, frame.unit);
    }
    if (any_without)
        out.least_unit = 0;
}

// A frame, and the scene between two cuts that it is in.
struct Scene {
    std::vector<ShotFrame> frames; ///< of the scene
    size_t at = 0;
};

// `any`: the frame does not matter where the exposure is the same in all of the shot.
Scene scene_of(const AdaptOptions& options, const std::vector<ShotFrame>& frames, bool any) {
    if (frames.empty())
        throw Refusal(
            format("{}there is no frame in the statistics of the shot", in_file(options)));
    const std::vector<size_t> cuts = cuts_of(options, frames);
    const size_t at = place_of(options, frames, any && cuts.back() == 0);
    const auto next = std::upper_bound(cuts.begin(), cuts.end(), at);
    const size_t begin = *(next - 1), end = next == cuts.end() ? frames.size() : *next;
    return {{frames.begin() + std::ptrdiff_t(begin), frames.begin() + std::ptrdiff_t(end)},
            at - begin};
}

} // namespace

std::vector<int> steady_window_of(const AdaptOptions& options) {
    check_options(options);
    const bool given = !options.statistics.frames.empty();
    const ShotStatistics shot = given ? options.statistics : shot_from_file(options.adapt);
    const Scene scene = scene_of(options, tonemap::frames_of(shot.frames, {}), false);
    const int64_t own = scene.frames[scene.at].number;
    std::vector<int> numbers;
    for (const ShotFrame& frame : scene.frames)
        if (std::abs(frame.number - own) <= tonemap::kSteadyReach)
            numbers.push_back(frame.number);
    return numbers;
}

ShotLight light_of_shot(const AdaptOptions& options, std::optional<double> white_percentile) {
    check_options(options);
    const bool given = !options.statistics.frames.empty();
    const ShotStatistics shot = given ? options.statistics : shot_from_file(options.adapt);
    const std::string mode = options.mode.empty() ? shot.mode : options.mode;
    check_mode_of(options, mode);
    const auto frames = tonemap::frames_of(shot.frames, white_percentile);
    const auto [scene, at] = scene_of(options, frames, mode == "shot");
    ShotLight out;
    ShotExposure& exposure = out.exposure;
    exposure.mode = mode;
    exposure.first = scene.front().number;
    exposure.last = scene.back().number;
    tonemap::AdaptTerms terms{mode, options.tau, kUsualFps, options.unit,
                              options.space == "linear"};
    if (mode != "shot")
        terms.fps = fps_of(options, frames, exposure.notes);
    const ShotFrame found = tonemap::adapted(scene, at, terms);
    if (!(found.lwa > 0))
        throw Refusal(format("{}no frame from {} to {} has any light", in_file(options),
                             exposure.first, exposure.last));
    exposure.lwa = found.lwa;
    exposure.lwa_geometric = found.lwa_geometric;
    exposure.lmax = found.lmax;
    out.white = found.white;
    find_units(scene, out);
    for (const ShotFrame& frame : scene)
        exposure.counted += frame.counted;
    if (const std::string lack = tonemap::lacking(scene); !lack.empty())
        exposure.warnings.push_back(format("the exposure of frames {} to {} is without frames {}, "
                                           "which the statistics of the shot lack",
                                           exposure.first, exposure.last, lack));
    return out;
}

void check_unit(const AdaptOptions& options, const std::string& mode, const std::string& method) {
    if (options.unit && mode != "eye")
        throw Refusal(format("unit is of {}adapt=eye, and this is {}",
                             method.empty() ? ""
                                            : "method=camera, --calibrate's and --tonemap's "
                                              "method=auto, and ",
                             method.empty() ? mode
                             : mode.empty() ? "method=" + method
                                            : "method=" + method + ", adapt=" + mode));
}

std::string shot_words(const ShotExposure& exposure) {
    return exposure.first == exposure.last
               ? format("{} of frame {}", exposure.mode, exposure.first)
               : format("{} of frames {} to {}", exposure.mode, exposure.first, exposure.last);
}

namespace ToneAlgo {

bool shot_exposure(ShotExposure& exposure, const AdaptOptions& options, std::string& error) {
    return contained(error, [&] {
        ShotLight light = light_of_shot(options);
        check_unit(options, light.exposure.mode, "");
        exposure = std::move(light.exposure);
    });
}

bool steady_window(std::vector<int>& numbers, const AdaptOptions& options, std::string& error) {
    return contained(error, [&] { numbers = steady_window_of(options); });
}

double shot_likeness(const FrameLight& a, const FrameLight& b) {
    const auto cells = size_t(tonemap::kThumbnailWidth) * size_t(tonemap::kThumbnailHeight);
    return a.thumbnail.size() == cells && b.thumbnail.size() == cells
               ? tonemap::likeness(a.thumbnail, b.thumbnail)
               : 0;
}

namespace {

bool wants_lwa(const CgTmoOptions& o) {
    return o.method != "camera" && o.env.empty() && !number_of(o.lwa);
}
bool wants_lmax(const CgTmoOptions& o) {
    return !o.lmax && o.lights.table.empty() && o.maximum != "env";
}

// Of options with all that their preset has.
std::string lack_of_shots(const CgTmoOptions& o) {
    if ((wants_lwa(o) || wants_lmax(o)) && o.count != "lit")
        return format("count={} is not in the statistics of a shot (valid: lit)", o.count);
    if (wants_lwa(o) && o.lwa != "cells" && o.lwa != "geometric")
        return format("lwa={} is not in the statistics of a shot (valid: cells, geometric, or a "
                      "number)",
                      o.lwa);
    if (!wants_lmax(o))
        return "";
    if (o.maximum != "auto" && o.maximum != "image")
        return format("maximum={} is not in the statistics of a shot (valid: auto, image)",
                      o.maximum);
    if (*o.max_percentile != kShotPercentile)
        return format("maxpercentile={} is not in the statistics of a shot (valid: {}, or lmax=)",
                      *o.max_percentile, kShotPercentile);
    return "";
}

} // namespace

bool measures(const CgTmoOptions& options) {
    bool found = false;
    std::string why; // what is wrong with them is told when they are used
    return contained(why,
                     [&] {
                         const CgTmoOptions o = with_preset(options);
                         // Which frames are about one follows from the statistics, too.
                         found = wants_lwa(o) || wants_lmax(o) || o.steady;
                     }) &&
           found;
}

bool measures(const CalibrationOptions& options) {
    const auto method = options.method;
    return method == CalibrationMethod::Mean || method == CalibrationMethod::AutoKey ||
           options.white_percentile.has_value();
}

std::string not_of_shots(const CgTmoOptions& options) {
    std::string found, why;
    return contained(why, [&] { found = lack_of_shots(with_preset(options)); }) ? found : why;
}

std::string not_of_shots(const CalibrationOptions& options) {
    if (options.level > 0)
        return format("level={} has means of parts of each image, not of a shot (valid: 0)",
                      options.level);
    if (options.skip_black || options.skip_transparent || options.count == "all")
        return "the statistics of a shot are of the pixels that show something (valid: count=lit, "
               "without skipblack and skiptransparent)";
    if (options.epsilon != CalibrationOptions().epsilon)
        return format("epsilon={} is not in the statistics of a shot, whose means are of pixels "
                      "with light",
                      options.epsilon);
    return "";
}

} // namespace ToneAlgo
} // namespace tonetool
