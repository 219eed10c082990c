#include "tonemap/rational.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tonetool::tonemap {
namespace {

struct Named {
    const char* name;
    kernels::ToneCurve curve;
};

// aces: K. Narkowicz's fit with the exposure factor 0.6 of HDR-FLIP folded in. hable: J. Hable's
// filmic curve, white scale folded in. reinhard: x / (1 + x), run on luminance.
constexpr Named kCurves[] = {
    {"aces",
     {kernels::ToneKind::Rational,
      {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14}}},
    {"hable", {kernels::ToneKind::Rational, {0.231683, 0.013791, 0.0, 0.18, 0.3, 0.018}}},
    {"reinhard", {kernels::ToneKind::ReinhardLuminance, {0.0, 1.0, 0.0, 0.0, 1.0, 1.0}}}};

// Roots of a x^2 + b x + c in [0, largest], ascending.
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

std::string at(const char* format, double x, double largest) {
    char buffer[256];
    std::snprintf(buffer, sizeof buffer, format, x, largest);
    return buffer;
}

} // namespace

std::optional<kernels::ToneCurve> rational_curve(std::string_view name) {
    for (const Named& entry : kCurves)
        if (name == entry.name)
            return entry.curve;
    return std::nullopt;
}

std::vector<std::string> rational_curve_names() {
    std::vector<std::string> names;
    for (const Named& entry : kCurves)
        names.emplace_back(entry.name);
    return names;
}

std::string curve_fault(const std::array<double, 6>& k, double largest) {
    if (!std::all_of(k.begin(), k.end(), [](double v) { return std::isfinite(v); }))
        return "a coefficient is not finite";
    if (k[3] == 0 && k[4] == 0 && k[5] == 0)
        return "the denominator is 0 everywhere (k3 = k4 = k5 = 0)";
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
