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
#include "sequence/report/layer_pictures.h"
#include "sequence/report/look_sentence.h"
#include "sequence/report/report_text.h"
#include "sequence/report/scene_pixels.h"
#include "sequence/results/json_text.h"
#include "sequence/results/results_json.h"
#include "sequence/suite/approvable.h"
#include "text/text.h"
#include "tonetool/tonetool.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;
using OIIO::Strutil::fmt::format;

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
    std::set<size_t> full, large, exact;
    size_t small = 0, near = 0;
};

bool is_found(const Position& at, const FrameResult& frame) {
    return std::any_of(frame.faults.begin(), frame.faults.end(),
                       [&](const Fault& fault) { return fault.position == at; }) ||
           std::any_of(frame.measurements.begin(), frame.measurements.end(),
                       [&](const Measurement& one) { return one.worst == at; });
}

// The text of what a store wrote without what it says of the frame, empty if it is damaged: it
// would break the page.
std::string images_text(const std::string& text) {
    size_t begin = 0;
    for (int key = 0; key < 3 && begin != std::string::npos; ++key) // form, of, asked
        begin = text.find(',', begin + 1);
    return begin == std::string::npos || !ordered_json::accept(text) ? ""
                                                                     : "{" + text.substr(begin + 1);
}

// The images without those of spots that turned out to be no fault.
ordered_json with_faults_only(const std::string& text, const FrameResult& frame) {
    ordered_json pictures = parsed_or_null(images_text(text));
    if (!pictures.is_object() || !pictures.contains("spots"))
        return nullptr;
    ordered_json spots = ordered_json::array();
    try {
        for (const ordered_json& spot : pictures["spots"])
            if (is_found(
                    {whole_number<int>(spot.at("x"), "x"), whole_number<int>(spot.at("y"), "y")},
                    frame))
                spots.push_back(spot);
    } catch (const std::exception&) {
        return nullptr;
    }
    pictures["spots"] = spots;
    return pictures;
}

// Fills a page with elements of data as long as there is room.
class Blocks {
public:
    explicit Blocks(size_t room) : m_room(room) {}

    /// False if it does not fit, or is nothing.
    bool put(const std::string& id, const std::string& text) {
        if (text.empty() || text.size() > m_room)
            return false;
        m_html += format("<script type=\"application/json\" id=\"{}\">{}</script>\n", id,
                         script_data(text));
        m_room -= text.size();
        return true;
    }
    size_t room() const { return m_room; }
    void leave(size_t bytes) { m_room = bytes < m_room ? m_room - bytes : 0; }
    void give_back(size_t bytes) { m_room += bytes; }
    std::string html() && { return std::move(m_html); }

private:
    size_t m_room;
    std::string m_html;
};

std::string text_of(const ordered_json& images) {
    return images.is_null() ? "" : one_line(images);
}

struct FullFrame {
    size_t index;
    ordered_json images;
    std::string text;
};

// Those that fit; there is room for them from now on.
std::vector<FullFrame> full_frames(Blocks& blocks, const ShotResult& shot,
                                   const PictureStore& pictures) {
    std::vector<FullFrame> all;
    for (const size_t i : by_rank(shot)) {
        if (all.size() == pictures.counts().full)
            break;
        const FrameResult& frame = shot.frames[i];
        FullFrame one{i, with_faults_only(pictures.text(PictureSize::Full, frame), frame), ""};
        one.text = text_of(one.images);
        if (one.text.empty() || one.text.size() > blocks.room())
            continue;
        blocks.leave(one.text.size());
        all.push_back(std::move(one));
    }
    return all;
}

// Of the frames that have pictures in full some get them in the size of the file instead, where
// all the others still fit.
void put_large(Blocks& blocks, Kept& kept, const ShotResult& shot, const PictureStore& pictures,
               std::vector<FullFrame>& full) {
    for (FullFrame& one : full) {
        if (kept.large.size() == pictures.counts().large)
            return;
        const std::string large =
            images_text(pictures.text(PictureSize::Large, shot.frames[one.index]));
        if (!blocks.put(format("large-{}", one.index), large))
            continue;
        kept.large.insert(one.index);
        one.images.erase("pictures");
        blocks.give_back(one.text.size());
        one.text = one_line(one.images);
        blocks.leave(one.text.size());
    }
}

