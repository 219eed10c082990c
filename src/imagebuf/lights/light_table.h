// SPDX-License-Identifier: BSD-3-Clause
// How bright lights are, from a file.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tonetool {

struct Light {
    std::string name;                ///< empty: known by its index
    int index = -1;                  ///< -1: known by its name
    std::optional<double> luminance; ///< in the unit of the image
    std::optional<double> power;
    std::string lacks; ///< why it has no luminance

    std::string shown() const;
};

class LightTable {
public:
    /// `unit` as LightOptions::unit has it.
    void read(const std::string& file, const std::string& unit);

    const Light* find(int index) const;
    const Light* find(const std::string& name) const;
    /// What lights are compared by: their power or their luminance, as the unit says.
    std::optional<double> rank(const Light& light) const;

    const std::string& file() const { return m_file; }
    /// All lights, for messages.
    std::string list() const;

    // For the readers of the formats.
    /// A plain value is of the table's unit.
    void set_value(Light& light, double value) const;
    void set_luminance(Light& light, double luminance) const;
    /// `key` is an index if it is a whole number, else a name. Errors begin with `where`.
    void add(Light light, const std::string& key, const std::string& where);

private:
    void read_csv(const std::string& text);

    std::string m_file;
    bool m_powers = false;
    double m_scale = 1;
    std::vector<Light> m_lights;
};

/// The lights of a text in JSON.
void read_json_lights(const std::string& text, LightTable& table);

/// Refuses a value that can be neither a luminance nor a power: `WHERE: WHAT is VALUE: must be
/// ...`.
void check_light_value(double value, const std::string& what, const std::string& where);

/// Luminance of linear Rec.709.
double luminance_of(const double (&rgb)[3]);

} // namespace tonetool
