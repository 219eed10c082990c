// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/attribute/cryptomatte.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "imagebuf/pixels/json_reading.h"
#include "imagebuf/pixels/utf8.h"
#include "metrics/coverage.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using Warnings = std::vector<std::string>;
using Attributes = std::map<std::string, std::string>;

// More than a million names need.
constexpr uintmax_t kMostManifestBytes = uintmax_t(128) << 20;

// The attributes of each key.
std::map<std::string, Attributes> attributes_by_key(const OIIO::ImageSpec& spec) {
    constexpr size_t longest_key = 7;
    std::map<std::string, Attributes> found;
    for (const OIIO::ParamValue& value : spec.extra_attribs) {
        if (value.type() != OIIO::TypeString)
            continue;
        std::string name = value.name().string();
        if (OIIO::Strutil::starts_with(name, "exr/"))
            name = name.substr(4);
        const std::vector<std::string> words = OIIO::Strutil::splits(name, "/");
        if (words.size() == 3 && words[0] == "cryptomatte" && words[1].size() <= longest_key)
            found[words[1]][words[2]] = value.get_string(0);
    }
    return found;
}

std::string attribute_of(const Attributes& attributes, const char* name) {
    const auto found = attributes.find(name);
    return found == attributes.end() ? "" : found->second;
}

// Takes the pairs of one flat object as they come: a million of them need no tree.
class ManifestReader : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit ManifestReader(std::vector<std::pair<std::string, std::string>>& pairs)
        : m_pairs(pairs) {}
    bool null() override { return false; }
    bool boolean(bool) override { return false; }
    bool number_integer(number_integer_t) override { return false; }
    bool number_unsigned(number_unsigned_t) override { return false; }
    bool number_float(number_float_t, const string_t&) override { return false; }
    bool binary(binary_t&) override { return false; }
    bool start_array(size_t) override { return false; }
    bool end_array() override { return false; }
    bool start_object(size_t) override { return m_depth++ == 0; }
    bool end_object() override { return true; }
    bool key(string_t& key) override {
        m_key = key;
        return true;
    }
    bool string(string_t& value) override {
        if (m_depth != 1)
            return false;
        m_pairs.emplace_back(std::move(m_key), value);
        return true;
    }
    bool parse_error(size_t, const std::string&, const nlohmann::json::exception&) override {
        return false;
    }

private:
    std::vector<std::pair<std::string, std::string>>& m_pairs;
    std::string m_key;
    int m_depth = 0;
};

bool is_hexadecimal(const std::string& digits) {
    return !digits.empty() && digits.size() <= 8 &&
           std::all_of(digits.begin(), digits.end(),
                       [](unsigned char c) { return std::isxdigit(c) != 0; });
}

// Of names that are there twice the last counts.
void read_names(const std::string& text, CryptomatteType& type, Warnings& warnings) {
    const std::string whose = "the manifest of " + type.name;
    std::vector<std::pair<std::string, std::string>> pairs;
    ManifestReader reader(pairs);
    if (!nlohmann::json::sax_parse(text, &reader)) {
        warnings.push_back(whose + " is no JSON object of names and ids: its names are not known");
        return;
    }
    size_t bad = 0, unlike = 0;
    std::string first;
    for (const auto& [name, digits] : pairs) {
        if (!is_hexadecimal(digits)) {
            ++bad;
            continue;
        }
        const auto id = uint32_t(std::stoul(digits, nullptr, 16));
        if (metrics::cryptomatte_id(name) != id && unlike++ == 0)
            first = name;
        type.names[id] = valid_utf8(name);
    }
    if (bad > 0)
        warnings.push_back(format("{} has {} id(s) that are no hexadecimal numbers", whose, bad));
    if (unlike > 0)
        warnings.push_back(format("{} gives {} name(s) another id than their hash, first \"{}\"",
                                  whose, unlike, valid_utf8(first)));
}

