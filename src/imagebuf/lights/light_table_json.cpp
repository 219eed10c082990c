// Tables of lights in JSON.
#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/lights/light_table.h"
#include "imagebuf/pixels/json_reading.h"

namespace tonetool {
namespace {

using nlohmann::json;
using OIIO::Strutil::fmt::format;

constexpr double kPi = 3.14159265358979323846;

class Reader {
public:
    Reader(LightTable& table, std::string& error) : m_table(table), m_error(error) {}

    bool lights(const json& from, const std::string& place) {
        if (!from.is_array() && !from.is_object())
            return fail(place, "must be lights by name, or a list of them");
        size_t number = 0;
        for (const auto& item : from.items()) {
            const json& entry = item.value();
            const std::string at = place + "/" + item.key();
            std::string key = from.is_object() ? item.key() : std::to_string(number);
            ++number;
            if (!named(entry, at, from.is_array(), key))
                return false;
            Light light;
            if (!group_or_light(entry, at, light) ||
                !m_table.add(std::move(light), key, where(at), m_error))
                return false;
        }
        return true;
    }

private:
    std::string where(const std::string& place) const {
        return format("\"{}\" at {}", m_table.file(), place);
    }

    bool fail(const std::string& place, const std::string& what) {
        m_error = where(place) + ": " + what;
        return false;
    }

    // "index" goes before the name; "name" goes before the place in a list.
    bool named(const json& entry, const std::string& place, bool listed, std::string& key) {
        if (!entry.is_object())
            return true;
        if (entry.contains("index")) {
            if (!entry["index"].is_number_integer())
                return fail(place + "/index",
                            shown_json(entry["index"]) + " is not a whole number");
            key = entry["index"].dump();
        } else if (listed && entry.contains("name")) {
            if (!entry["name"].is_string())
                return fail(place + "/name", shown_json(entry["name"]) + " is not a text");
            key = entry["name"].get<std::string>();
        }
        return true;
    }

    bool group_or_light(const json& entry, const std::string& place, Light& out) {
        if (!entry.is_object() || !entry.contains("lights"))
            return light(entry, place, out);
        if (!entry["lights"].is_array())
            return fail(place + "/lights", "must be a list");
        double power = 0;
        bool powers = false;
        std::vector<std::string> lacking;
        for (size_t i = 0; i < entry["lights"].size(); ++i) {
            const json& member = entry["lights"][i];
            Light one;
            if (!light(member, format("{}/lights/{}", place, i), one))
                return false;
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
        return true;
    }

    static std::string name_of(const json& light, size_t number) {
        const bool named = light.is_object() && light.contains("name") && light["name"].is_string();
        return named ? light["name"].get<std::string>() : std::to_string(number);
    }

    bool light(const json& from, const std::string& place, Light& out) {
        std::optional<double> value;
        if (!from.is_object()) {
            if (!quantity(from, place, value))
                return false;
            if (!value)
                return fail(place, "must be a number, [r, g, b] or an object");
            m_table.set_value(out, *value);
            return true;
        }
        std::optional<double> luminance, area;
        if (!member(from, place, {"value", "rgb"}, value) ||
            !member(from, place, {"luminance", "radiance_rgb"}, luminance) ||
            !member(from, place, {"power_lum_W", "power", "power_rgb_W"}, out.power) ||
            !member(from, place, {"area_m2", "area"}, area))
            return false;
        if (value)
            m_table.set_value(out, *value);
        if (luminance)
            m_table.set_luminance(out, *luminance);
        else if (out.power && area && *area > 0)
            m_table.set_luminance(out, *out.power / (kPi * *area * sides(from)));
        if (!value && !luminance && !out.power && !from.contains("type"))
            return fail(place, "must have luminance, radiance_rgb or power");
        out.lacks = "a light without an area" + type_of(from);
        return true;
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
    bool member(const json& light, const std::string& place,
                std::initializer_list<const char*> names, std::optional<double>& out) {
        for (const char* name : names) {
            const auto it = light.find(name);
            if (it != light.end() && !it->is_null() && !out &&
                !quantity(*it, place + "/" + name, out))
                return false;
        }
        return true;
    }

    // A number, or the luminance of three.
    bool quantity(const json& from, const std::string& place, std::optional<double>& out) {
        const bool color =
            from.is_array() && from.size() == 3 &&
            std::all_of(from.begin(), from.end(), [](const json& v) { return v.is_number(); });
        if (!color && !from.is_number())
            return fail(place, shown_json(from) + " is neither a number nor three");
        double rgb[3] = {0, 0, 0};
        for (size_t c = 0; c < 3; ++c) {
            rgb[c] = color ? from[c].get<double>() : from.get<double>();
            if (!check_light_value(rgb[c], "the value", where(place), m_error))
                return false;
        }
        out = color ? luminance_of(rgb) : rgb[0];
        return true;
    }

    LightTable& m_table;
    std::string& m_error;
};

} // namespace

bool read_json_lights(const std::string& text, LightTable& table, std::string& error) {
    json all;
    try {
        all = parse_json<json>(text);
    } catch (const std::runtime_error& problem) {
        error = format("\"{}\": {}", table.file(), problem.what());
        return false;
    }
    Reader reader(table, error);
    for (const char* key : {"groups", "lights"})
        if (all.is_object() && all.contains(key))
            return reader.lights(all[key], std::string("/") + key);
    return reader.lights(all, "");
}

} // namespace tonetool
