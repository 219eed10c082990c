// SPDX-License-Identifier: BSD-3-Clause
// The fields of CurveOptions, CalibrationOptions, TonemapOptions, LutOptions and LightOptions that
// are numbers, names or switches.
#pragma once

#include "imagebuf/options/camera_options.h"
#include "imagebuf/options/option.h"
#include "tonetool/lights.h"
#include "tonetool/lut.h"
#include "tonetool/tonemap.h"

namespace tonetool {

/// Of curves from files alone.
template <class See>
void describe(const CurveOptions&, See&& see) {
    using O = CurveOptions;
    see(option("curvename", "curve_name", &O::curve_name,
               "which curve of a file with several camera responses; NAME is NAMERed, NAMEGreen "
               "and NAMEBlue, too")
            .shown_as("NAME")
            .unset("the only one"));
    see(option("tableinput", "table_input", &O::table_input,
               "what x of a curve's file is; logarithms are of light")
            .one_of({"linear", "log2", "log10"}));
    see(option("tableoutput", "table_output", &O::table_output,
               "what the results of a curve's file are; linear: display light, encoded: as the "
               "picture is encoded, density: light is 10^-(D - Dmin)")
            .one_of({"linear", "encoded", "density"}));
}

/// Which pixels are measured.
inline std::vector<std::string> count_names() {
    return {"lit", "all"};
}
inline std::string count_text() {
    return "pixels that are measured; lit: neither black on the background nor of alpha 0, all: "
           "every finite one";
}

/// What calibrate() can show beside the picture.
inline std::vector<std::string> calibration_parts() {
    return {"mean", "key", "exposure"};
}
inline std::string calibration_parts_text() {
    return "what the exposure is made of instead of the picture, in R, G and B alike: the mean, "
           "the "
           "key, or the factor";
}

template <class See>
void describe(const CalibrationOptions&, See&& see) {
    using O = CalibrationOptions;
    see(option("stops", &O::stops, "exposure in stops, added to what is measured")
            .within(-126, 126)
            .in("stops"));
    see(option("key", &O::key, "what the geometric mean becomes, with method=mean")
            .within(1e-4, 100));
    see(option("level", &O::level,
               "local means over 2^N x 2^N cells of the image; 0: one mean for the image")
            .within(0, 20));
    describe(CameraOptions(), see);
    see(option("count", &O::count, count_text())
            .one_of(count_names())
            .unset("lit; with skipblack or skiptransparent: all"));
    see(option("means", &O::means, "what the mean is of: pixels, or the means of about 2300 cells")
            .one_of({"pixels", "cells"}));
    see(option("epsilon", &O::epsilon, "added to each luminance before its logarithm")
            .within(1e-30, 1));
    see(option("skipblack", "skip_black", &O::skip_black,
               "leave pixels of luminance 0 out of the statistics"));
    see(option("skiptransparent", "skip_transparent", &O::skip_transparent,
               "leave pixels of alpha 0 out of the statistics"));
}

/// The ways to clamp a colour, in the order of tonemap::Clip.
inline std::vector<std::string> clip_names() {
    return {"hue", "luminance", "neutral", "channel"};
}
inline std::string clip_text() {
    return "what stays of a colour with a channel above 1; channel: each is clamped by itself";
}

template <class See>
void describe(const TonemapOptions&, See&& see) {
    using O = TonemapOptions;
    see(option("encode", &O::encode, "how the result of a curve is encoded")
            .one_of(ToneAlgo::display_encodings()));
    see(option("primaries", &O::primaries, "primaries that a curve works in and the result has")
            .one_of({"rec709", "image"}));
    see(option("clamp", &O::clamp, "clamp the result of a curve to 0 to 1"));
    see(option("clip", &O::clip, clip_text()).one_of(clip_names()));
    see(option("unpremult", &O::unpremult, "divide colour by alpha before, multiply after"));
}

template <class See>
void describe(const LutOptions&, See&& see) {
    using O = LutOptions;
    see(option("from", "from_", &O::from,
               "colour space of the configuration that a view starts from")
            .shown_as("SPACE")
            .unset("linear Rec.709"));
    see(option("encode", &O::encode, "how the result of a curve is encoded")
            .one_of(ToneAlgo::display_encodings()));
    see(option("shaper", &O::shaper, "what maps scene light to 0 to 1")
            .one_of(ToneAlgo::lut_shapers()));
    see(option("min", &O::min, "low end of shaper=log2 in stops").within(-24, 0).in("stops"));
    see(option("max", &O::max, "high end of shaper=log2 in stops").within(1, 16).in("stops"));
    see(option("size", &O::size, "entries, or nodes along the edge of a cube (2 to 129)")
            .within(2, 65536)
            .unset("4096, or 33"));
}

template <class See>
void describe(const LightOptions&, See&& see) {
    using O = LightOptions;
    see(option("lights", "table", &O::table, "file of the table of lights, .csv or .json")
            .shown_as("FILE")
            .unset("none"));
    see(option("lightunit", "unit", &O::unit,
               "unit of the table's values: luminances of the image, these times X, or powers")
            .shown_as("luminance|power|X"));
    see(option("index", &O::index,
               "which light group a pixel has; contribution: the one that gives most light; power: "
               "of those that give 1 % the one with the largest value in the table")
            .one_of({"contribution", "power"}));
    see(option("groups", &O::groups, "light groups, by name or layer")
            .shown_as("NAME,...")
            .unset("found by their names"));
}

} // namespace tonetool
