// SPDX-License-Identifier: BSD-3-Clause
// Tables of lights in JSON.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/lights/light_table.h"
#include "imagebuf/pixels/json_reading.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using nlohmann::json;
using OIIO::Strutil::fmt::format;

class Reader {
public:
    explicit Reader(LightTable& table) : m_table(table) {}

    void lights(const json& from, const std::string& place) {
        if (!from.is_array() && !from.is_object())
            fail(place, "must be lights by name, or a list of them");
        size_t number = 0;
        for (const auto& item : from.items()) {
            const json& entry = item.value();
            const std::string at = place + "/" + item.key();
            const std::string place_key = from.is_object() ? item.key() : std::to_string(number);
            ++number;
            const std::string key = key_of(entry, at, from.is_array(), place_key);
            m_table.add(group_or_light(entry, at), key, where(at));
        }
    }

private:
    std::string where(const std::string& place) const {
        return format("\"{}\" at {}", m_table.file(), place);
    }

    [[noreturn]] void fail(const std::string& place, const std::string& what) const {
        throw Refusal(where(place) + ": " + what);
    }

    // "index" goes before the name; "name" goes before the place in a list.
    std::string key_of(const json& entry, const std::string& place, bool listed,
                       const std::string& in_place) const {
        if (entry.is_object() && entry.contains("index")) {
            if (!entry["index"].is_number_integer())
                fail(place + "/index", shown_json(entry["index"]) + " is not a whole number");
            return entry["index"].dump();
        }
        if (entry.is_object() && listed && entry.contains("name")) {
            if (!entry["name"].is_string())
                fail(place + "/name", shown_json(entry["name"]) + " is not a text");
            return entry["name"].get<std::string>();
        }
        return in_place;
    }

    Light group_or_light(const json& entry, const std::string& place) const {
        if (!entry.is_object() || !entry.contains("lights"))
            return light(entry, place);
        if (!entry["lights"].is_array())
            fail(place + "/lights", "must be a list");
        Light out;
        double power = 0;
        bool powers = false;
        std::vector<std::string> lacking;
        for (size_t i = 0; i < entry["lights"].size(); ++i) {
            const json& member = entry["lights"][i];
            const Light one = light(member, format("{}/lights/{}", place, i));
            if (one.luminance)
                out.luminance = std::max(out.luminance.value_or(0), *one.luminance);
            else
                lacking.push_back(name_of(member, i) + " is " + one.lacks);
            power += one.power.value_or(0);
            powers = powers || one.power;
        }
        if (powers)
            out.power = power;
        out.lacks = lacking.empty() ? "a group without lights" : OIIO::Strutil::join(lacking, ", ");
        return out;
    }

    static std::string name_of(const json& light, size_t number) {
        const bool named = light.is_object() && light.contains("name") && light["name"].is_string();
        return named ? light["name"].get<std::string>() : std::to_string(number);
    }

    Light light(const json& from, const std::string& place) const {
        Light out;
        if (!from.is_object()) {
            m_table.set_value(out, quantity(from, place));
            return out;
        }
        const auto value = member(from, place, {"value", "rgb"});
        const auto luminance = member(from, place, {"luminance", "radiance_rgb"});
        out.power = member(from, place, {"power_lum_W", "power", "power_rgb_W"});
        const auto area = member(from, place, {"area_m2", "area"});
        if (value)
            m_table.set_value(out, *value);
        if (luminance)
            m_table.set_luminance(out, *luminance);
        else if (out.power && area && *area > 0)
            m_table.set_luminance(out, *out.power / (M_PI * *area * sides(from)));
        if (!value && !luminance && !out.power && !from.contains("type"))
            fail(place, "must have luminance, radiance_rgb or power");
        out.lacks = "a light without an area" + type_of(from);
        return out;
    }

    static double sides(const json& light) {
        const auto it = light.find("two_sided");
        return it != light.end() && it->is_boolean() && it->get<bool>() ? 2 : 1;
    }

    static std::string type_of(const json& light) {
        const auto it = light.find("type");
        return it != light.end() && it->is_string() ? " (" + it->get<std::string>() + ")" : "";
    }

    // The first of the names that is there and not null.
    std::optional<double> member(const json& light, const std::string& place,
                                 std::initializer_list<const char*> names) const {
        for (const char* name : names)
            if (const auto it = light.find(name); it != light.end() && !it->is_null())
                return quantity(*it, place + "/" + name);
        return std::nullopt;
    }

    // A number, or the luminance of three.
    double quantity(const json& from, const std::string& place) const {
        const bool color =
            from.is_array() && from.size() == 3 &&
            std::all_of(from.begin(), from.end(), [](const json& v) { return v.is_number(); });
        if (!color && !from.is_number())
            fail(place, shown_json(from) + " is neither a number nor three");
        double rgb[3] = {0, 0, 0};
        for (size_t c = 0; c < 3; ++c) {
            rgb[c] = color ? from[c].get<double>() : from.get<double>();
            check_light_value(rgb[c], "the value", where(place));
        }
        return color ? luminance_of(rgb) : rgb[0];
    }

    LightTable& m_table;
};

} // namespace

void read_json_lights(const std::string& text, LightTable& table) {
    json all;
    try {
        all = parse_json<json>(text);
    } catch (const std::runtime_error& problem) {
        throw Refusal(format("\"{}\": {}", table.file(), problem.what()));
    }
    Reader reader(table);
    for (const char* key : {"groups", "lights"})
        if (all.is_object() && all.contains(key))
            return reader.lights(all[key], std::string("/") + key);
    return reader.lights(all, "");
}

} // namespace tonetool
