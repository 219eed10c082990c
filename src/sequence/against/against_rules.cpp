// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/against/against_rules.h"

namespace tonetool::sequence {

// The limits were set by scenes at 4 samples per pixel against 1024, whose noise stays below the
// warnings, and by moved objects, whose differences do not.
const FaultRules& against_rules() {
    constexpr Severity error = Severity::Error, warning = Severity::Warning, info = Severity::Info;
    static const FaultRules rules = {
        {"displaywindow", error, {}, "", "the display window is another"},
        {"datawindow", error, {}, "", "the data window is another"},
        {"layermissing", error, {}, "", "a layer of the approved version is not there"},
        {"channels", error, {}, "", "a layer has other channels"},
        {"eyes", error, {}, "", "a view shows what another view of the approved version shows"},
        {"header",
         error,
         {},
         "",
         "pixel aspect, frames per second, view, chromaticities, colour space, Cryptomatte's name "
         "or "
         "hash, or an attribute of attribute= is another, or its manifest is gone; the camera's "
         "name: warning"},
        {"empty",
         error,
         {},
         "",
         "a layer is 0 everywhere, and the approved one is not in a thousandth of its pixels; told "
         "where no other difference of it is an error"},
        {"position", error, 0.01, "share of the pixels", "positions that moved; warning at 0.2 X"},
        {"depth", error, 0.01, "share of the pixels", "depths that are others; warning at 0.2 X"},
        {"normal", error, 2.0, "degrees", "the median angle of the normals; warning at 0.25 X"},
        {"normaloff", error, 0.15, "share of the pixels",
         "normals more than 10 degrees apart; warning at 0.33 X"},
        {"normalone", error, 0.05, "share of the pixels",
         "normals that only one version has; warning at 0.2 X"},
        {"vector", error, 0.25, "pixels", "the median distance of motion; warning at 0.2 X"},
        {"vectoroff", error, 0.05, "share of the pixels",
         "motion more than half a pixel apart; warning at 0.4 X"},
        {"id", error, 0.02, "share of the coverage", "other objects; warning at 0.25 X"},
        {"idothers", error, 0.95, "share of what the layer covers",
         "nearly all objects of a layer, as a rank of the edges; warning at 0.95 X"},
        {"color", error, 0.15, "stops",
         "a layer of colour is brighter or darker; warning at 0.33 X"},
        {"colorblocks", error, 0.08, "share of the blocks",
         "blocks of 16 x 16 pixels that differ by more than their noise; warning at 0.25 X"},
        {"group", error, 0.2, "stops", "the same of a light group; warning at 0.35 X"},
        {"groupblocks", error, 0.12, "share of the blocks", "the same; warning at 0.42 X"},
        {"albedo", error, 0.05, "stops", "the same of an albedo; warning at 0.4 X"},
        {"albedoblocks", error, 0.03, "share of the blocks", "the same; warning at 0.33 X"},
        {"nonfinite", error, 0.001, "share of the pixels",
         "NaN or infinity in the light of one version alone, or in normals and motion of the new "
         "one; "
         "warning at the first pixel. No pixel that is finite in both: error"},
        {"alpha", error, 0.01, "of 1", "the mean difference of an alpha; warning at 0.1 X"},
        {"alphaoff", error, 0.02, "share of the pixels",
         "alpha that differs by more than 0.02; warning at 0.1 X"},
        {"type",
         error,
         {},
         "",
         "data types are others; half for the float of colours, or float for half: warning"},
        {"compression",
         error,
         {},
         "",
         "a lossy compression for a lossless one; any other difference: warning"},
        {"layerextra", warning, {}, "", "a layer that the approved version has not"},
        {"noapproved",
         error,
         {},
         "",
         "the approved version has no such frame, though it has earlier and later ones; the new "
         "version is longer: info"},
        {"data", info, {}, "", "a layer that is not known differs at all"},
    };
    return rules;
}

const std::vector<AgainstQuantity>& against_quantities() {
    static const std::vector<AgainstQuantity> quantities = {
        {"position", "off", "position", 0.2},
        {"depth", "off", "depth", 0.2},
        {"normal", "median", "normal", 0.25},
        {"normal", "off10", "normaloff", 1.0 / 3},
        {"normal", "one", "normalone", 0.2},
        {"normal", "lost", "nonfinite", 1e-6},
        {"vector", "median", "vector", 0.2},
        {"vector", "off", "vectoroff", 0.4},
        {"vector", "lost", "nonfinite", 1e-6},
        {"id", "mismatch", "id", 0.25},
        {"id", "others", "idothers", 0.95},
        {"color", "none_finite", "nonfinite", 1e-6},
        {"color", "gain", "color", 1.0 / 3},
        {"color", "one_finite", "nonfinite", 1e-6},
        {"color", "blocks", "colorblocks", 0.25},
        {"group", "none_finite", "nonfinite", 1e-6},
        {"group", "gain", "group", 0.35},
        {"group", "one_finite", "nonfinite", 1e-6},
        {"group", "blocks", "groupblocks", 5.0 / 12},
        {"albedo", "none_finite", "nonfinite", 1e-6},
        {"albedo", "gain", "albedo", 0.4},
        {"albedo", "one_finite", "nonfinite", 1e-6},
        {"albedo", "blocks", "albedoblocks", 1.0 / 3},
        {"", "alpha_mean", "alpha", 0.1},
        {"", "alpha_off", "alphaoff", 0.1},
    };
    return quantities;
}

} // namespace tonetool::sequence
