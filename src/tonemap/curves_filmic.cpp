// SPDX-License-Identifier: BSD-3-Clause
// Curves after the response of film, and fits of the ACES output transform.
#include "tonemap/curve_families.h"

#include <cmath>
#include <stdexcept>

namespace tonetool::tonemap {
namespace {

using kernels::CurveKind;
using kernels::CurveNumbers;

// y (6.2 y + 0.5) / (y (6.2 y + 1.7) + 0.06), y = max(0, x - 0.004)
CurveNumbers make_filmic_alu(const CurveValues&) {
    return {CurveKind::FilmicAlu, {0.004, 6.2, 0.5, 1.7, 0.06}};
}

// As HDR-FLIP's program has it: Hable's numbers, white 11.2 and an exposure of 2 folded in.
CurveNumbers make_hable(const CurveValues&) {
    return rational(0.231683, 0.013791, 0, 0.18, 0.3, 0.018);
}

// U(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F over one denominator.
CurveNumbers make_uncharted2(const CurveValues& v) {
    const double a = v[0], b = v[1], c = v[2], d = v[3], e = v[4], f = v[5], white = v[6];
    const double k0 = a * (f - e), k1 = b * (c * f - e);
    const double k3 = a * f, k4 = b * f, k5 = d * f * f;
    const double scale = ((k3 * white + k4) * white + k5) / ((k0 * white + k1) * white);
    return rational(k0 * scale, k1 * scale, 0, k3, k4, k5);
}

CurveNumbers make_aces(const CurveValues& v) {
    const double s = v[0];
    return rational(s * s * 2.51, s * 0.03, 0, s * s * 2.43, s * 0.59, 0.14);
}

CurveNumbers make_aces_hill(const CurveValues&) {
    return {CurveKind::AcesHill, {1, 0.0245786, -0.000090537, 0.983729, 0.4329510, 0.238081}};
}

// The same for each channel; of_channels() puts others together.
CurveNumbers make_film(const CurveValues& v) {
    if (!(v[3] > v[2]))
        throw std::invalid_argument("curve \"film\": dmax must exceed dmin");
    return {CurveKind::Film,
            {v[0], v[1], v[2], v[3], v[0], v[1], v[2], v[3], v[0], v[1], v[2], v[3]}};
}

Curve film_curve() {
    std::vector<CurveParameter> parameters = {
        {"middle", 0.18, 1e-4, 1e4, "light in the middle of the film's densities"},
        {"gamma", 1.8, 0.25, 4, "slope of the density there, over log10 of light"},
        {"dmin", 0, 0, 4, "least density, which becomes display white"},
        {"dmax", 3, 0.1, 8, "largest density"}};
    for (CurveParameter& parameter : parameters)
        parameter.per_channel = true;
    return {"film",
            "Reversal film",
            "a logistic density over log exposure, as sheets of reversal films draw it",
            "y = 10^-(D - dmin), D = dmin + (dmax - dmin) / "
            "(1 + exp(4 gamma log10(x / middle) / (dmax - dmin)))",
            CurveDomain::Channel,
            false,
            true,
            std::move(parameters),
            make_film,
            "never reaches 1; no film's data: each of middle, gamma, dmin, dmax may be R,G,B"};
}

CurveNumbers make_steve_a(const CurveValues&) {
    return rational(10, 0.3, 0, 10, 0.5, 1.5);
}

CurveNumbers make_steve_b(const CurveValues&) {
    return rational(1.8, 1.4, 0, 1.8, 0.5, 1.5);
}

// f(x) = (x v + 0.004) / (x (v + 0.55) + 0.0491) - 0.0821, v = 1.425 x + 0.05, over f(white).
CurveNumbers make_hejl2015(const CurveValues& v) {
    const double a = 1.425, white = v[0];
    const double k0 = a - 0.0821 * a, k1 = 0.05 - 0.0821 * 0.6, k2 = 0.004 - 0.0821 * 0.0491;
    const double k3 = a, k4 = 0.6, k5 = 0.0491;
    const double scale = ((k3 * white + k4) * white + k5) / ((k0 * white + k1) * white + k2);
    return rational(k0 * scale, k1 * scale, k2 * scale, k3, k4, k5);
}

std::vector<CurveParameter> uncharted2_parameters() {
    return {{"shoulder", 0.22, 0, 10, "A, shoulder strength"},
            {"linear", 0.30, 0, 10, "B, linear strength"},
            {"angle", 0.10, 0, 10, "C, linear angle"},
            {"toe", 0.20, 0.001, 10, "D, toe strength"},
            {"toenum", 0.01, 0, 10, "E, toe numerator"},
            {"toeden", 0.30, 0.001, 10, "F, toe denominator"},
            white_parameter(11.2, "the value that becomes 1 (linear white)")};
}

std::vector<Curve> game_curves() {
    return {
        {"filmic-alu",
         "Filmic, arithmetic only",
         "J. Hejl and R. Burgess-Dawson, 2010",
         "y = (u (6.2 u + 0.5) / (u (6.2 u + 1.7) + 0.06))^2.2, u = max(0, x - 0.004)",
         CurveDomain::Channel,
         true,
         true,
         {},
         make_filmic_alu,
         "values up to 0.004 become black"},
        {"hable",
         "Hable's filmic curve as HDR-FLIP has it",
         "J. Hable, Uncharted 2: HDR Lighting, 2010; HDR-FLIP, 2021",
         "y = (0.231683 x^2 + 0.013791 x) / (0.18 x^2 + 0.3 x + 0.018)",
         CurveDomain::Channel,
         false,
         true,
         {},
         make_hable,
         "white is 5.6; values above it exceed 1"},
        {"uncharted2", "Hable's filmic curve with its parameters",
         "J. Hable, Uncharted 2: HDR Lighting, 2010; values by M. Pettineo, 2010",
         "y = U(x) / U(white), U(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F",
         CurveDomain::Channel, false, true, uncharted2_parameters(), make_uncharted2,
         "values above white exceed 1"},
    };
}

std::vector<Curve> fitted_curves() {
    return {
        {"aces",
         "ACES, Narkowicz's fit",
         "K. Narkowicz, ACES Filmic Tone Mapping Curve, 2016",
         "y = u (2.51 u + 0.03) / (u (2.43 u + 0.59) + 0.14), u = prescale x",
         CurveDomain::Channel,
         false,
         true,
         {{"prescale", 1, 0.01, 100, "exposure before the curve; 0.6 is nearer to ACES", 0.6}},
         make_aces,
         "exceeds 1 above x = 7.24 / prescale"},
        {"aces-hill",
         "ACES, Hill's fit",
         "S. Hill, in BakingLab by M. Pettineo and D. Neubelt, 2016",
         "rgb = out f(in rgb), f(x) = (x (x + 0.0245786) - 0.000090537) / "
         "(x (0.983729 x + 0.432951) + 0.238081)",
         CurveDomain::Color,
         false,
         true,
         {},
         make_aces_hill,
         "without the factor of 1.8 that BakingLab puts after it"},
        {"steve-a",
         "SteveM's curve",
         "SteveM, commenting on M. Pettineo's article of 2010",
         "y = x (10 x + 0.3) / (x (10 x + 0.5) + 1.5)",
         CurveDomain::Channel,
         false,
         true,
         {},
         make_steve_a},
        {"steve-b",
         "SteveM's more linear curve",
         "SteveM, commenting on M. Pettineo's article of 2010",
         "y = x (1.8 x + 1.4) / (x (1.8 x + 0.5) + 1.5)",
         CurveDomain::Channel,
         false,
         false,
         {},
         make_steve_b,
         "exceeds 1 above x = 5/3, up to 1.065 at 3.69, then falls back to 1"},
        {"hejl2015",
         "Hejl's curve of 2015",
         "J. Hejl, 2015, with his 1.425 (1.435 is in use too)",
         "y = f(x) / f(white), f(x) = (x v + 0.004) / (x (v + 0.55) + 0.0491) - 0.0821, "
         "v = 1.425 x + 0.05",
         CurveDomain::Channel,
         false,
         true,
         {{"white", 5, 0.1, 1e9, "the value that becomes 1"}},
         make_hejl2015,
         "slightly below 0 where x < 0.0046; values above white exceed 1"},
    };
}

} // namespace

std::vector<Curve> filmic_curves() {
    std::vector<Curve> rows = game_curves();
    for (Curve& row : fitted_curves())
        rows.push_back(std::move(row));
    rows.push_back(film_curve());
    return rows;
}

} // namespace tonetool::tonemap