void put_exact(Blocks& blocks, Kept& kept, const ShotResult& shot, const PictureStore& pictures,
               const std::vector<FullFrame>& full) {
    const size_t most = std::min(full.size(), pictures.counts().of(PictureSize::Exact));
    for (size_t k = 0; k < most; ++k) {
        const size_t i = full[k].index;
        const std::string text = pictures.text(PictureSize::Exact, shot.frames[i]);
        if (blocks.put(format("exact-{}", i), images_text(text)))
            kept.exact.insert(i);
    }
}

// Of few frames: each has its files read once more.
void put_layers(Blocks& blocks, const ShotResult& shot, const std::vector<FullFrame>& full) {
    constexpr size_t most = 8;
    size_t put = 0;
    for (const FullFrame& one : full) {
        if (put == most)
            return;
        const std::string text = layer_pictures_json(shot.frames[one.index]);
        put += blocks.put(format("layers-{}", one.index), text) ? 1 : 0;
    }
}

// What was asked for comes first.
void put_pictures(Blocks& blocks, Kept& kept, const ShotResult& shot,
                  const PictureStore& pictures) {
    std::vector<FullFrame> full = full_frames(blocks, shot, pictures);
    const bool asked = pictures.counts().exact > 0;
    if (asked)
        put_exact(blocks, kept, shot, pictures, full);
    put_large(blocks, kept, shot, pictures, full);
    if (!asked)
        put_exact(blocks, kept, shot, pictures, full);
    put_layers(blocks, shot, full);
    for (const FullFrame& one : full) {
        blocks.give_back(one.text.size());
        blocks.put(format("full-{}", one.index), one.text);
        kept.full.insert(one.index);
        kept.near += one.images.contains("near") ? 1 : 0;
    }
}

Kept kept(const ShotResult& shot, const PictureStore& pictures, const PageLimits& limits,
          size_t room) {
    Kept result;
    const std::vector<size_t> order = by_rank(shot);
    Blocks small(std::min(limits.small_bytes, room));
    const size_t before = small.room();
    for (const size_t i : order) {
        const FrameResult& frame = shot.frames[i];
        result.small +=
            small.put(format("small-{}", i),
                      text_of(with_faults_only(pictures.text(PictureSize::Small, frame), frame)));
    }
    Blocks large(room - (before - small.room()));
    put_pictures(large, result, shot, pictures);
    result.blocks = std::move(small).html() + std::move(large).html();
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
    return format(
        "in full of {} of {} frames, the worst first, of {} of them in the size of the "
        "file; numbers around the worst pixel of {}, of the whole frame of {}; thumbnails "
        "of {}; this file takes at most {} MB",
        kept.full.size(), count, kept.large.size(), kept.near, kept.exact.size(), kept.small,
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
    return {{"log", {kLogLow, kLogHigh}},
            {"reduced", kPictureSide},
            {"error", "0 is no visible difference, 1 the largest. Each pixel shows the largest "
                      "error beneath it, so that a single pixel is not lost."},
            {"stops", "The exposure at which the error is largest."},
            {"bias", "Blocks that differ in more than their noise: blue where the test is darker, "
                     "orange where it is brighter. Plain grey: no difference beyond the noise. "
                     "Hatched dark: could not be tested. Hatched white: only the structure "
                     "differs."},
            {"thumbnails", "Of this frame only thumbnails were kept: it is not among the worst."}};
}

// The worst frames of which there are pictures in full.
std::set<size_t> pictured(const ShotResult& shot, const PictureStore& pictures) {
    std::set<size_t> found;
    for (const size_t i : by_rank(shot))
        if (found.size() < pictures.counts().full &&
            !pictures.text(PictureSize::Full, shot.frames[i]).empty())
            found.insert(i);
    return found;
}

// Leaves out the facts of --qc, and in long shots the histograms, which would be too large.
ordered_json trimmed(const ShotResult& shot, const PictureStore& pictures,
                     const PageLimits& limits) {
    ordered_json result = parse_json<ordered_json>(to_json(shot));
    result["worst"] = shot.worst; // here they are indices
    const bool many = shot.frames.size() > limits.detailed_frames;
    const std::set<size_t> detailed = many ? pictured(shot, pictures) : std::set<size_t>();
    size_t index = 0;
    for (ordered_json& frame : result["frames"]) {
        frame.erase("qc");
        frame.erase("against");
        const bool whole = !many || detailed.count(index++) > 0;
        for (ordered_json& measured : frame["measurements"]) {
            for (const char* key : {"histogram", "parameters", "settings", "attribution"})
                if (!whole)
                    measured.erase(key);
        }
    }
    return result;
}

// What --approve could approve.
ordered_json approve_json(const ShotResult& shot, const PageLimits& limits) {
    ordered_json cases = ordered_json::array();
    for (const FrameResult* frame : approvable_cases(shot)) {
        cases.push_back({{"index", frame - shot.frames.data()},
                         {"name", item_name(frame->item())},
                         {"quoted", shell_quoted(frame->name)},
                         {"status", status_name(frame->status)}});
    }
    return {{"start", approve_start(limits.json)}, {"cases", cases}};
}

std::string data_of(const ShotResult& shot, ordered_json result, const Kept& kept,
                    const PageLimits& limits) {
    ordered_json page{{"shot", std::move(result)},
                      {"legends",
                       {{"error", legend_uri("magma")},
                        {"stops", legend_uri("viridis")},
                        {"bias", bias_legend_uri()}}},
                      {"pictures", captions()},
                      {"about", about(shot, kept, limits)}};
    if (!approvable_cases(shot).empty())
        page["approve"] = approve_json(shot, limits);
    return one_line(page);
}

// ---- the page without JavaScript

std::string counts_html(const ShotResult& shot) {
    std::map<Status, size_t> counts;
    for (const FrameResult& frame : shot.frames)
        ++counts[frame.status];
    std::string html = format("<div><dt>{}</dt><dd>{}</dd></div>",
                              is_named(shot)   ? "cases"
                              : is_still(shot) ? "image"
                                               : "frames",
                              shot.frames.size());
    for (auto item = counts.rbegin(); item != counts.rend(); ++item) {
        html += format("<div class=\"{}\"><dt>{}</dt><dd>{}</dd></div>", page_class(item->first),
                       status_name(item->first), item->second);
    }
    return html;
}

std::string list_html(const ShotResult& shot, const PageLimits& limits) {
    std::string html = format("<table><tr><th>{}</th>", is_named(shot) ? "Case" : "Frame") +
                       "<th>Status</th><th>What</th></tr>\n";
    for (const FrameResult& frame : shot.frames) {
        const std::string command =
            is_approvable(shot, frame)
                ? "<br><code>" + escaped(approve_line(limits.json, shell_quoted(frame.name))) +
                      "</code>"
                : "";
        html += format("<tr><td>{}</td><td>{}</td><td>{}{}</td></tr>\n",
                       escaped(item_name(frame.item())), status_name(frame.status),
                       escaped(frame.message), command);
    }
    return html + "</table>";
}

// The names of the compared sequences, for the head of the page.
std::string shot_name(const ShotResult& shot) {
    std::string name;
    for (const FrameResult& frame : shot.frames)
        if (name.empty() && !frame.test.empty())
            name = frame.test + (frame.reference.empty() ? "" : " against " + frame.reference);
    if (shot.frames.empty() || is_still(shot))
        return name;
    if (is_named(shot))
        return format("{} case{}{}", shot.frames.size(), shot.frames.size() == 1 ? "" : "s",
                      name.empty() ? "" : ", from " + name);
    return format("frames {} to {}{}", item_name(shot.frames.front().item()),
                  item_name(shot.frames.back().item()), name.empty() ? "" : ", from " + name);
}

} // namespace

