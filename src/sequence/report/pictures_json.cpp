// SPDX-License-Identifier: BSD-3-Clause
// The images of a frame as the page reads them.
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "sequence/report/report_pictures.h"
#include "sequence/results/json_text.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;

// An object whose values are JSON already. Pictures are megabytes of plain text, which a document
// of all values would hold, and look at each letter of, several times.
class Object {
public:
    Object& text(const char* key, const std::string& json) {
        m_text += m_text.empty() ? "{\"" : ",\"";
        ((m_text += key) += "\":") += json;
        return *this;
    }
    Object& uri(const char* key, const std::string& uri) {
        text(key, "\"");
        (m_text += uri) += '"';
        return *this;
    }
    Object& value(const char* key, const ordered_json& value) { return text(key, one_line(value)); }
    std::string done() {
        m_text += '}';
        return std::move(m_text);
    }

private:
    std::string m_text;
};

std::string json_of(const std::vector<SpotPictures>& spots) {
    std::string list;
    for (const SpotPictures& spot : spots) {
        list += list.empty() ? "[" : ",";
        list += Object()
                    .value("x", spot.at.x)
                    .value("y", spot.at.y)
                    .uri("reference", spot.reference)
                    .uri("test", spot.test)
                    .uri("error", spot.error)
                    .done();
    }
    return list.empty() ? "[]" : list + "]";
}

std::string json_of(const PairTexts& pair) {
    return Object().uri("reference", pair.reference).uri("test", pair.test).done();
}

std::string json_of(const NumberTexts& numbers) {
    if (numbers.high.empty())
        return "null";
    Object to;
    to.uri("high", numbers.high).uri("low", numbers.low);
    if (!numbers.alpha.empty())
        to.uri("alpha", numbers.alpha);
    if (numbers.one_alpha)
        to.value("one_alpha", *numbers.one_alpha);
    return to.done();
}

std::string json_of(const NumberPictures& numbers) {
    return Object()
        .value("x", numbers.x)
        .value("y", numbers.y)
        .value("width", numbers.width)
        .value("height", numbers.height)
        .value("columns", numbers.columns)
        .value("rows", numbers.rows)
        .text("reference", json_of(numbers.reference))
        .text("test", json_of(numbers.test))
        .uri("error", numbers.error)
        .done();
}

} // namespace

std::string full_json(const FramePictures& pictures) {
    if (pictures.pictures.test.empty())
        return "";
    Object to;
    to.value("x", pictures.x)
        .value("y", pictures.y)
        .value("width", pictures.width)
        .value("height", pictures.height)
        .value("orientation", pictures.orientation)
        .value("start", pictures.start)
        .value("space", pictures.space)
        .text("pictures", json_of(pictures.pictures))
        .text("alpha", json_of(pictures.alpha))
        .uri("error", pictures.error)
        .uri("stops", pictures.stops)
        .value("range", {pictures.first_stop, pictures.last_stop});
    if (!pictures.bias.empty())
        to.uri("bias", pictures.bias).value("bias_range", pictures.bias_range);
    if (pictures.near)
        to.text("near", json_of(*pictures.near));
    to.text("spots", json_of(pictures.spots));
    return to.done();
}

std::string large_json(const FramePictures& pictures) {
    return pictures.large.test.empty() ? "" : json_of(pictures.large);
}

std::string exact_json(const FramePictures& pictures) {
    return pictures.exact ? json_of(*pictures.exact) : "";
}

std::string small_json(const FramePictures& pictures) {
    return Object()
        .uri("test", pictures.small_test)
        .uri("error", pictures.small_error)
        .text("spots", json_of(pictures.spots))
        .done();
}

} // namespace tonetool::sequence
