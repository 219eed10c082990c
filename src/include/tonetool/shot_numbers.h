// SPDX-License-Identifier: BSD-3-Clause
// The light of the frames of a shot: plain numbers, no images.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tonetool {

/// What the exposure of a shot follows from, of one frame. Pixels that show nothing, black on the
/// background or of alpha 0, are not counted.
struct FrameLight {
    int frame = 0;            ///< its number
    std::string view;         ///< of a stereo pair; empty: there are no views
    double lwa = 0;           ///< geometric mean of the means of about 2300 cells; 0: it is black
    double lwa_geometric = 0; ///< geometric mean of the pixels with light
    double lmax = 0;          ///< luminance that one of ten thousand pixels exceeds
    double maximum = 0;       ///< the largest
    int64_t counted = 0;      ///< pixels with light
    double shown = 0;         ///< share of the pixels that show something
    double unit = 0;          ///< cd/m2 of a pixel value of 1 by the header; 0: it does not say
    double fps = 0;           ///< frames per second by the header; 0: it does not say
    /// Counted pixels by log2 of luminance: 64 bins of half a stop, from -20 to 12; the first and
    /// the last hold what is beyond.
    std::vector<int64_t> histogram;
    /// ln of the means of 32 x 18 cells, by rows: what cuts are told by.
    std::vector<double> thumbnail;
    /// The camera, if it was asked for and positions tell it: three rows of four numbers, of
    /// norm 1. With (a, b, c) = rows (x, y, z, 1) a point is seen at a/c and b/c in widths of the
    /// image from its middle, x to the right and y down. Empty: none.
    std::vector<double> camera;
};

struct ShotStatistics {
    /// "shot", "eye" or "smooth": how the exposure follows the light, unless AdaptOptions::mode
    /// says otherwise.
    std::string mode = "shot";
    std::vector<FrameLight> frames; ///< by number and view, each once
};

/// Where the exposure of an image in a shot comes from.
struct AdaptOptions {
    /// "frame": from the image itself; or the file of a ShotStatistics, as shot_text makes it.
    std::string adapt = "frame";
    ShotStatistics statistics; ///< instead of a file; without frames: none
    /// The number of the image in the shot; needed where exposures change in it.
    std::optional<int> frame;
    /// "shot": one exposure between two cuts; "eye": light and dark adaptation of rods and cones,
    /// which lags behind; "smooth": a mean over the frames before and after, which does not. Empty:
    /// that of the statistics.
    std::string mode;
    /// Seconds; unset: 0.4 of "smooth", 0.4 (rods) to 0.1 (cones) by the light of "eye".
    std::optional<double> tau;
    std::optional<double> fps; ///< frames per second; unset: the headers', else 24
    /// cd/m2 of a pixel value of 1: what "eye" adapts to, and what CalibrationMethod's AutoKey and
    /// Camera and CgTmoOptions's method "camera" need of the image, whether it is in a shot or not.
    /// Unset: the headers' whiteLuminance, else 1.
    std::optional<double> unit;
    /// First frames of scenes, "1,97"; "none"; "auto": where neighbours are not alike.
    std::string cuts = "auto";
    std::string space = "log"; ///< what is averaged over time: "log" or "linear" luminance
};

/// The luminances that the exposure of one frame follows from.
struct ShotExposure {
    double lwa = 0, lwa_geometric = 0, lmax = 0;
    int first = 0, last = 0; ///< frames between the cuts
    int64_t counted = 0;     ///< pixels with light in all of these
    std::string mode;
    std::vector<std::string> warnings, notes;
};

} // namespace tonetool
