// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/limits_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>

#include "sequence/results/json_text.h"
#include "sequence/results/measuring.h"
#include "sequence/results/results_json.h"
#include "text/text.h"
#include "text/token.h"

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

// The modifiers of a command in a check.
Texts modifiers_of(const ShotResult& shot, const std::string& command) {
    for (const std::string& word : shot.check) {
        const Token token = parse_token(word, true);
        if (token.is_command && token.name == command)
            return Texts(token.modifiers.begin(), token.modifiers.end());
    }
    return {};
}

// What a check that was accepted measured: its noise is no more than that.
KeptLimits limits_of_check(const ShotResult& shot, const std::string& command,
                           const std::string& quantity) {
    constexpr double margin = 1.1;
    const bool up = higher_is_better(command, quantity);
    std::optional<double> extreme;
    for (const FrameResult& frame : shot.frames) {
        for (const Measurement& measured : frame.measurements) {
            const auto value = quantity_of(measured, quantity);
            if (has_problem(frame.status) || measured.command != command || !value ||
                !std::isfinite(*value))
                continue;
            extreme = !extreme ? *value
                      : up     ? std::min(*extreme, *value)
                               : std::max(*extreme, *value);
        }
    }
    if (!extreme) {
        throw std::runtime_error(format(
            "is a check without a passed frame that --{} measured {} of", command, quantity));
    }
    KeptLimits kept;
    kept.command = command;
    kept.modifiers = modifiers_of(shot, command);
    kept.limits.emplace_back();
    kept.limits.back().quantity = quantity;
    kept.limits.back().floor.limit = up ? *extreme / margin : *extreme * margin;
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

KeptLimits read_limits(const std::string& file, const std::string& command,
                       const std::string& quantity) {
    // Each frame of a shot asks for the same.
    static std::mutex mutex;
    static std::map<std::tuple<std::string, std::string, std::string, std::time_t>, KeptLimits> all;
    const std::lock_guard<std::mutex> lock(mutex);
    const auto key =
        std::make_tuple(file, command, quantity, OIIO::Filesystem::last_write_time(file));
    const auto known = all.find(key);
    if (known != all.end())
        return known->second;
    std::string text;
    if (!OIIO::Filesystem::read_text_file(file, text))
        throw std::runtime_error(format("could not read the limits \"{}\"", file));
    try {
        const ordered_json json = parsed_or_null(text);
        const bool check = json.is_object() && json.value("format", "") == kResultsFormat;
        return all[key] = check ? limits_of_check(shot_from_json(text), command, quantity)
                                : parsed(text, limits_of);
    } catch (const std::runtime_error& problem) {
        throw std::runtime_error(format("\"{}\" {} (valid: a file of --noisefloor, or --json of a "
                                        "check that passed)",
                                        file, problem.what()));
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
