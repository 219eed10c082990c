// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/rational.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>

#include "tonemap/curves.h"

namespace tonetool::tonemap {
namespace {

// The curves of the HDR-FLIP paper; their numbers are those of the registry.
constexpr const char* kNames[] = {"aces", "hable", "reinhard"};

std::string coefficient_fault(const double* k) {
    if (!std::all_of(k, k + 6, [](double v) { return std::isfinite(v); }))
        return "a coefficient is not finite";
    if (k[3] == 0 && k[4] == 0 && k[5] == 0)
        return "the denominator is 0 everywhere (k3 = k4 = k5 = 0)";
    return {};
}

std::string at(const char* format, double x, double largest) {
    char buffer[256];
    std::snprintf(buffer, sizeof buffer, format, x, largest);
    return buffer;
}

} // namespace

std::vector<double> roots_within(double a, double b, double c, double largest) {
    std::vector<double> roots;
    if (a == 0) {
        if (b != 0)
            roots.push_back(-c / b + 0.0);
    } else if (const double square = b * b - 4 * a * c; square >= 0) {
        // The form without cancellation; + 0.0 turns a root of -0 into 0.
        const double q = -0.5 * (b + std::copysign(std::sqrt(square), b));
        roots.push_back(q / a + 0.0);
        if (q != 0)
            roots.push_back(c / q + 0.0);
    }
    roots.erase(std::remove_if(roots.begin(), roots.end(),
                               [=](double x) { return !(x >= 0 && x <= largest); }),
                roots.end());
    std::sort(roots.begin(), roots.end());
    return roots;
}

std::optional<kernels::ToneCurve> rational_curve(std::string_view name) {
    if (std::find(std::begin(kNames), std::end(kNames), name) == std::end(kNames))
        return std::nullopt;
    const Curve& row = *find_curve(name);
    const auto numbers = row.make(curve_values(row, {}, true));
    kernels::ToneCurve curve{row.domain == CurveDomain::Luminance
                                 ? kernels::ToneKind::ReinhardLuminance
                                 : kernels::ToneKind::Rational,
                             {}};
    std::copy_n(numbers.p.begin(), curve.k.size(), curve.k.begin());
    return curve;
}

std::vector<std::string> rational_curve_names() {
    return {std::begin(kNames), std::end(kNames)};
}

kernels::CurveNumbers coefficient_curve(const std::vector<double>& k) {
    const std::string why = k.size() == 6
                                ? coefficient_fault(k.data())
                                : "a curve has 6 coefficients, not " + std::to_string(k.size());
    if (!why.empty())
        throw std::invalid_argument(why);
    kernels::CurveNumbers curve;
    std::copy(k.begin(), k.end(), curve.p.begin());
    return curve;
}

std::string curve_fault(const std::array<double, 6>& k, double largest) {
    if (std::string fault = coefficient_fault(k.data()); !fault.empty())
        return fault;
    const auto poles = roots_within(k[3], k[4], k[5], largest);
    if (!poles.empty())
        return at("the curve has a pole at x = %g, within the exposed values 0 to %g", poles[0],
                  largest);
    // The sign of y' is that of its numerator, a quadratic: constant between its roots.
    const double a = k[0] * k[4] - k[1] * k[3], b = 2.0 * (k[0] * k[5] - k[2] * k[3]);
    const double c = k[1] * k[5] - k[2] * k[4];
    double from = 0;
    auto turns = roots_within(a, b, c, largest);
    turns.push_back(largest);
    for (double to : turns) {
        const double middle = 0.5 * (from + to);
        if (from < to && (a * middle + b) * middle + c <= 0)
            return at("the curve does not increase above x = %g, within the exposed values 0 to %g",
                      from, largest);
        from = to;
    }
    return {};
}

} // namespace tonetool::tonemap
