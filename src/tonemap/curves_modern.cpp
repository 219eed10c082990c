// SPDX-License-Identifier: BSD-3-Clause
// Curves of 2016 and later.
#include "tonemap/curve_families.h"

#include <cmath>

namespace tonetool::tonemap {
namespace {

using kernels::CurveKind;
using kernels::CurveNumbers;

// b and c put the curve through (midin, midout) and (white, 1).
CurveNumbers make_lottes(const CurveValues& v) {
    const double a = v[0], d = v[1], white = v[2], in = v[3], out = v[4];
    const double white_a = std::pow(white, a), white_ad = std::pow(white, a * d);
    const double in_a = std::pow(in, a), in_ad = std::pow(in, a * d);
    const double down = (white_ad - in_ad) * out;
    return {
        CurveKind::Lottes,
        {a, d, (white_a * out - in_a) / down, (white_ad * in_a - white_a * in_ad * out) / down}};
}

CurveNumbers make_uchimura(const CurveValues& v) {
    return {CurveKind::Uchimura, {v[0], v[1], v[2], v[3], v[4], v[5]}};
}

CurveNumbers make_agx(const CurveValues&) {
    return {CurveKind::Agx, {}};
}

CurveNumbers make_neutral(const CurveValues&) {
    return {CurveKind::Neutral, {}};
}

Curve lottes() {
    return {"lottes",
            "Lottes",
            "T. Lottes, Advanced Techniques and Optimization of HDR Color Pipelines, GDC 2016",
            "y = x^a / (b x^(a d) + c), b and c so that y(midin) = midout, y(white) = 1",
            CurveDomain::Channel,
            false,
            true,
            {{"contrast", 1.6, 0.5, 4, "a"},
             {"shoulder", 0.977, 0.5, 1, "d, compression of highlights"},
             white_parameter(8, "the value that becomes 1"),
             {"midin", 0.18, 0.001, 10, "a middle grey of the scene"},
             {"midout", 0.267, 0.001, 0.999, "what becomes of it"}},
            make_lottes,
            "values above white exceed 1"};
}

Curve uchimura() {
    return {"uchimura",
            "Uchimura (Gran Turismo)",
            "H. Uchimura, HDR Theory and Practice, CEDEC 2017",
            "y = m (x/m)^c + b up to m, m + a (x - m) over l of the rest, "
            "P - (P - S) exp(-a (x - s) / (P - S)) from there, blended smoothly below m",
            CurveDomain::Channel,
            false,
            true,
            {{"maximum", 1, 0.1, 100, "P, the largest result"},
             {"contrast", 1, 0.1, 10, "a, slope of the straight line"},
             {"start", 0.22, 0.001, 0.999, "m, where the straight line starts"},
             {"length", 0.4, 0, 0.99, "l, length of the straight line, a share of P - m"},
             {"toe", 1.33, 1, 10, "c, steepness of the toe"},
             {"pedestal", 0, 0, 0.5, "b, what black becomes"}},
            make_uchimura};
}

Curve agx() {
    return {"agx",
            "AgX, Wrensch's approximation",
            "T. Sobotka, AgX, 2022; minimal form by B. Wrensch, 2023",
            "rgb = (outset p((log2(inset rgb) + 12.47393) / 16.5))^2.2, p a polynomial of degree 6",
            CurveDomain::Color,
            true,
            true,
            {},
            make_agx,
            "what exceeds 2^4.026069 = 16.3 stays at 0.997; without the looks"};
}

Curve neutral() {
    return {"neutral",
            "Khronos PBR neutral",
            "Khronos Group, PBR Neutral Tone Mapper, 2024",
            "rgb - min(0.04, m - 6.25 m^2), m the least; above a peak of 0.76 compressed and "
            "desaturated",
            CurveDomain::Color,
            false,
            true,
            {},
            make_neutral,
            "never reaches 1"};
}

} // namespace

std::vector<Curve> modern_curves() {
    return {lottes(), uchimura(), agx(), neutral()};
}

} // namespace tonetool::tonemap
