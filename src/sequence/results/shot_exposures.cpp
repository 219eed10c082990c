// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/shot_exposures.h"

#include <OpenImageIO/filesystem.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <tuple>

#include "sequence/results/json_text.h"
#include "sequence/results/results_json.h"

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;

using nlohmann::ordered_json;

constexpr char kExposuresFormat[] = "tonetool-exposures";
constexpr int kExposuresVersion = 1;

bool lit(const ExposureSample& sample) {
    return sample.max_luminance > 0 && sample.median_luminance > 0;
}

ordered_json range_json(const ShotExposures& range) {
    return {{"max_luminance", range.max_luminance},
            {"median_luminance", range.median_luminance},
            {"frames", range.frames}};
}

ExposureSamples samples_of(const ordered_json& json) {
    ExposureSamples samples;
    each_of(json.at("samples"), "samples", [&](const ordered_json& one, const std::string&) {
        samples.push_back({whole_number<int>(one.at("frame"), "frame"),
                           one.value("view", std::string()),
                           finite_number(one.at("max_luminance"), "max_luminance"),
                           finite_number(one.at("median_luminance"), "median_luminance"),
                           one.value("reference", std::string())});
    });
    return samples;
}

std::vector<std::string> references_of(ExposureSamples samples) {
    std::stable_sort(samples.begin(), samples.end(), [](const auto& a, const auto& b) {
        return std::tie(a.frame, a.view) < std::tie(b.frame, b.view);
    });
    std::vector<std::string> names;
    for (const ExposureSample& sample : samples)
        if (!sample.reference.empty())
            names.push_back(sample.reference);
    return names;
}

// A name is searched beside the file that contains it, else in the working directory.
bool is_same_file(const std::string& name, const std::string& measured, const std::string& folder) {
    std::error_code none;
    const fs::path beside = fs::path(folder) / measured;
    if (!folder.empty() && fs::exists(beside, none))
        return fs::equivalent(beside, name, none);
    return fs::absolute(measured, none).lexically_normal() ==
           fs::absolute(name, none).lexically_normal();
}

void sort_samples(ExposureSamples& samples) {
    const auto key = [](const ExposureSample& one) { return std::tie(one.frame, one.view); };
    std::sort(samples.begin(), samples.end(),
              [&](const auto& a, const auto& b) { return key(a) < key(b); });
    const auto twice =
        std::adjacent_find(samples.begin(), samples.end(),
                           [&](const auto& a, const auto& b) { return key(a) == key(b); });
    if (twice != samples.end())
        throw std::runtime_error("frame " + std::to_string(twice->frame) + " is there twice");
}

} // namespace

ShotExposures shot_exposures(const ExposureSamples& samples) {
    std::vector<double> medians;
    ShotExposures range;
    for (const ExposureSample& sample : samples) {
        if (lit(sample)) {
            medians.push_back(sample.median_luminance);
            range.max_luminance = std::max(range.max_luminance, sample.max_luminance);
        }
    }
    if (medians.empty()) {
        throw std::runtime_error("no frame has a reference that can be read and is not black: "
                                 "there are no exposures of the shot");
    }
    const auto middle = medians.begin() + std::ptrdiff_t(medians.size() / 2);
    std::nth_element(medians.begin(), middle, medians.end());
    range.median_luminance = *middle;
    range.frames = int(medians.size());
    range.references = references_of(samples);
    return range;
}

std::string exposures_text(const ShotExposures& range) {
    ordered_json text = range_json(range);
    text["references"] = range.references;
    return one_line(text);
}

bool was_measured_on(const ShotExposures& range, const std::string& file) {
    const fs::path name = fs::path(file).filename();
    return range.references.empty() ||
           std::any_of(range.references.begin(), range.references.end(),
                       [&](const std::string& measured) {
                           return fs::path(measured).filename() == name &&
                                  is_same_file(file, measured, range.folder);
                       });
}

std::string to_json(ExposureSamples samples) {
    sort_samples(samples);
    ordered_json to{{"format", kExposuresFormat}, {"version", kExposuresVersion}};
    if (std::any_of(samples.begin(), samples.end(), lit))
        to["exposures"] = range_json(shot_exposures(samples));
    to["samples"] = ordered_json::array();
    for (const ExposureSample& sample : samples) {
        ordered_json one{{"frame", sample.frame}};
        if (!sample.view.empty())
            one["view"] = sample.view;
        if (!sample.reference.empty())
            one["reference"] = sample.reference;
        one["max_luminance"] = sample.max_luminance;
        one["median_luminance"] = sample.median_luminance;
        to["samples"].push_back(one);
    }
    return dumped(to);
}

ExposureSamples samples_from_json(const std::string& text) {
    return parsed(text, [](const ordered_json& json) {
        check_format(json, kExposuresFormat, kExposuresVersion);
        return samples_of(json);
    });
}

ShotExposures read_exposures(const std::string& file) {
    try {
        return parsed(read_text(file), [&](const ordered_json& json) {
            const std::string format = json.is_object() ? json.value("format", "") : "";
            if (format != kResultsFormat)
                check_format(json, kExposuresFormat, kExposuresVersion);
            const ordered_json& from = json.at("exposures");
            const ShotExposures range{
                finite_number(from.at("max_luminance"), "max_luminance"),
                finite_number(from.at("median_luminance"), "median_luminance"),
                whole_number<int>(from.at("frames"), "frames"),
                format == kResultsFormat ? from.value("references", std::vector<std::string>())
                                         : references_of(samples_of(json)),
                fs::absolute(file).parent_path().string()};
            if (!(range.max_luminance > 0) || !(range.median_luminance > 0))
                throw std::runtime_error("has luminances that are not above 0");
            return range;
        });
    } catch (const std::runtime_error& problem) {
        throw std::runtime_error("exposures of \"" + file + "\": " + problem.what());
    }
}

std::string read_text(const std::string& file) {
    if (!OIIO::Filesystem::is_regular(file))
        throw std::runtime_error("no file \"" + file + "\"");
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw std::runtime_error("cannot read \"" + file + "\": " + std::strerror(errno));
    std::string text;
    std::error_code none;
    const auto size = fs::file_size(file, none);
    text.resize(none ? 0 : size_t(size));
    stream.read(text.data(), std::streamsize(text.size()));
    text.resize(size_t(stream.gcount()));
    text.append(std::istreambuf_iterator<char>(stream), {}); // of a file that grows
    return text;
}

} // namespace tonetool::sequence
