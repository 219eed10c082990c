// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_page.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <exception>
#include <map>
#include <set>
#include <vector>

#include "sequence/page/files.h"
#include "sequence/report/report_text.h"
#include "sequence/results/json_text.h"
#include "sequence/results/results_json.h"
#include "tonetool/tonetool.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;
using OIIO::Strutil::fmt::format;

std::string name_of(const FrameResult& frame) {
    return std::to_string(frame.frame) + (frame.view.empty() ? "" : " " + frame.view);
}

// ---- pictures

std::vector<size_t> by_rank(const ShotResult& shot) {
    std::vector<size_t> order(shot.frames.size());
    for (size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    const auto rank = [&](size_t i) {
        return std::make_pair(-int(shot.frames[i].status), -badness(shot.frames[i]));
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](size_t a, size_t b) { return rank(a) < rank(b); });
    return order;
}

struct Kept {
    std::string blocks; ///< HTML elements with their data
    std::set<size_t> full;
    size_t small = 0;
};

bool is_found(const Position& at, const FrameResult& frame) {
    return std::any_of(frame.faults.begin(), frame.faults.end(),
                       [&](const Fault& fault) { return fault.position == at; }) ||
           std::any_of(frame.measurements.begin(), frame.measurements.end(),
                       [&](const Measurement& one) { return one.worst == at; });
}

// The images without those of spots that turned out to be no fault. Empty where the text is not one
// that a store wrote: it would break the page.
std::string trimmed(const std::string& text, const FrameResult& frame) {
    ordered_json pictures = parsed_or_null(text);
    if (!pictures.is_object() || !pictures.contains("spots"))
        return "";
    ordered_json spots = ordered_json::array();
    try {
        for (const ordered_json& spot : pictures["spots"])
            if (is_found(
                    {whole_number<int>(spot.at("x"), "x"), whole_number<int>(spot.at("y"), "y")},
                    frame))
                spots.push_back(spot);
    } catch (const std::exception&) {
        return "";
    }
    pictures["spots"] = spots;
    pictures.erase("of");
    return one_line(pictures);
}

// Adds an element of data if it fits.
size_t put_block(std::string& blocks, const std::string& id, const std::string& text, size_t room) {
    if (text.empty() || text.size() > room)
        return 0;
    blocks +=
        format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id, script_data(text));
    return text.size();
}

Kept kept(const ShotResult& shot, const PictureStore& pictures, const PageLimits& limits) {
    Kept result;
    const std::vector<size_t> order = by_rank(shot);
    size_t small = 0;
    for (const size_t i : order) {
        const size_t room = std::min(limits.small_bytes, limits.bytes) - small;
        const size_t taken =
            put_block(result.blocks, format("small-{}", i),
                      trimmed(pictures.small(shot.frames[i]), shot.frames[i]), room);
        result.small += taken > 0 ? 1 : 0;
        small += taken;
    }
    size_t room = limits.bytes - small;
    for (const size_t i : order) {
        const size_t taken =
            put_block(result.blocks, format("full-{}", i),
                      trimmed(pictures.full(shot.frames[i]), shot.frames[i]), room);
        if (taken > 0)
            result.full.insert(i);
        room -= taken;
    }
    return result;
}

// ---- data

std::string exposures_text(const ShotResult& shot) {
    if (!shot.exposures)
        return "of each frame";
    return format("of the whole shot, from a maximum luminance of {:.6g} and a median of {:.6g} "
                  "over {} frames",
                  shot.exposures->max_luminance, shot.exposures->median_luminance,
                  shot.exposures->frames);
}

std::string pictures_text(const ShotResult& shot, const Kept& kept, const PageLimits& limits) {
    const size_t count = shot.frames.size();
    return format("in full of {} of {} frames, the worst first; thumbnails of {}; this file holds "
                  "at most {} full frames and {} MB of pictures",
                  kept.full.size(), count, kept.small, PictureStore::kMostFullFrames,
                  limits.bytes >> 20);
}

using AboutRows = std::vector<std::array<std::string, 2>>;

AboutRows about(const ShotResult& shot, const Kept& kept, const PageLimits& limits) {
    std::string check = "tonetool";
    for (const std::string& word : shot.check)
        check += " " + word;
    return {{"Command line", check},
            {"Exposures", exposures_text(shot)},
            {"Pictures", pictures_text(shot, kept, limits)},
            {"Made by", std::string("tonetool ") + version()}};
}