std::string report_page(const ShotResult& shot, const PictureStore& pictures,
                        const PageLimits& limits) {
    ordered_json result = trimmed(shot, pictures, limits);
    const std::string look = look_sentence(shot, result);
    // The plain list has each frame again, and the page itself takes less than a megabyte.
    const std::string list = list_html(shot, limits);
    const size_t taken = one_line(result).size() + list.size() + (size_t(1) << 20);
    const Kept found =
        kept(shot, pictures, limits, limits.bytes > taken ? limits.bytes - taken : 0);
    const std::string data = format("<script type=\"application/json\" id=\"result\">{}</script>\n",
                                    script_data(data_of(shot, std::move(result), found, limits)));
    const std::string verdict = status_name(shot.verdict);
    return filled(page::html, {{"policy", page_policy()},
                               {"version", escaped(version())},
                               {"title", escaped(verdict + ": " + shot_name(shot))},
                               {"style", page::style},
                               {"body_class", is_still(shot) ? "still" : ""},
                               {"verdict", escaped(verdict)},
                               {"verdict_class", page_class(shot.verdict)},
                               {"verdict_sign", page_sign(shot.verdict)},
                               {"look", escaped(look)},
                               {"sentence", escaped(shot.sentence)},
                               {"shot", escaped(shot_name(shot))},
                               {"counts", counts_html(shot)},
                               {"plain_list", list},
                               {"licences", page::licences},
                               {"data", data + found.blocks},
                               {"chart", page::chart},
                               {"script", page::script}});
}

} // namespace tonetool::sequence
