// SPDX-License-Identifier: BSD-3-Clause
#include "store/record.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "imagebuf/pixels/json_reading.h"

namespace tonetool::store {

namespace {

using nlohmann::ordered_json;

constexpr char kFormat[] = "tonetool-approved";
constexpr int kVersion = 1;

bool is_hash(const std::string& text) {
    return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

ordered_json json_of(const std::string& text) {
    try {
        return parse_json<ordered_json>(text);
    } catch (const std::runtime_error& problem) {
        throw std::runtime_error(std::string("is no record of an approval: ") + problem.what());
    }
}

ApprovedImage image_from(const ordered_json& from) {
    ApprovedImage image;
    image.key = from.at("key").get<std::string>();
    image.file = from.at("file").get<std::string>();
    image.sha256 = from.at("sha256").get<std::string>();
    image.bytes = whole_number<uint64_t>(from.at("bytes"), "bytes");
    image.by = from.at("by").get<std::string>();
    image.at = from.at("at").get<std::string>();
    image.reason = from.at("reason").get<std::string>();
    image.replaces = from.value("replaces", std::vector<std::string>());
    // Else a record could name files elsewhere.
    if (image.file.empty() || image.file.front() == '.' ||
        image.file.find('/') != std::string::npos || image.file.find('\0') != std::string::npos)
        throw std::runtime_error("names the file \"" + image.file + "\", which is none beside it");
    if (!is_hash(image.sha256))
        throw std::runtime_error("has \"" + image.sha256 + "\" for a SHA-256");
    return image;
}

} // namespace

std::string record_text(ApprovedRecord record) {
    const auto order = [](const ApprovedImage& image) { return std::tie(image.key, image.sha256); };
    std::sort(record.images.begin(), record.images.end(),
              [&](const auto& a, const auto& b) { return order(a) < order(b); });
    ordered_json to{{"format", kFormat}, {"version", kVersion}, {"images", ordered_json::array()}};
    for (const ApprovedImage& image : record.images) {
        to["images"].push_back({{"key", image.key},
                                {"file", image.file},
                                {"sha256", image.sha256},
                                {"bytes", image.bytes},
                                {"by", image.by},
                                {"at", image.at},
                                {"reason", image.reason},
                                {"replaces", image.replaces}});
    }
    return to.dump(1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

ApprovedRecord record_from(const std::string& text) {
    try {
        const ordered_json from = json_of(text);
        if (from.value("format", std::string()) != kFormat)
            throw std::runtime_error(std::string("has no \"format\": \"") + kFormat + "\"");
        if (whole_number<int>(from.at("version"), "version") != kVersion)
            throw std::runtime_error("is of another version than " + std::to_string(kVersion));
        ApprovedRecord record;
        for (const ordered_json& image : from.at("images"))
            record.images.push_back(image_from(image));
        return record;
    } catch (const ordered_json::exception& problem) {
        throw std::runtime_error(std::string("is no record of an approval: ") + reason_of(problem));
    }
}

} // namespace tonetool::store
