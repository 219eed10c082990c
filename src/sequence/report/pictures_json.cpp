// SPDX-License-Identifier: BSD-3-Clause
// The images of a frame as the page reads them.
#include <nlohmann/json.hpp>

#include "sequence/report/report_pictures.h"
#include "sequence/results/json_text.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;

ordered_json json_of(const std::vector<SpotPictures>& spots) {
    ordered_json list = ordered_json::array();
    for (const SpotPictures& spot : spots) {
        list.push_back({{"x", spot.at.x},
                        {"y", spot.at.y},
                        {"reference", spot.reference},
                        {"test", spot.test},
                        {"error", spot.error}});
    }
    return list;
}

ordered_json json_of(const PairTexts& pair) {
    return {{"reference", pair.reference}, {"test", pair.test}};
}

ordered_json json_of(const NumberTexts& numbers) {
    if (numbers.high.empty())
        return nullptr;
    ordered_json to{{"high", numbers.high}, {"low", numbers.low}};
    if (!numbers.alpha.empty())
        to["alpha"] = numbers.alpha;
    if (numbers.one_alpha)
        to["one_alpha"] = *numbers.one_alpha;
    return to;
}

ordered_json json_of(const NumberPictures& numbers) {
    return {{"x", numbers.x},
            {"y", numbers.y},
            {"width", numbers.width},
            {"height", numbers.height},
            {"columns", numbers.columns},
            {"rows", numbers.rows},
            {"reference", json_of(numbers.reference)},
            {"test", json_of(numbers.test)},
            {"error", numbers.error}};
}

} // namespace

std::string full_json(const FramePictures& pictures) {
    if (pictures.pictures.test.empty())
        return "";
    ordered_json to{{"x", pictures.x},
                    {"y", pictures.y},
                    {"width", pictures.width},
                    {"height", pictures.height},
                    {"orientation", pictures.orientation},
                    {"start", pictures.start},
                    {"space", pictures.space},
                    {"pictures", json_of(pictures.pictures)},
                    {"alpha", json_of(pictures.alpha)},
                    {"error", pictures.error},
                    {"stops", pictures.stops},
                    {"range", {pictures.first_stop, pictures.last_stop}}};
    if (!pictures.bias.empty()) {
        to["bias"] = pictures.bias;
        to["bias_range"] = pictures.bias_range;
    }
    if (pictures.near)
        to["near"] = json_of(*pictures.near);
    to["spots"] = json_of(pictures.spots);
    return one_line(to);
}

std::string large_json(const FramePictures& pictures) {
    // Data URIs are plain text, and long.
    return pictures.large.test.empty() ? ""
                                       : "{\"reference\":\"" + pictures.large.reference +
                                             "\",\"test\":\"" + pictures.large.test + "\"}";
}

std::string exact_json(const FramePictures& pictures) {
    return pictures.exact ? one_line(json_of(*pictures.exact)) : "";
}

std::string small_json(const FramePictures& pictures) {
    return one_line({{"test", pictures.small_test},
                     {"error", pictures.small_error},
                     {"spots", json_of(pictures.spots)}});
}

} // namespace tonetool::sequence