ordered_json captions() {
    return {{"shown",
             format("As compared at this exposure; large images are reduced to {} pixels. Drag "
                    "in the picture, or use the slider.",
                    kPictureSide)},
            {"error", "0 is no visible difference, 1 the largest. Each pixel shows the largest "
                      "error beneath it, so that a single pixel is not lost."},
            {"stops", "The exposure at which the error is largest."},
            {"bias", "Blocks that differ in more than their noise: blue where the test is darker, "
                     "orange where it is brighter. Plain grey: no difference beyond the noise. "
                     "Hatched dark: could not be tested. Hatched white: only the structure "
                     "differs."},
            {"thumbnails", "Of this frame only thumbnails were kept: it is not among the worst."}};
}

// Leaves out the facts of --qc, and in long shots the histograms, which would be too large.
void trim(ordered_json& result, const Kept& kept, const PageLimits& limits) {
    const bool many = result["frames"].size() > limits.detailed_frames;
    size_t index = 0;
    for (ordered_json& frame : result["frames"]) {
        frame.erase("qc");
        frame.erase("against");
        const bool whole = !many || kept.full.count(index++) > 0;
        for (ordered_json& measured : frame["measurements"]) {
            for (const char* key : {"histogram", "parameters", "settings"})
                if (!whole)
                    measured.erase(key);
        }
    }
}

std::string data_of(const ShotResult& shot, const Kept& kept, const PageLimits& limits) {
    ordered_json result = parse_json<ordered_json>(to_json(shot));
    result["worst"] = shot.worst; // here they are indices
    trim(result, kept, limits);
    const ordered_json page{{"shot", result},
                            {"legends",
                             {{"error", legend_uri("magma")},
                              {"stops", legend_uri("viridis")},
                              {"bias", bias_legend_uri()}}},
                            {"pictures", captions()},
                            {"about", about(shot, kept, limits)}};
    return one_line(page);
}

// ---- the page without JavaScript

std::string counts_html(const ShotResult& shot) {
    std::map<Status, size_t> counts;
    for (const FrameResult& frame : shot.frames)
        ++counts[frame.status];
    std::string html = format("<div><dt>frames</dt><dd>{}</dd></div>", shot.frames.size());
    for (auto item = counts.rbegin(); item != counts.rend(); ++item) {
        html += format("<div class=\"{}\"><dt>{}</dt><dd>{}</dd></div>", page_class(item->first),
                       status_name(item->first), item->second);
    }
    return html;
}

std::string list_html(const ShotResult& shot) {
    std::string html = "<table><tr><th>Frame</th><th>Status</th><th>What</th></tr>\n";
    for (const FrameResult& frame : shot.frames) {
        html += format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", escaped(name_of(frame)),
                       status_name(frame.status), escaped(frame.message));
    }
    return html + "</table>";
}

// The names of the compared sequences, for the head of the page.
std::string shot_name(const ShotResult& shot) {
    std::string name;
    for (const FrameResult& frame : shot.frames)
        if (name.empty() && !frame.test.empty())
            name = frame.test + (frame.reference.empty() ? "" : " against " + frame.reference);
    if (shot.frames.empty())
        return name;
    return format("frames {} to {}{}", name_of(shot.frames.front()), name_of(shot.frames.back()),
                  name.empty() ? "" : ", from " + name);
}

} // namespace

std::string report_page(const ShotResult& shot, const PictureStore& pictures,
                        const PageLimits& limits) {
    const Kept found = kept(shot, pictures, limits);
    const std::string data = format("<script type=\"application/json\" id=\"result\">{}</script>\n",
                                    script_data(data_of(shot, found, limits)));
    const std::string verdict = status_name(shot.verdict);
    return filled(page::html, {{"policy", page_policy()},
                               {"version", escaped(version())},
                               {"title", escaped(verdict + ": " + shot_name(shot))},
                               {"style", page::style},
                               {"verdict", escaped(verdict)},
                               {"verdict_class", page_class(shot.verdict)},
                               {"verdict_sign", page_sign(shot.verdict)},
                               {"sentence", escaped(shot.sentence)},
                               {"shot", escaped(shot_name(shot))},
                               {"counts", counts_html(shot)},
                               {"plain_list", list_html(shot)},
                               {"licences", page::licences},
                               {"data", data + found.blocks},
                               {"chart", page::chart},
                               {"script", page::script}});
}

} // namespace tonetool::sequence
