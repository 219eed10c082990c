// SPDX-License-Identifier: BSD-3-Clause
// Curves older than the filmic ones. White is 5 by default, as in M. Pettineo's article of 2010.
#include "tonemap/curve_families.h"

namespace tonetool::tonemap {
namespace {

using kernels::CurveKind;
using kernels::CurveNumbers;

CurveNumbers make_linear(const CurveValues&) {
    return rational(0, 1, 0, 0, 0, 1);
}

CurveNumbers make_logarithmic(const CurveValues& v) {
    return {CurveKind::Logarithmic, {v[0]}};
}

CurveNumbers make_exponential(const CurveValues& v) {
    return {CurveKind::Exponential, {v[0]}};
}

CurveNumbers make_drago(const CurveValues& v) {
    return {CurveKind::Drago, {v[0], v[1]}};
}

CurveNumbers make_reinhard(const CurveValues&) {
    return rational(0, 1, 0, 0, 1, 1);
}

CurveNumbers make_reinhard_extended(const CurveValues& v) {
    return rational(1 / (v[0] * v[0]), 1, 0, 0, 1, 1);
}

// The article's shader has a product where this has a power; they agree for bias 0.5 alone.
Curve drago_curve() {
    return {"drago",
            "Drago's adaptive logarithm",
            "F. Drago et al., Adaptive Logarithmic Mapping, 2003",
            "y = log(1 + x) / (log10(1 + white) log(2 + 8 (x / white)^(log(bias) / log(0.5))))",
            CurveDomain::Luminance,
            false,
            true,
            {white_parameter(5, "the value that becomes 1: largest over adapted luminance"),
             {"bias", 0.85, 0.01, 1, "1: a plain logarithm; less: brighter below white"}},
            make_drago,
            "values above white count as white: the formula may fall there"};
}

} // namespace

std::vector<Curve> basic_curves() {
    return {
        {"linear",
         "Linear",
         "no curve",
         "y = x",
         CurveDomain::Channel,
         false,
         true,
         {},
         make_linear,
         "all above 1 is cut off"},
        {"logarithmic",
         "Logarithmic",
         "M. Pettineo, A Closer Look At Tone Mapping, 2010",
         "y = log(1 + x) / log(1 + white)",
         CurveDomain::Luminance,
         false,
         true,
         {white_parameter(5, "the value that becomes 1")},
         make_logarithmic},
        {"exponential",
         "Exponential",
         "M. Pettineo, A Closer Look At Tone Mapping, 2010",
         "y = 1 - exp(-x / white)",
         CurveDomain::Luminance,
         false,
         true,
         {white_parameter(5, "the value that becomes 0.632; nothing becomes 1")},
         make_exponential,
         "the formula's first form divides by the average, not by white"},
        drago_curve(),
        {"reinhard",
         "Reinhard",
         "E. Reinhard et al., Photographic Tone Reproduction, 2002, Eq. 3",
         "y = x / (1 + x)",
         CurveDomain::Luminance,
         false,
         true,
         {},
         make_reinhard,
         "HDR-FLIP's curve of this name"},
        {"reinhard-extended",
         "Reinhard with a white point",
         "E. Reinhard et al., Photographic Tone Reproduction, 2002, Eq. 4",
         "y = x (1 + x / white^2) / (1 + x)",
         CurveDomain::Luminance,
         false,
         true,
         {white_parameter(5, "the value that becomes 1")},
         make_reinhard_extended,
         "values above white exceed 1"},
    };
}

} // namespace tonetool::tonemap
