// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/limits_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <stdexcept>

#include "sequence/results/json_text.h"
#include "text/text.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;
using OIIO::Strutil::fmt::format;

constexpr char kLimitsFormat[] = "tonetool-limits";
constexpr int kLimitsVersion = 1;

ordered_json json_of(const KeptLimit& limit) {
    ordered_json to{{"quantity", limit.quantity},
                    {"limit", limit.floor.limit},
                    {"method", ToneAlgo::noise_floor_method(limit.floor)},
                    {"needed_for_order_statistic", limit.floor.needed},
                    {"values", limit.values}};
    if (limit.floor.outlier)
        to["outlier"] = *limit.floor.outlier;
    return to;
}

KeptLimits limits_of(const ordered_json& json) {
    check_format(json, kLimitsFormat, kLimitsVersion);
    KeptLimits kept;
    kept.command = json.at("command").get<std::string>();
    for (const auto& item : json.at("modifiers").items())
        kept.modifiers.emplace_back(item.key(), item.value().get<std::string>());
    each_of(json.at("limits"), "limits", [&](const ordered_json& one, const std::string&) {
        KeptLimit limit;
        limit.quantity = one.at("quantity").get<std::string>();
        limit.floor.limit = finite_number(one.at("limit"), "limit");
        kept.limits.push_back(limit);
    });
    if (kept.limits.empty())
        throw std::runtime_error("has no limits");
    return kept;
}

} // namespace

std::string to_json(const KeptLimits& limits) {
    ordered_json modifiers = ordered_json::object();
    for (const auto& [key, value] : limits.modifiers)
        modifiers[key] = value;
    ordered_json to{{"format", kLimitsFormat},
                    {"version", kLimitsVersion},
                    {"command", limits.command},
                    {"modifiers", modifiers},
                    {"content", limits.options.content},
                    {"confidence", limits.options.confidence},
                    {"limits", ordered_json::array()},
                    {"reference", limits.reference},
                    {"seeds", limits.seeds}};
    for (const KeptLimit& limit : limits.limits)
        to["limits"].push_back(json_of(limit));
    if (!limits.baseline.empty())
        to["baseline"] = limits.baseline;
    if (!limits.warnings.empty())
        to["warnings"] = limits.warnings;
    return dumped(to);
}

KeptLimits read_limits(const std::string& file) {
    std::string text;
    if (!OIIO::Filesystem::read_text_file(file, text))
        throw std::runtime_error(format("could not read the limits \"{}\"", file));
    try {
        return parsed(text, limits_of);
    } catch (const std::runtime_error& problem) {
        throw std::runtime_error(
            format("\"{}\" {} (valid: a file of --noisefloor)", file, problem.what()));
    }
}

bool names_limits_file(const std::string& text) {
    return OIIO::Strutil::iends_with(text, ".json") ||
           (!text.empty() && !parse_number(text) && text.find('=') == std::string::npos &&
            OIIO::Filesystem::is_regular(text));
}

std::string limits_text(const KeptLimits& limits) {
    std::vector<std::string> words;
    for (const KeptLimit& limit : limits.limits)
        words.push_back(format("{}={}", limit.quantity, limit.floor.limit));
    return join(words, ",");
}

} // namespace tonetool::sequence
