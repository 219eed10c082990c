// SPDX-License-Identifier: BSD-3-Clause
// Files of the statistics of shots.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/json_reading.h"
#include "imagebuf/tone/shot_statistics.h"
#include "metrics/refusal.h"
#include "tonemap/camera_fit.h"
#include "tonemap/shot.h"

namespace tonetool {
namespace {

using nlohmann::ordered_json;
using OIIO::Strutil::fmt::format;

constexpr char kShotFormat[] = "tonetool-shot";
constexpr int kShotVersion = 1;
constexpr size_t kThumbnailCells =
    size_t(tonemap::kThumbnailWidth) * size_t(tonemap::kThumbnailHeight);

constexpr size_t kCameraNumbers = std::tuple_size_v<tonemap::Projection>;
// Means are of doubles, the maximum is a float.
constexpr double kRounding = 1e-6;

// The numbers of a frame in their order; unit and fps are left out where the header has none.
template <class Light, class Visit>
void visit_numbers(Light& light, const Visit& visit) {
    visit("lwa", light.lwa);
    visit("lwa_geometric", light.lwa_geometric);
    visit("lmax", light.lmax);
    visit("maximum", light.maximum);
    visit("shown", light.shown);
}

ordered_json json_of(const FrameLight& light) {
    ordered_json to{{"frame", light.frame}};
    if (!light.view.empty())
        to["view"] = light.view;
    visit_numbers(light, [&](const char* key, double value) { to[key] = value; });
    to["counted"] = light.counted;
    to["unit"] = light.unit > 0 ? ordered_json(light.unit) : ordered_json();
    to["fps"] = light.fps > 0 ? ordered_json(light.fps) : ordered_json();
    to["histogram"] = light.histogram;
    to["thumbnail"] = light.thumbnail;
    to["camera"] = light.camera.empty() ? ordered_json() : ordered_json(light.camera);
    return to;
}

std::string line_of(const ordered_json& value) {
    return value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// What no measured frame has: a file that was edited, or of another program.
void check_light(const FrameLight& light) {
    const auto fail = [&](const std::string& what) {
        throw Refusal(format("frame {}: {}", light.frame, what));
    };
    const auto within = [&](const char* key, double value, double least, double most) {
        if (!(value >= least && value <= most))
            fail(format("\"{}\" is {}: must be from {} to {}", key, value, least, most));
    };
    const auto not_negative = [&](const char* key, double value) {
        if (!(value >= 0) || !std::isfinite(value))
            fail(format("\"{}\" is {}: must be finite and not below 0", key, value));
    };
    visit_numbers(light, not_negative);
    not_negative("unit", light.unit);
    not_negative("fps", light.fps);
    within("maximum", light.maximum, 0, std::numeric_limits<float>::max());
    within("shown", light.shown, 0, 1);
    for (const auto& [key, value] :
         {std::pair("lwa", light.lwa), std::pair("lwa_geometric", light.lwa_geometric),
          std::pair("lmax", light.lmax)})
        if (value > light.maximum * (1 + kRounding))
            fail(format("\"{}\" is {}: must not be above \"maximum\", {}", key, value,
                        light.maximum));
    const bool lit = light.lwa > 0;
    if (lit != (light.lwa_geometric > 0) || lit != (light.lmax > 0) || lit != (light.counted > 0))
        fail("some of lwa, lwa_geometric, lmax and counted are 0, others are not");
    if (light.histogram.size() != size_t(tonemap::kLightBins))
        fail(format("\"histogram\" has {} counts: must be {}", light.histogram.size(),
                    tonemap::kLightBins));
    for (const int64_t count : light.histogram)
        not_negative("histogram", double(count));
    const double in_bins = std::accumulate(light.histogram.begin(), light.histogram.end(), 0.0);
    if (in_bins != double(light.counted))
        fail(format("the counts of \"histogram\" are {} together: must be \"counted\", {}", in_bins,
                    light.counted));
    if (light.thumbnail.size() != kThumbnailCells)
        fail(format("\"thumbnail\" has {} numbers: must be {}", light.thumbnail.size(),
                    kThumbnailCells));
    const auto [darkest, brightest] = tonemap::thumbnail_range();
    for (const double cell : light.thumbnail)
        within("thumbnail", cell, std::floor(darkest), std::ceil(brightest));
    if (!light.camera.empty() && light.camera.size() != kCameraNumbers)
        fail(format("\"camera\" has {} numbers: must be {}", light.camera.size(), kCameraNumbers));
}

double number_or_none(const ordered_json& from, const char* key) {
    return !from.contains(key) || from.at(key).is_null() ? 0 : finite_number(from.at(key), key);
}

FrameLight light_of(const ordered_json& from) {
    FrameLight light;
    light.frame = whole_number<int>(from.at("frame"), "frame");
    light.view = from.value("view", std::string());
    visit_numbers(
        light, [&](const char* key, double& value) { value = finite_number(from.at(key), key); });
    light.counted = whole_number<int64_t>(from.at("counted"), "counted");
    light.unit = number_or_none(from, "unit");
    light.fps = number_or_none(from, "fps");
    for (const ordered_json& count : from.at("histogram"))
        light.histogram.push_back(whole_number<int64_t>(count, "histogram"));
    for (const ordered_json& cell : from.at("thumbnail"))
        light.thumbnail.push_back(finite_number(cell, "thumbnail"));
    if (from.contains("camera") && !from.at("camera").is_null())
        for (const ordered_json& number : from.at("camera"))
            light.camera.push_back(finite_number(number, "camera"));
    check_light(light);
    return light;
}

bool same_light(const FrameLight& a, const FrameLight& b) {
    return line_of(json_of(a)) == line_of(json_of(b));
}

void check_mode(const std::string& mode) {
    check_one_of("mode", mode, {"shot", "eye", "smooth"});
}

// By number and view; of two that are the same one stays.
void sort_frames(std::vector<FrameLight>& frames) {
    const auto key = [](const FrameLight& one) { return std::tie(one.frame, one.view); };
    std::stable_sort(frames.begin(), frames.end(),
                     [&](const auto& a, const auto& b) { return key(a) < key(b); });
    for (size_t i = 1; i < frames.size(); ++i)
        if (key(frames[i - 1]) == key(frames[i]) && !same_light(frames[i - 1], frames[i]))
            throw Refusal(format("frame {}{} is there twice, with other numbers (valid: parts of "
                                 "one shot, measured alike)",
                                 frames[i].frame,
                                 frames[i].view.empty() ? "" : ", view " + frames[i].view));
    frames.erase(std::unique(frames.begin(), frames.end(),
                             [&](const auto& a, const auto& b) { return key(a) == key(b); }),
                 frames.end());
}

ordered_json parsed_shot(const std::string& text) {
    ordered_json json = parse_json<ordered_json>(text);
    const std::string kind =
        json.is_object() && json.contains("format") ? shown_json(json.at("format")) : "";
    if (kind != "\"" + std::string(kShotFormat) + "\"")
        throw Refusal(format("is {}, not the statistics of a shot (valid: \"format\": \"{}\", what "
                             "--statistics writes with --cgtmo, --tonemap or --calibrate)",
                             kind.empty() ? "JSON of no format" : kind, kShotFormat));
    const int version = whole_number<int>(json.at("version"), "version");
    if (version != kShotVersion)
        throw Refusal(format("is of version {} (valid: {})", version, kShotVersion));
    return json;
}

ShotStatistics merged_shots(const std::vector<ShotStatistics>& parts) {
    ShotStatistics all;
    for (const ShotStatistics& part : parts) {
        if (part.mode != parts.front().mode)
            throw Refusal(format("a part is of mode \"{}\", another of mode \"{}\" (valid: parts "
                                 "of one command line)",
                                 parts.front().mode, part.mode));
        all.mode = part.mode;
        all.frames.insert(all.frames.end(), part.frames.begin(), part.frames.end());
    }
    sort_frames(all.frames);
    return all;
}

} // namespace

std::string text_of_shot(ShotStatistics shot) {
    check_mode(shot.mode);
    sort_frames(shot.frames);
    std::string text = format("{{\n \"format\": \"{}\",\n \"version\": {},\n \"mode\": \"{}\",\n "
                              "\"frames\": [",
                              kShotFormat, kShotVersion, shot.mode);
    for (size_t i = 0; i < shot.frames.size(); ++i) {
        check_light(shot.frames[i]);
        text += (i > 0 ? ",\n  " : "\n  ") + line_of(json_of(shot.frames[i]));
    }
    return text + "\n ]\n}\n";
}

ShotStatistics shot_from_text(const std::string& text) {
    try {
        const ordered_json json = parsed_shot(text);
        ShotStatistics shot;
        shot.mode = json.at("mode").get<std::string>();
        check_mode(shot.mode);
        for (const ordered_json& frame : json.at("frames"))
            shot.frames.push_back(light_of(frame));
        sort_frames(shot.frames);
        return shot;
    } catch (const nlohmann::json::exception& problem) {
        throw Refusal(reason_of(problem));
    } catch (const std::runtime_error& problem) { // of json_reading.h
        throw Refusal(problem.what());
    }
}

ShotStatistics shot_from_file(const std::string& file) {
    std::string text;
    if (!OIIO::Filesystem::is_regular(file))
        throw Refusal(format("statistics of a shot: no file \"{}\" (valid: frame, shot, eye, "
                             "smooth, or a file that --statistics wrote)",
                             file));
    if (!OIIO::Filesystem::read_text_file(file, text))
        throw Refusal(format("statistics of a shot: \"{}\" cannot be read", file));
    return refusing_as(
        [&](const std::string& why) {
            return format("statistics of a shot: \"{}\": {}", file, why);
        },
        [&] { return shot_from_text(text); });
}

namespace ToneAlgo {

bool shot_text(std::string& text, const ShotStatistics& shot, std::string& error) {
    return contained(error, [&] { text = text_of_shot(shot); });
}

bool shot_of_text(ShotStatistics& shot, const std::string& text, std::string& error) {
    return contained(error, [&] { shot = shot_from_text(text); });
}

bool read_shot(ShotStatistics& shot, const std::string& file, std::string& error) {
    return contained(error, [&] { shot = shot_from_file(file); });
}

bool merge_shots(ShotStatistics& shot, const std::vector<ShotStatistics>& parts,
                 std::string& error) {
    return contained(error, [&] { shot = merged_shots(parts); });
}

} // namespace ToneAlgo
} // namespace tonetool