// What is wrong with the name of a manifest's file; it may come from anywhere.
std::string path_fault(const std::string& file) {
    const std::vector<std::string> words = OIIO::Strutil::splits(file, "/");
    const bool leaves = std::find(words.begin(), words.end(), "..") != words.end();
    return file.front() == '/' || file.find('\\') != std::string::npos || leaves ||
                   file.find('\0') != std::string::npos
               ? "must lie in the folder of the image or below it"
               : "";
}

std::string read_beside(const std::string& image, const std::string& file, std::string& fault) {
    fault = path_fault(file);
    if (!fault.empty())
        return "";
    const std::filesystem::path path = std::filesystem::path(image).parent_path() / file;
    std::error_code problem;
    if (!std::filesystem::is_regular_file(path, problem)) {
        fault = "is no file";
        return "";
    }
    const uintmax_t size = std::filesystem::file_size(path, problem);
    if (problem || size > kMostManifestBytes) {
        fault = format("is larger than {} MiB", kMostManifestBytes >> 20);
        return "";
    }
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream)
        fault = "cannot be read";
    return text.str();
}

void read_manifest(const Attributes& attributes, const std::string& image, CryptomatteType& type,
                   Warnings& warnings) {
    const std::string file = attribute_of(attributes, "manif_file");
    std::string text = attribute_of(attributes, "manifest");
    if (!file.empty()) {
        std::string fault;
        text = read_beside(image, file, fault);
        if (!fault.empty())
            warnings.push_back(format("the manifest \"{}\" of {} {}: its names are not known",
                                      valid_utf8(file), type.name, fault));
    }
    if (!text.empty())
        read_names(text, type, warnings);
}

} // namespace

std::map<std::string, CryptomatteType>
cryptomatte_types(const std::vector<const OIIO::ImageBuf*>& parts, Warnings& warnings) {
    std::map<std::string, CryptomatteType> types;
    for (const OIIO::ImageBuf* part : parts) {
        for (const auto& [key, attributes] : attributes_by_key(part->spec())) {
            CryptomatteType type;
            type.name = valid_utf8(attribute_of(attributes, "name"));
            const std::string hash = attribute_of(attributes, "hash");
            const std::string conversion = attribute_of(attributes, "conversion");
            if (type.name.empty() || types.count(type.name) > 0)
                continue;
            if (hash != "MurmurHash3_32" || conversion != "uint32_to_float32") {
                warnings.push_back(format("{} is not looked at: its hash is \"{}\", its conversion "
                                          "\"{}\" (valid: MurmurHash3_32, uint32_to_float32)",
                                          type.name, valid_utf8(hash), valid_utf8(conversion)));
                continue;
            }
            read_manifest(attributes, std::string(part->name()), type, warnings);
            types.emplace(type.name, std::move(type));
        }
    }
    return types;
}

std::vector<int> cryptomatte_channels(const OIIO::ImageSpec& spec, const std::string& type) {
    static const std::map<std::string, int> places = {
        {"r", 0}, {"R", 0}, {"red", 0},  {"g", 1}, {"G", 1}, {"green", 1},
        {"b", 2}, {"B", 2}, {"blue", 2}, {"a", 3}, {"A", 3}, {"alpha", 3}};
    std::map<std::string, std::array<int, 4>> levels; // by their two digits
    for (int c = 0; c < spec.nchannels; ++c) {
        const std::string& name = spec.channelnames[size_t(c)];
        const size_t n = type.size();
        if (name.size() < n + 4 || name.compare(0, n, type) != 0 || name[n + 2] != '.' ||
            std::isdigit(static_cast<unsigned char>(name[n])) == 0 ||
            std::isdigit(static_cast<unsigned char>(name[n + 1])) == 0)
            continue;
        const auto place = places.find(name.substr(n + 3));
        if (place == places.end())
            continue;
        auto& level =
            levels.try_emplace(name.substr(n, 2), std::array<int, 4>{-1, -1, -1, -1}).first->second;
        level[size_t(place->second)] = c;
    }
    std::vector<int> channels;
    for (const auto& [digits, level] : levels)
        for (const size_t first : {size_t(0), size_t(2)})
            if (level[first] >= 0 && level[first + 1] >= 0)
                channels.insert(channels.end(), {level[first], level[first + 1]});
    return channels;
}

} // namespace tonetool
