// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/curves.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "kernels/curve_reference.h"
#include "tonemap/curve_families.h"

namespace tonetool::tonemap {
namespace {

std::vector<Curve> collect() {
    std::vector<Curve> all = basic_curves();
    for (auto family : {filmic_curves, modern_curves})
        for (Curve& row : family())
            all.push_back(std::move(row));
    return all;
}

std::string number(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

std::string joined(const std::vector<std::string>& words) {
    std::string all;
    for (const std::string& word : words)
        all += (all.empty() ? "" : ", ") + word;
    return all;
}

std::string of_curve(const Curve& curve) {
    return std::string("curve \"") + curve.name + "\"";
}

std::vector<std::string> parameter_names(const Curve& curve) {
    std::vector<std::string> names;
    for (const CurveParameter& parameter : curve.parameters)
        names.emplace_back(parameter.name);
    return names;
}

std::string unknown_parameter(const Curve& curve, const std::string& name) {
    const auto names = parameter_names(curve);
    return of_curve(curve) + " has no parameter \"" + name + "\"" +
           (names.empty() ? " (it has none)" : " (it has " + joined(names) + ")");
}

// Values that are valid one by one may not fit together: they may give a pole, or a toe above the
// line. Returns where the clamped curve falls or is NaN between 2^-32 and 2^64; empty if nowhere.
std::string fault(const Curve& curve, const CurveValues& values) {
    constexpr int steps = 8; // to an octave
    const kernels::CurveNumbers numbers = curve.make(values);
    double before = 0;
    for (int i = -32 * steps; i <= 64 * steps; ++i) {
        const double x = std::exp2(double(i) / steps), y = kernels::curve_reference(numbers, x);
        if (!std::isfinite(y))
            return of_curve(curve) + " with these values has no result at x = " + number(x);
        const double clamped = std::clamp(y, 0.0, 1.0);
        if (clamped < before - 1e-9)
            return of_curve(curve) + " with these values falls at x = " + number(x);
        before = clamped;
    }
    return {};
}

} // namespace

const std::vector<Curve>& all_curves() {
    static const std::vector<Curve> all = collect();
    return all;
}

const Curve* find_curve(std::string_view name) {
    for (const Curve& row : all_curves())
        if (row.name == name)
            return &row;
    return nullptr;
}

std::vector<std::string> curve_names() {
    std::vector<std::string> names;
    for (const Curve& row : all_curves())
        names.emplace_back(row.name);
    return names;
}

std::vector<std::string> curve_parameter_names() {
    std::vector<std::string> names;
    for (const Curve& row : all_curves())
        for (const std::string& name : parameter_names(row))
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
    return names;
}

CurveValues curve_values(const Curve& curve, const std::map<std::string, double>& given,
                         bool flip) {
    CurveValues all;
    for (const CurveParameter& parameter : curve.parameters)
        all.push_back(flip ? parameter.flip_value.value_or(parameter.value) : parameter.value);
    for (const auto& [name, value] : given) {
        size_t i = 0;
        while (i < all.size() && curve.parameters[i].name != name)
            ++i;
        if (i == all.size())
            throw std::invalid_argument(unknown_parameter(curve, name));
        const CurveParameter& parameter = curve.parameters[i];
        if (!(value >= parameter.low && value <= parameter.high))
            throw std::invalid_argument("\"" + name + "\" of " + of_curve(curve) + " cannot be " +
                                        number(value) + "; valid: " + number(parameter.low) +
                                        " to " + number(parameter.high));
        all[i] = value;
    }
    if (const std::string why = given.empty() ? "" : fault(curve, all); !why.empty())
        throw std::invalid_argument(why);
    return all;
}

kernels::CurveNumbers of_channels(const std::array<kernels::CurveNumbers, 3>& channels) {
    constexpr size_t each = 4; // numbers of a channel
    kernels::CurveNumbers all = channels[0];
    for (size_t c = 1; c < 3; ++c)
        std::copy_n(channels[c].p.begin(), each, all.p.begin() + ptrdiff_t(c * each));
    return all;
}

} // namespace tonetool::tonemap
