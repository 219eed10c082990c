// SPDX-License-Identifier: BSD-3-Clause
// What a person reads about a pair: what was compared, how, and the numbers that matter.
#include <OpenImageIO/strutil.h>

#include "chain/commands/flip_report.h"
#include "imagebuf/pixels/layer_name.h"
#include "text/printable.h"

namespace tonetool::chain {

namespace {

using OIIO::Strutil::fmt::format;

// Nothing of a plain R, G, B, the usual case.
std::string layers_text(const FlipSide& first, const FlipSide& second) {
    if (first.layer == second.layer)
        return first.layer.empty() ? "" : ", layer " + first.layer;
    return ", layer " + shown_layer(second.layer) + " against " + shown_layer(first.layer);
}

// Nothing of what needed no conversion.
std::string spaces_text(const FlipSide& first, const FlipSide& second) {
    if (first.space == second.space)
        return first.space == "rec709" ? "" : ", colour space " + first.space;
    return ", colour space " + second.space + " against " + first.space;
}

std::string size_text(const OIIO::ROI& region) {
    return format(", {}x{} pixels", region.width(), region.height());
}

std::string what_text(const PairSummary& summary, const std::string& reference,
                      const std::string& test) {
    return printable(test) + " against " + printable(reference) +
           layers_text(summary.reference, summary.test) +
           spaces_text(summary.reference, summary.test) + size_text(summary.region) +
           ignored_text(summary.ignored);
}

std::string exposures_text(const std::vector<double>& stops) {
    return stops.size() == 1 ? format("1 exposure of {:.3g} stops", stops.front())
                             : format("{} exposures from {:.3g} to {:.3g} stops", stops.size(),
                                      stops.front(), stops.back());
}

std::string how_text(const FlipSummary& summary) {
    std::string text;
    if (summary.hdr)
        text = exposures_text(summary.exposures) + ", tone curve " + summary.tonemapper + ", ";
    return text + format("{:.3g} pixels per degree", summary.ppd);
}

// Counts that no warning is given for.
Strings unusual(const FlipSide& side, const char* who) {
    if (side.negative == 0)
        return {};
    return {
        format("{} pixel(s) of the {} have negative values, which count as 0", side.negative, who)};
}

void add_unusual(Strings& lines, const PairSummary& summary, bool median_of_lit) {
    Strings notes = unusual(summary.reference, "reference");
    for (std::string& note : unusual(summary.test, "test"))
        notes.push_back(std::move(note));
    if (median_of_lit) {
        notes.push_back("more than half of the reference is black: the last exposure is made from "
                        "the median of the rest");
    }
    if (summary.alpha_compared)
        notes.push_back(format("alpha differs by up to {}", format_number(summary.alpha_max)));
    if (!notes.empty())
        lines.push_back("note: " + join(notes, "; "));
}

std::string labelled(const std::string& label, const Strings& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += (text.empty() ? "" : "\n") + label + ": " + line;
    return text;
}

} // namespace

std::string ignored_text(const std::optional<double>& share) {
    constexpr double percent = 100;
    return share ? format(", {:.3g} % ignored", percent * *share) : "";
}

std::string numbers_text(const FlipSummary& summary) {
    const FlipPool& pool = summary.pool;
    return format("mean {}, p99.9 {}, max {} at {},{}", format_number(pool.mean),
                  format_number(pool.p999), format_number(pool.max), pool.max_x, pool.max_y);
}

std::string numbers_text(const ErrorSummary& summary) {
    const FlipPool& pool = summary.pool;
    const std::string value = summary.metric + " " + format_number(summary.value) +
                              (summary.decibels ? " dB; in its map" : ",");
    return value + format(" p99.9 {}, max {} at {},{}", format_number(pool.p999),
                          format_number(pool.max), pool.max_x, pool.max_y);
}

std::string numbers_text(const TmqiSummary& summary) {
    const TmqiScore& score = summary.score;
    return format("Q {}, structure S {}, naturalness N {} (1 is best)", format_number(score.q),
                  format_number(score.s), format_number(score.n));
}

std::string brief_text(const std::string& label, const FlipSummary& summary,
                       const std::string& first, const std::string& second) {
    Strings lines{what_text(summary, first, second), how_text(summary), numbers_text(summary)};
    add_unusual(lines, summary, summary.median_of_lit);
    return labelled(label, lines);
}

std::string brief_text(const std::string& label, const ErrorSummary& summary,
                       const std::string& first, const std::string& second) {
    Strings lines{what_text(summary, first, second)};
    if (!summary.exposures.empty())
        lines.push_back(exposures_text(summary.exposures));
    lines.push_back(numbers_text(summary));
    add_unusual(lines, summary, false);
    return labelled(label, lines);
}

std::string brief_text(const std::string& label, const TmqiSummary& summary,
                       const std::string& first, const std::string& second) {
    return labelled(label, {printable(second) + " as a picture of " + printable(first) +
                                layers_text(summary.hdr, summary.ldr),
                            numbers_text(summary)});
}

} // namespace tonetool::chain
