// SPDX-License-Identifier: BSD-3-Clause
// Every curve of the registry, with several values of its parameters.
#pragma once

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "tonemap/curves.h"

namespace tonetool::kernels {

struct CurveCase {
    std::string what;
    CurveNumbers numbers;
    bool defaults;
};

/// The defaults; then each parameter at its ends and in its middle, the others left alone, as far
/// as these values go together.
inline std::vector<CurveCase> cases_of(const tonemap::Curve& curve) {
    std::vector<CurveCase> cases;
    const auto add = [&](const std::map<std::string, double>& given, const std::string& what) {
        try {
            const auto values = tonemap::curve_values(curve, given, false);
            cases.push_back({curve.name + what, curve.make(values), given.empty()});
        } catch (const std::invalid_argument&) {
            // These do not go together.
        }
    };
    add({}, "");
    for (const auto& p : curve.parameters)
        for (double value :
             {p.low, p.low > 0 ? std::sqrt(p.low * p.high) : (p.low + p.high) / 2, p.high})
            add({{p.name, value}}, std::string(" ") + p.name + "=" + std::to_string(value));
    return cases;
}

inline std::vector<CurveCase> all_cases() {
    std::vector<CurveCase> all;
    for (const auto& curve : tonemap::all_curves())
        for (CurveCase& one : cases_of(curve))
            all.push_back(std::move(one));
    return all;
}

/// `count` values from 2^-20 to 2^20, evenly in the logarithm, as floats.
inline std::vector<float> scene_values(size_t count) {
    std::vector<float> x(count);
    for (size_t i = 0; i < count; ++i)
        x[i] = float(std::exp2(-20 + 40 * double(i) / double(count - 1)));
    return x;
}

} // namespace tonetool::kernels
