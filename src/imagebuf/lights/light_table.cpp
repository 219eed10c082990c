// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lights/light_table.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "imagebuf/aov/aov_layers.h"
#include "imagebuf/pixels/names.h"
#include "metrics/luminance.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using Words = std::vector<std::string>;

// All of the text as a number.
std::optional<double> number_in(const std::string& text) {
    std::istringstream in(text);
    in.imbue(std::locale::classic());
    double value = 0;
    in >> value;
    return !in.fail() && in.eof() ? std::optional<double>(value) : std::nullopt;
}

// The fields of a line without its comment; none for an empty line.
Words fields_of(std::string line) {
    line = OIIO::Strutil::strip(line.substr(0, line.find('#')));
    Words words;
    if (!line.empty())
        OIIO::Strutil::split(line, words, ",");
    for (std::string& word : words) {
        word = OIIO::Strutil::strip(word);
        if (word.size() >= 2 && word.front() == '"' && word.back() == '"')
            word = word.substr(1, word.size() - 2);
    }
    return words;
}

// "index,value" or "index,r,g,b": the values of a line.
void values_of(const Words& words, const std::string& line, const std::string& where,
               double (&values)[3]) {
    if (words.size() != 2 && words.size() != 4)
        throw Refusal(
            format("{}: \"{}\" has {} field(s): must be index or name, then a value or r,g,b",
                   where, OIIO::Strutil::strip(line), words.size()));
    for (size_t i = 1; i < words.size(); ++i) {
        const auto value = number_in(words[i]);
        if (!value)
            throw Refusal(format("{}: \"{}\" is not a number", where, words[i]));
        values[i - 1] = *value;
        check_light_value(*value, "the value", where);
    }
}

bool is_header(const Words& words) {
    const std::string first = lower(words[0]);
    for (const char* name : {"index", "name", "light", "group", "id"})
        if (first == name)
            return std::none_of(words.begin(), words.end(),
                                [](const auto& word) { return number_in(word).has_value(); });
    return false;
}

} // namespace

std::string Light::shown() const {
    return name.empty() ? std::to_string(index) : name;
}

double luminance_of(const double (&rgb)[3]) {
    const float v[3] = {float(rgb[0]), float(rgb[1]), float(rgb[2])};
    float out = 0;
    metrics::luminance_row(&v[0], &v[1], &v[2], &out, 1);
    return out;
}

void check_light_value(double value, const std::string& what, const std::string& where) {
    if (!(value >= 0 && value <= 1e30))
        throw Refusal(format("{}: {} is {}: must be 0 to 1e30", where, what, value));
}

void LightTable::read(const std::string& file, const std::string& unit) {
    m_file = file;
    m_powers = unit == "power";
    const auto scale = number_in(unit);
    if (!m_powers && unit != "luminance" && !(scale && *scale >= 1e-30 && *scale <= 1e30))
        throw Refusal(unknown_name("lightunit", unit,
                                   {"luminance", "power",
                                    "what makes luminances of the image of the "
                                    "table's, 1e-30 to 1e30"}));
    m_scale = scale.value_or(1);
    const std::string format_name = lower(OIIO::Filesystem::extension(file));
    std::string text;
    if (format_name != ".csv" && format_name != ".json")
        throw Refusal(format("light table \"{}\": must be a .csv or a .json file", file));
    if (!OIIO::Filesystem::is_regular(file) || !OIIO::Filesystem::read_text_file(file, text))
        throw Refusal(
            format("light table \"{}\": {}", file,
                   OIIO::Filesystem::exists(file) ? "cannot be read" : "there is no such file"));
    if (OIIO::Strutil::starts_with(text, "\xef\xbb\xbf"))
        text.erase(0, 3);
    if (format_name == ".csv")
        read_csv(text);
    else
        read_json_lights(text, *this);
    if (m_lights.empty())
        throw Refusal(format("light table \"{}\" holds no light", file));
}

void LightTable::read_csv(const std::string& text) {
    std::istringstream lines(text);
    std::string line;
    bool first = true;
    for (int number = 1; std::getline(lines, line); ++number) {
        const Words words = fields_of(line);
        if (words.empty())
            continue;
        const bool header = first && is_header(words);
        first = false;
        if (header)
            continue;
        const std::string where = format("\"{}\" line {}", m_file, number);
        double values[3] = {0, 0, 0};
        values_of(words, line, where, values);
        Light light;
        set_value(light, words.size() == 2 ? values[0] : luminance_of(values));
        add(std::move(light), words[0], where);
    }
}

void LightTable::set_value(Light& light, double value) const {
    if (!m_powers) {
        set_luminance(light, value);
        return;
    }
    light.power = value;
    light.lacks = "a power without an area";
}

void LightTable::set_luminance(Light& light, double luminance) const {
    light.luminance = luminance * m_scale;
}

void LightTable::add(Light light, const std::string& key, const std::string& where) {
    const auto number = number_in(key);
    if (number && !(*number >= 0 && *number <= 1e9 && *number == std::floor(*number)))
        throw Refusal(format("{}: index {} must be a whole number, 0 to 1e9", where, key));
    if (key.empty())
        throw Refusal(where + ": a light without a name");
    if (number)
        light.index = int(*number);
    else
        light.name = key;
    const auto same = [&](const Light& other) {
        return other.index == light.index && other.name == light.name;
    };
    if (std::any_of(m_lights.begin(), m_lights.end(), same))
        throw Refusal(format("{}: light {} is there twice", where, light.shown()));
    m_lights.push_back(std::move(light));
}

const Light* LightTable::find(int index) const {
    for (const Light& light : m_lights)
        if (light.index == index && index >= 0)
            return &light;
    return nullptr;
}

const Light* LightTable::find(const std::string& name) const {
    for (const Light& light : m_lights)
        if (!name.empty() && light.name == name)
            return &light;
    for (const Light& light : m_lights)
        if (!light.name.empty() && plain_word(light.name) == plain_word(name))
            return &light;
    return nullptr;
}

std::optional<double> LightTable::rank(const Light& light) const {
    return m_powers ? light.power : light.luminance;
}

std::string LightTable::list() const {
    constexpr size_t most = 12;
    Words names;
    for (const Light& light : m_lights)
        if (names.size() < most)
            names.push_back(light.shown());
    if (m_lights.size() > most)
        names.push_back(format("and {} more", m_lights.size() - most));
    return OIIO::Strutil::join(names, ", ");
}

} // namespace tonetool
